#include "dem/effects/fluid_force.hpp"

#include <cmath>

namespace dem {

namespace {

/// Factors of eq. (10) for one sphere of a shape.
struct SphereFactors {
    double volume, drag, inertia, viscous;
};

SphereFactors factors_of(const Shape& shape, const FluidProperties& properties) {
    const Water& water = properties.water;
    return {.volume = shape.volume_per_sphere,
            .drag = 0.5 * water.density * properties.element.section() * shape.elements_per_sphere,
            .inertia = water.density * (1 + water.added_mass_coefficient) * shape.volume_per_sphere,
            .viscous = 24 * water.viscosity / properties.element.diameter};
}

}  // namespace

template <class Motion>
FluidLoad sample_fluid_load(const Blocks& blocks, std::size_t block, const Motion& motion,
                            const FluidProperties& properties) {
    const Shape& shape = blocks.shape_of(block);
    const Water& water = properties.water;
    const auto [volume, drag, inertia, viscous] = factors_of(shape, properties);
    const Vector buoyancy = -water.density * volume * properties.gravity;

    FluidLoad load{Vector::Zero(), Vector::Zero(), Rotation::Zero(), blocks.velocity[block], 0, 0};
    double isotropic = 0;
    for (const auto& sphere : shape.spheres) {
        const Vector arm = blocks.rotation[block] * sphere;
        const WaterSample sample = motion.at(blocks.position[block] + arm);
        if (sample.wet <= 0) continue;
        const Vector relative =
            sample.velocity - blocks.velocity[block] - blocks.angular_velocity[block].cross(arm);
        const double speed = relative.norm();
        // C_D |u_r| of eq. (12), finite at zero relative speed.
        const double slope = drag * sample.wet * (water.drag_coefficient * speed + viscous);
        const Vector force =
            slope * relative + sample.wet * (inertia * sample.acceleration + buoyancy);  // (10), (11)
        load.force += force;
        load.torque += arm.cross(force);
        load.wet += sample.wet;
        load.water_speed += sample.wet * sample.velocity.norm();
        isotropic += slope;
        if (speed > 0)
            load.drag_slope +=
                (drag * sample.wet * water.drag_coefficient / speed * relative) * relative.transpose();
    }
    load.drag_slope.diagonal().array() += isotropic;
    if (load.wet > 0) load.water_speed /= load.wet;
    load.wet /= static_cast<double>(shape.spheres.size());
    return load;
}

template FluidLoad sample_fluid_load(const Blocks&, std::size_t, const UniformWater&, const FluidProperties&);
template FluidLoad sample_fluid_load(const Blocks&, std::size_t, const FlowGrid&, const FluidProperties&);

double largest_load_change(const Shape& shape, const FlowGrid::Change& change,
                           const FluidProperties& properties) {
    const SphereFactors factors = factors_of(shape, properties);
    // ||u|u - |v|v| <= (|u| + |v|) |u - v|; a wet fraction of 1 is the most there can be.
    const double slope =
        factors.drag * (properties.water.drag_coefficient * 2 * change.speed + factors.viscous);
    return static_cast<double>(shape.spheres.size()) *
           (slope * change.velocity + factors.inertia * change.acceleration);
}

double mass_ratio(const Shape& shape, double wet, const FluidProperties& properties) {
    return 1 + properties.water.density * properties.water.added_mass_coefficient * shape.displaced_volume *
                   wet / shape.mass;
}

}  // namespace dem
