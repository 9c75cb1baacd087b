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
};

/// The same as a step reads it: F = F_0 - A v - B^T w, T = T_0 - B v - C w. Thousands of blocks do not stay
/// in the near caches, so the slopes are float, A and C by their upper halves: 136 bytes a block. At the
/// motion that was sampled force and torque are the sampled ones to the last digits of double, for F_0 and
/// T_0 are found with the rounded slopes.
class FluidLoadInMotion {
 public:
    FluidLoadInMotion() = default;
    explicit FluidLoadInMotion(const FluidLoad& load);

    struct Wrench {
        Vector force, torque;
    };
    Wrench at(const Vector& velocity, const Vector& spin) const {
        const auto times = [](const float(&half)[6], const Vector& v) {
            return Vector(half[0] * v.x() + half[1] * v.y() + half[2] * v.z(),
                          half[1] * v.x() + half[3] * v.y() + half[4] * v.z(),
                          half[2] * v.x() + half[4] * v.y() + half[5] * v.z());
        };
        const auto& b = coupling_;
        return {force_ - times(drag_, velocity) -
                    Vector(b[0] * spin.x() + b[3] * spin.y() + b[6] * spin.z(),
                           b[1] * spin.x() + b[4] * spin.y() + b[7] * spin.z(),
                           b[2] * spin.x() + b[5] * spin.y() + b[8] * spin.z()),
                torque_ - times(spin_, spin) -
                    Vector(b[0] * velocity.x() + b[1] * velocity.y() + b[2] * velocity.z(),
                           b[3] * velocity.x() + b[4] * velocity.y() + b[5] * velocity.z(),
                           b[6] * velocity.x() + b[7] * velocity.y() + b[8] * velocity.z())};
    }

 private:
    Vector force_{0, 0, 0}, torque_{0, 0, 0};  // at rest
    float drag_[6] = {}, spin_[6] = {};        // xx xy xz yy yz zz
    float coupling_[9] = {};                   // row by row
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
