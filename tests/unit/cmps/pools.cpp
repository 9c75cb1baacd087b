#include "cmps/pools.hpp"

#include <gtest/gtest.h>

#include "cmps/initial_state.hpp"

namespace {

using cmps::Polygon;

constexpr double spacing = 0.02;

/// How far the given water can fall in a box of 1 x 1 m with the given structure.
double fall_of(const std::vector<Polygon>& water, const std::vector<Polygon>& structure = {}) {
    cmps::Solid solid;
    solid.add({{-0.2, -0.2}, {1.2, -0.2}, {1.2, 0}, {-0.2, 0}}, cmps::body_bed);
    solid.add({{-0.2, 0}, {0, 0}, {0, 1.2}, {-0.2, 1.2}}, cmps::body_end_wall);
    solid.add({{1, 0}, {1.2, 0}, {1.2, 1.2}, {1, 1.2}}, cmps::body_end_wall);
    for (const Polygon& polygon : structure) solid.add(polygon, 0);
    solid.find_surface({0, 0}, {1, 1});
    cmps::Particles particles = cmps::make_boundary(cmps::place_boundary(solid, spacing, -0.1, 1.1, 1.0));
    cmps::fill_polygons(solid, spacing, water, {}, particles);
    return cmps::height_to_fall(particles, spacing);
}

Polygon box(double x0, double x1, double z0, double z1) {
    return {{x0, z0}, {x1, z0}, {x1, z1}, {x0, z1}};
}

constexpr double cell = 1.5 * spacing;

TEST(Pools, LevelWaterStands) {
    for (const double level : {0.1, 0.21, 0.304, 0.5})
        EXPECT_LE(fall_of({box(0, 1, 0, level)}), cell) << level;
}

TEST(Pools, WatersThatWallsHoldApartStandAtTheirOwnLevels) {
    const std::vector<Polygon> wall = {box(0.45, 0.45 + 3 * spacing, 0, 0.8)};
    EXPECT_LE(fall_of({box(0, 0.45, 0, 0.5), box(0.45 + 3 * spacing, 1, 0, 0.2)}, wall), cell);
    EXPECT_LE(fall_of({box(0, 0.45, 0, 0.5)}, wall), cell);
}

TEST(Pools, WatersThatAreJoinedBelowFallByWhatTheirLevelsDiffer) {
    const std::vector<Polygon> wall = {box(0.45, 0.55, 0.1, 0.8)};
    EXPECT_LE(fall_of({box(0, 1, 0, 0.3)}, wall), cell);
    const double fall = fall_of({box(0, 0.45, 0, 0.5), box(0.45, 0.55, 0, 0.1), box(0.55, 1, 0, 0.2)}, wall);
    EXPECT_NEAR(fall, 0.3, 2 * cell);
}

TEST(Pools, AColumnFallsByItsHeight) {
    EXPECT_NEAR(fall_of({box(0, 0.3, 0, 0.5)}), 0.5, 2 * cell);
    EXPECT_NEAR(fall_of({box(0.4, 0.6, 0.3, 0.5)}), 0.2, 2 * cell);  // in the air, by its own
}

}  // namespace
