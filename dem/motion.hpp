/// Motion of one rigid block: eqs. (8) and (9) for the clump as a whole.
///
/// The paper moves every sphere and then projects the motion onto a rigid one (Passively Moving Solid,
/// Koshizuka 1998); that projection equals Newton-Euler on the summed mass and inertia, which is integrated
/// here by velocity Verlet. The turning is split into exact rotations (after Dullweber, Leimkuhler and
/// McLachlan 1997): one about the angular momentum, which commutes with all others, and those about the body
/// axes whose moment differs from that of the first axis. Second order, symplectic, reversible; angular
/// momentum is kept to round-off, and a symmetric top turns without any splitting error. One force evaluation
/// a step, with velocities half a step back.
#pragma once

#include "dem/blocks.hpp"

namespace dem {

/// Half a kick: velocity and angular momentum gain half a step of the stored force and torque.
inline void kick_half(Blocks& blocks, std::size_t block, double half_step) {
    blocks.velocity[block] += half_step / blocks.mass(block) * blocks.force[block];
    blocks.angular_momentum[block] += half_step * blocks.torque[block];
}

/// Drift: position and orientation after `step` seconds, and the angular velocity there. Returns a bound on
/// the way of the block's farthest point, m.
double drift(Blocks& blocks, std::size_t block, double step);

/// Turns `orientation` freely for `step` seconds with constant angular momentum (world axes); `rotation` is
/// its matrix, `inverse_inertia` the reciprocal principal moments.
void turn_freely(Quaternion& orientation, const Rotation& rotation, const Vector& angular_momentum,
                 const Vector& inverse_inertia, double step);

}  // namespace dem
