/// The state of all blocks, an array for each quantity.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "dem/shape.hpp"
#include "dem/vector.hpp"

namespace dem {

/// Blocks 0 .. size()-1. Positions are those of the centres of mass; orientation turns the body frame into
/// the world.
struct Blocks {
    std::vector<Shape> shapes;
    std::vector<int> shape;                ///< index into shapes
    std::vector<std::uint8_t> is_fixed;    ///< 1: never moves
    std::vector<Vector> position;          ///< m
    std::vector<Quaternion> orientation;   ///< unit
    std::vector<Vector> velocity;          ///< m/s
    std::vector<Vector> angular_momentum;  ///< kg m^2/s, world axes
    // Follows from the above.
    std::vector<Rotation> rotation;        ///< matrix of orientation
    std::vector<Vector> angular_velocity;  ///< rad/s, world axes
    std::vector<double> mass_ratio;        ///< moving mass (with added mass) over dry mass, eq. (8)
    // Sums over all that acts on a block at the end of the last step.
    std::vector<Vector> force;   ///< N
    std::vector<Vector> torque;  ///< N m, about the centre of mass

    std::size_t size() const { return shape.size(); }
    const Shape& shape_of(std::size_t block) const { return shapes[static_cast<std::size_t>(shape[block])]; }
    /// It has a velocity.
    bool is_thrown(std::size_t block) const {
        return velocity[block].norm() > 0 || angular_velocity[block].norm() > 0;
    }
    /// Mass that moves: rho (s + C_M) A3 d^3 summed over a wholly wet block, kg.
    double mass(std::size_t block) const { return shape_of(block).mass * mass_ratio[block]; }
    /// Principal moments that turn, kg m^2.
    Vector inertia(std::size_t block) const { return shape_of(block).inertia * mass_ratio[block]; }
    /// Centre of a sphere relative to the block's centre, world axes, m.
    Vector arm(std::size_t block, std::size_t sphere) const {
        return rotation[block] * shape_of(block).spheres[sphere];
    }
    Vector sphere_centre(std::size_t block, std::size_t sphere) const {
        return position[block] + arm(block, sphere);
    }

    /// Appends a block at rest unless told otherwise; `angular_velocity` in world axes.
    void add(int shape_index, const Vector& at, const Quaternion& turned, bool fixed,
             const Vector& with_velocity = Vector::Zero(),
             const Vector& with_angular_velocity = Vector::Zero());
    /// Sets pose and speeds of one block, and all that follows from them.
    void place(std::size_t block, const Vector& at, const Quaternion& turned, const Vector& with_velocity,
               const Vector& with_angular_velocity);
    /// Angular velocity from angular momentum: omega = R I^-1 R^T L.
    void update_angular_velocity(std::size_t block);
    /// Changes the added mass; velocities stay. Returns the kinetic energy gained, J.
    double set_mass_ratio(std::size_t block, double ratio);
    double kinetic_energy(std::size_t block) const;
    /// Asks for the memory of blocks that a step will soon come to.
    void fetch(std::size_t first, std::size_t count) const;
};

}  // namespace dem
