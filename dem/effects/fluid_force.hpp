/// Force of the water on blocks, eqs. (10)-(12): drag, fluid acceleration with added mass, and buoyancy.
///
/// F_f of eq. (10) is unreadable in the scan of the paper; the form here is the one Gotoh's group uses
/// throughout its movable-bed work. The water changes over 1e-2 s, contacts over 1e-4 s: every sphere is
/// sampled at an interval of its own, where the block will be in the middle of it, and in between force and
/// torque follow the block's velocity and spin to first order (the Jacobian of the drag): second order in the
/// interval. A block that bobs at the surface gains nothing from it: to take the force at x + v h/2 for the
/// interval h is a map that keeps areas. Stable for h times the Jacobian over the mass below 2, h being the
/// time step (stable_time_step()); the interval only decides how exact it is.
#pragma once

#include <memory>
#include <vector>

#include "dem/blocks.hpp"
#include "dem/material.hpp"
#include "dem/water_motion.hpp"

namespace dem {

/// Sum of the water's force on one block, and how it changes with the block's motion.
struct FluidLoad {
    Vector force{0, 0, 0};                   ///< N
    Vector torque{0, 0, 0};                  ///< about the block's centre, N m
    Rotation drag_slope = Rotation::Zero();  ///< -dF/d(velocity), kg/s
    Rotation coupling = Rotation::Zero();    ///< -dT/d(velocity), kg m/s; transposed -dF/d(spin)
    Rotation spin_slope = Rotation::Zero();  ///< -dT/d(spin), kg m^2/s
    Vector velocity{0, 0, 0};                ///< of the block when sampled, m/s
    Vector spin{0, 0, 0};                    ///< rad/s
    double wet = 0;                          ///< mean over the block's spheres
    double water_speed = 0;                  ///< mean over the block's wet spheres, m/s

    /// Force and torque at the present velocity and spin.
    struct Wrench {
        Vector force, torque;
    };
    Wrench at(const Vector& present_velocity, const Vector& present_spin) const {
        const Vector faster = present_velocity - velocity, turning = present_spin - spin;
        return {force - drag_slope * faster - coupling.transpose() * turning,
                torque - coupling * faster - spin_slope * turning};
    }
};

struct FluidProperties {
    Water water;
    Element element;
    Vector gravity{0, 0, -9.81};
};

/// Samples all spheres of a block in `motion` (UniformWater or FlowGrid), where they will be in `ahead`
/// seconds as the block moves now, and sums their forces.
template <class Motion>
FluidLoad sample_fluid_load(const Blocks& blocks, std::size_t block, const Motion& motion,
                            const FluidProperties& properties, double ahead);

/// Largest change of the force on any sphere of a block at rest while the water around it changes by no more
/// than `change` and its wet fraction stays, summed over the spheres, N.
double largest_load_change(const Shape& shape, const FlowGrid::Change& change,
                           const FluidProperties& properties);

/// Moving mass over dry mass of a block with wet fraction `wet`: (s + C_M wet) / s for a block of plain
/// elements, eq. (8).
double mass_ratio(const Shape& shape, double wet, const FluidProperties& properties);

}  // namespace dem
