/// Small tanks of water for tests of cmps.
#pragma once

#include <cmath>
#include <cstdlib>
#include <functional>

#include "cmps/initial_state.hpp"
#include "cmps/near_field.hpp"

namespace cmps_tank {

/// An open tank, floor at z = 0, side walls at x = 0 and x = length, filled to `surface(x)`.
inline cmps::Particles particles(double length, double spacing, const std::function<double(double)>& surface,
                                 double height) {
    const double thick = 6 * spacing;
    cmps::Solid solid;
    solid.add({{-thick, -thick}, {length + thick, -thick}, {length + thick, 0}, {-thick, 0}}, cmps::body_bed);
    solid.add({{-thick, -thick}, {0, -thick}, {0, height}, {-thick, height}}, cmps::body_end_wall);
    solid.add({{length, -thick}, {length + thick, -thick}, {length + thick, height}, {length, height}},
              cmps::body_end_wall);
    solid.find_surface({0, 0}, {length, height});
    cmps::Particles particles =
        cmps::make_boundary(cmps::place_boundary(solid, spacing, -1, length + 1, height));
    cmps::fill_water(
        solid, spacing, 0, length, [&](double x) { return solid.free_intervals(x, 0, surface(x)); },
        particles);
    const char* const others = std::getenv("TSUNAGI_PERTURBATION");  // as tests/support/perturbations.py
    cmps::perturb(particles, spacing, others != nullptr ? 1000 * std::atoll(others) : 0);
    return particles;
}

inline cmps::Settings settings(double spacing, double depth) {
    cmps::Settings settings;
    settings.spacing = spacing;
    settings.depth = depth;
    return settings;
}

/// Advances to `end`, calling after(time) after every step.
inline void run(
    cmps::NearField& field, double end, const std::function<void(double)>& after = [](double) {}) {
    for (double time = 0; time < end;) {
        const double step = field.largest_step();
        field.advance(time, step);
        time += step;
        after(time);
    }
}

/// Mean pressure of the floor's wall particles within `reach` of x, Pa.
inline double floor_pressure(const cmps::Particles& particles, double x, double reach) {
    double sum = 0;
    int count = 0;
    for (std::size_t i = particles.first_wall(); i < particles.first_fluid(); ++i)
        if (std::abs(particles.x[i] - x) < reach && particles.z[i] < 0) sum += particles.pressure[i], ++count;
    return sum / count;
}

}  // namespace cmps_tank
