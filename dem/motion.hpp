/// Motion of one rigid block: eqs. (8) and (9) for the clump as a whole.
///
/// The paper moves every sphere and then projects the motion onto a rigid one (Passively Moving Solid, Koshizuka 1998);
/// that projection equals Newton-Euler on the summed mass and inertia, which is integrated here: velocity Verlet with
/// the exact-rotation splitting of Dullweber, Leimkuhler and McLachlan (1997) for the turning. Second order, symplectic,
/// reversible; angular momentum is kept to round-off. One force evaluation a step, with velocities half a step back.
#pragma once

#include "dem/blocks.hpp"

namespace dem {

/// Half a kick: velocity and angular momentum gain half a step of the stored force and torque.
inline void kick_half(Blocks& blocks, std::size_t block, double half_step) {
    blocks.velocity[block] += half_step / blocks.mass(block) * blocks.force[block];
    blocks.angular_momentum[block] += half_step * blocks.torque[block];
}

/// Drift: position and orientation after `step` seconds, and the angular velocity there.
void drift(Blocks& blocks, std::size_t block, double step);

/// Turns `orientation` freely for `step` seconds with constant angular momentum (world axes).
void turn_freely(Quaternion& orientation, const Vector& angular_momentum, const Vector& inertia, double step);

}  // namespace dem
