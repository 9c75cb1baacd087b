#include "cmps/gauges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cmps/flow_grid.hpp"
#include "cmps/kernel.hpp"

namespace cmps {
namespace {

constexpr double pi = 3.14159265358979;

/// Level of the lowest ground at x, m; what is solid from below all that faces water: the highest of it.
double ground_level(const Solid& solid, double x) {
    double ground = std::numeric_limits<double>::infinity();
    for (const SurfaceSegment& segment : solid.surface()) {
        const auto [left, right] = std::minmax(segment.from[0], segment.to[0]);
        if (segment.normal[1] <= 0 || x < left || x > right || left == right) continue;
        const double share = (x - segment.from[0]) / (segment.to[0] - segment.from[0]);
        ground = std::min(ground, segment.from[1] + share * (segment.to[1] - segment.from[1]));
    }
    return ground;
}

}  // namespace

double surface_elevation(const Particles& particles, const Solid& solid, double spacing, double x) {
    const double reach = 2.1 * spacing;
    struct Near {
        double dx, z;
        bool is_fluid;
    };
    std::vector<Near> near;
    double low = 1e300, high = -1e300, water = -1e300;
    for (std::size_t j = 0; j < particles.size(); ++j)
        if (std::abs(particles.x[j] - x) < reach) {
            // the moving wall fills: absorption reads the level before it
            near.push_back({particles.x[j] - x, particles.z[j],
                            particles.is_fluid(j) || particles.body[j] == body_moving_wall});
            low = std::min(low, particles.z[j]), high = std::max(high, particles.z[j]);
            if (particles.is_fluid(j)) water = std::max(water, particles.z[j]);
        }
    if (near.empty()) return ground_level(solid, x);  // no wall particles either: behind a basin
    // the bottom of the highest free interval that water stands in; of the lowest one where all is dry
    double bottom = high, ceiling = high;
    for (const double aside :
         {0.0, -0.01 * spacing, 0.01 * spacing}) {  // a gauge on a face: the water's side
        double below = high, above = high;
        for (const auto& [from, to] : solid.free_intervals(x + aside, low - reach, high + 2 * reach))
            if (from < water || below == high) below = from, above = to;
        if (aside == 0.0 || below < water) bottom = below, ceiling = above;
        if (bottom < water) break;
    }
    const WendlandKernel kernel{reach};
    const double full = pi * reach * reach / 7.0 / (spacing * spacing);
    const auto filled = [&](double z) {
        double wet = 0, solid_part = 0;
        for (const auto& [dx, pz, is_fluid] : near)
            (is_fluid ? wet : solid_part) += kernel.weight(dx * dx + (pz - z) * (pz - z)) / full;
        return wet / (1.0 - std::min(solid_part, 0.9));
    };
    // like a wire gauge: the wetted length above the bottom, so that a void under an overturning crest counts
    // as air
    const double step = 0.25 * spacing;
    double below = filled(bottom + 0.5 * spacing), wetted = below < 0.5 ? 0.0 : 0.5 * spacing;
    for (double z = bottom + 0.5 * spacing + step; z < ceiling; z += step) {
        const double here = filled(z);
        if (below >= 0.5 && here >= 0.5)
            wetted += step;
        else if (below >= 0.5 || here >= 0.5)
            wetted += step * (std::max(below, here) - 0.5) / std::abs(below - here);
        below = here;
    }
    return bottom + wetted;
}

double pressure_in_water(const Particles& particles, double spacing, double x, double z, double diameter) {
    const double reach = std::max(0.5 * diameter, spacing);
    double sum = 0, weights = 0;
    for (std::size_t j = particles.first_fluid(); j < particles.size(); ++j) {
        const double w = std::max(0.0, 1.0 - std::hypot(particles.x[j] - x, particles.z[j] - z) / reach);
        sum += w * particles.pressure[j], weights += w;
    }
    return weights > 0 ? sum / weights : 0.0;
}

std::array<double, 2> velocity_at(const Particles& particles, double spacing, double x, double z) {
    const WendlandKernel kernel{2.1 * spacing};
    double m[6] = {}, u[3] = {}, w[3] = {};
    for (std::size_t j = particles.first_fluid(); j < particles.size(); ++j) {
        const double dx = particles.x[j] - x, dz = particles.z[j] - z,
                     weight = kernel.weight(dx * dx + dz * dz);
        if (weight <= 0) continue;
        m[0] += weight, m[1] += weight * dx, m[2] += weight * dz;
        m[3] += weight * dx * dx, m[4] += weight * dx * dz, m[5] += weight * dz * dz;
        u[0] += weight * particles.u[j], u[1] += weight * particles.u[j] * dx,
            u[2] += weight * particles.u[j] * dz;
        w[0] += weight * particles.w[j], w[1] += weight * particles.w[j] * dx,
            w[2] += weight * particles.w[j] * dz;
    }
    const double scale = spacing * spacing;
    return {linear_fit(m, u, scale), linear_fit(m, w, scale)};
}

double volume_by_surface(const Particles& particles, const Solid& solid, double spacing, double x0, double x1,
                         double bottom) {
    const int columns = std::max(1, static_cast<int>((x1 - x0) / (2 * spacing)));
    const double width = (x1 - x0) / columns;
    double volume = 0;
    for (int c = 0; c < columns; ++c) {
        const double x = x0 + (c + 0.5) * width;
        const double top = surface_elevation(particles, solid, spacing, x);
        for (const auto& [low, high] : solid.free_intervals(x, bottom, top)) volume += (high - low) * width;
    }
    return volume;
}

}  // namespace cmps
