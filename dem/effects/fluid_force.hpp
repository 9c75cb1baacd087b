/// Force of the water on blocks, eqs. (10)-(12): drag, fluid acceleration with added mass, and buoyancy.
///
/// F_f of eq. (10) is unreadable in the scan of the paper; the form here is the one Gotoh's group uses
/// throughout its movable-bed work. The water changes over 1e-2 s, contacts over 1e-4 s: every sphere is
/// sampled at an interval of its own, and in between the force follows the block's velocity to first order
/// (the Jacobian of the drag).
#pragma once

#include <memory>
#include <vector>

#include "dem/blocks.hpp"
#include "dem/material.hpp"
#include "dem/water_motion.hpp"

namespace dem {

/// Sum of the water's force on one block, and how it changes with the block's velocity.
struct FluidLoad {
    Vector force;         ///< N
    Vector torque;        ///< about the block's centre, N m
    Rotation drag_slope;  ///< -dF/d(velocity), kg/s
    Vector velocity;      ///< of the block when sampled, m/s
    double wet;           ///< mean over the block's spheres
    double water_speed;   ///< mean over the block's wet spheres, m/s

    Vector force_at(const Vector& present_velocity) const {
        return force - drag_slope * (present_velocity - velocity);
    }
};

struct FluidProperties {
    Water water;
    Element element;
    Vector gravity{0, 0, -9.81};
};

/// Samples all spheres of a block in `motion` (UniformWater or FlowGrid) and sums their forces.
template <class Motion>
FluidLoad sample_fluid_load(const Blocks& blocks, std::size_t block, const Motion& motion,
                            const FluidProperties& properties);

/// Largest change of the force on any sphere of a block at rest while the water around it changes by no more
/// than `change` and its wet fraction stays, summed over the spheres, N.
double largest_load_change(const Shape& shape, const FlowGrid::Change& change,
                           const FluidProperties& properties);

/// Moving mass over dry mass of a block with wet fraction `wet`: (s + C_M wet) / s for a block of plain
/// elements, eq. (8).
double mass_ratio(const Shape& shape, double wet, const FluidProperties& properties);

}  // namespace dem
