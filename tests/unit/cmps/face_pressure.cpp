#include "cmps/face_pressure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "cmps/initial_state.hpp"

namespace {

using cmps::Polygon;
using cmps::Solid;

/// A star-shaped polygon around (0.5, 0.4), corners of any angle; thick enough for walls of `spacing`.
Polygon random_polygon(std::mt19937& random) {
    std::uniform_real_distribution<double> radius(0.1, 0.3), share(0.3, 1.0);
    const int corners = std::uniform_int_distribution<int>(3, 7)(random);
    std::vector<double> angle(1, 0.0);
    for (int i = 0; i < corners; ++i) angle.push_back(angle.back() + share(random));
    Polygon polygon;
    for (int i = 0; i < corners; ++i) {
        const double a = 2 * M_PI * angle[static_cast<std::size_t>(i)] / angle.back(), r = radius(random);
        polygon.push_back({0.5 + r * std::cos(a), 0.4 + r * std::sin(a)});
    }
    return polygon;
}

/// Lift and thrust that still water, 1 m high, makes on a hung body, and its area. The pressure at every wall
/// particle's face is exact.
std::array<double, 3> still_water_force(const Polygon& body, double spacing) {
    Solid solid;
    solid.add(body, 0);
    solid.find_surface({-1, -1}, {2, 2});
    const cmps::Particles particles =
        cmps::make_boundary(cmps::place_boundary(solid, spacing, -1.0, 2.0, 2.0));
    cmps::Settings settings;
    settings.spacing = spacing;
    const cmps::FacePressure faces(particles, solid, settings);
    std::vector<double> at_walls;
    for (std::size_t j = particles.first_wall(); j < particles.first_fluid(); ++j)
        at_walls.push_back(9810 * (1.0 - particles.z[j] - 0.5 * spacing * particles.normal_z[j]));
    const auto [x, z] = faces.force_on(at_walls, 0);
    return {x, z, std::abs(cmps::signed_area(body))};
}

TEST(FacePressure, StillWaterLiftsAnyPolygonByTheWaterItDisplaces) {
    std::mt19937 random(5);
    for (int n = 0; n < 200; ++n)
        for (const double spacing : {0.0125, 0.02, 0.04}) {
            const auto [x, z, area] = still_water_force(random_polygon(random), spacing);
            // round-off: pieces are integrated at their middles, which is exact for a linear pressure
            EXPECT_NEAR(z, 9810 * area, 1e-6 * 9810 * area) << "polygon " << n << ", spacing " << spacing;
            EXPECT_NEAR(x, 0.0, 1e-6 * 9810 * area);
        }
}

TEST(FacePressure, SharpEdgesKeepTheirPart) {
    const auto [x, z, area] = still_water_force({{0.3, 0.3}, {0.7, 0.25}, {0.7, 0.35}}, 0.0125);
    EXPECT_NEAR(z, 9810 * area, 1e-6 * 9810 * area);  // round-off
    EXPECT_NEAR(x, 0.0, 1e-6 * 9810 * area);
}

}  // namespace
