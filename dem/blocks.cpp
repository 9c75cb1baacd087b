#include "dem/blocks.hpp"

#include "dem/prefetch.hpp"

namespace dem {

void Blocks::add(int shape_index, const Vector& at, const Quaternion& turned, bool fixed,
                 const Vector& with_velocity, const Vector& with_angular_velocity) {
    shape.push_back(shape_index);
    is_fixed.push_back(fixed ? 1 : 0);
    mass_ratio.push_back(1);
    position.emplace_back();
    orientation.emplace_back();
    velocity.emplace_back();
    angular_momentum.emplace_back();
    rotation.emplace_back();
    angular_velocity.emplace_back();
    force.push_back(Vector::Zero());
    torque.push_back(Vector::Zero());
    place(size() - 1, at, turned, with_velocity, with_angular_velocity);
}

void Blocks::place(std::size_t block, const Vector& at, const Quaternion& turned, const Vector& with_velocity,
                   const Vector& with_angular_velocity) {
    position[block] = at;
    orientation[block] = turned.normalized();
    rotation[block] = orientation[block].toRotationMatrix();
    velocity[block] = with_velocity;
    const Rotation& turn = rotation[block];
    angular_momentum[block] = turn * inertia(block).cwiseProduct(turn.transpose() * with_angular_velocity);
    angular_velocity[block] = with_angular_velocity;
}

void Blocks::update_angular_velocity(std::size_t block) {
    const Rotation& turn = rotation[block];
    const Vector in_body = turn.transpose() * angular_momentum[block];
    angular_velocity[block] =
        turn * in_body.cwiseProduct(shape_of(block).inverse_inertia * (1 / mass_ratio[block]));
}

double Blocks::set_mass_ratio(std::size_t block, double ratio) {
    const double before = kinetic_energy(block);
    angular_momentum[block] *= ratio / mass_ratio[block];
    mass_ratio[block] = ratio;
    return kinetic_energy(block) - before;
}

double Blocks::kinetic_energy(std::size_t block) const {
    return 0.5 * mass(block) * velocity[block].squaredNorm() +
           0.5 * angular_momentum[block].dot(angular_velocity[block]);
}

void Blocks::fetch(std::size_t first, std::size_t count) const {
    for (const auto* array : {&position, &velocity, &angular_momentum, &angular_velocity, &force, &torque})
        fetch_ahead(*array, first, count);
    fetch_ahead(orientation, first, count);
    fetch_ahead(rotation, first, count);
    fetch_ahead(mass_ratio, first, count);
}

}  // namespace dem
