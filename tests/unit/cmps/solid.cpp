#include "cmps/solid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cmps/initial_state.hpp"

namespace {

using cmps::Polygon;
using cmps::Solid;

/// A floor with a block on it: the block's underside and the floor below it are not exposed.
Solid floor_with_block() {
    Solid solid;
    solid.add({{-1, -1}, {2, -1}, {2, 0}, {-1, 0}}, cmps::body_bed);
    solid.add({{0.4, 0}, {0.6, 0}, {0.6, 0.3}, {0.4, 0.3}}, 0);
    solid.find_surface({-0.5, -0.5}, {1.5, 1.0});
    return solid;
}

double exposed_length(const Solid& solid, std::int32_t body) {
    double sum = 0;
    for (const auto& s : solid.surface())
        if (s.body == body) sum += std::hypot(s.to[0] - s.from[0], s.to[1] - s.from[1]);
    return sum;
}

TEST(Solid, OnlyFacesThatWaterCanTouchAreExposed) {
    const Solid solid = floor_with_block();
    EXPECT_NEAR(exposed_length(solid, cmps::body_bed), 2.0 - 0.2, 1e-9);  // cut to the box; round-off
    EXPECT_NEAR(exposed_length(solid, 0), 0.3 + 0.2 + 0.3, 1e-9);
}

TEST(Solid, OrientationDoesNotMatter) {
    Solid solid;
    solid.add({{-1, 0}, {2, 0}, {2, -1}, {-1, -1}}, cmps::body_bed);
    solid.find_surface({-0.5, -0.5}, {1.5, 1.0});
    ASSERT_EQ(solid.surface().size(), 1u);
    EXPECT_NEAR(solid.surface()[0].normal[1], 1.0, 1e-12);
}

TEST(Solid, AFaceThatTwoPolygonsShareIsThereOnce) {
    const Polygon low = {{0.4, 0}, {0.6, 0}, {0.6, 0.3}, {0.4, 0.3}},
                  high = {{0.4, 0}, {0.5, 0}, {0.5, 0.5}, {0.4, 0.5}};
    for (const bool is_low_first : {true, false}) {
        Solid solid;
        solid.add({{-1, -1}, {2, -1}, {2, 0}, {-1, 0}}, cmps::body_bed);
        solid.add(is_low_first ? low : high, 0), solid.add(is_low_first ? high : low, 1);
        solid.find_surface({-0.5, -0.5}, {1.5, 1.0});
        // offshore side 0.5 high, steps of 0.1, 0.2, 0.1, 0.3 down to the floor
        EXPECT_NEAR(exposed_length(solid, 0) + exposed_length(solid, 1), 1.2, 1e-9);
        EXPECT_NEAR(exposed_length(solid, cmps::body_bed), 2.0 - 0.2, 1e-9);
    }
}

TEST(Solid, FreeIntervals) {
    const auto above_block = floor_with_block().free_intervals(0.5, -0.5, 1.0);
    ASSERT_EQ(above_block.size(), 1u);
    EXPECT_NEAR(above_block[0][0], 0.3, 1e-12);
    EXPECT_NEAR(above_block[0][1], 1.0, 1e-12);
}

TEST(Solid, CrossingPolygonsAreFound) {
    std::array<std::size_t, 2> where{};
    EXPECT_TRUE(cmps::crosses_itself({{0, 0}, {1, 1}, {1, 0}, {0, 1}}, where));
    EXPECT_EQ(where[0], 1u);
    EXPECT_EQ(where[1], 3u);
    EXPECT_FALSE(cmps::crosses_itself({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, where));
}

TEST(Solid, OverlapIsMoreThanASharedBorder) {
    const cmps::Polygon triangle = {{0, 0}, {0.4, 0}, {0, 0.4}}, square = {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                        beside = {{1, 0}, {2, 0}, {2, 1}, {1, 1}}, above = {{0.4, 0}, {0.4, 0.4}, {0, 0.4}},
                        within = {{0.5, 0.5}, {0.6, 0.5}, {0.6, 0.9}},
                        cross = {{-1, 0.4}, {2, 0.4}, {2, 0.6}, {-1, 0.6}};
    EXPECT_TRUE(cmps::overlap(triangle, triangle));
    EXPECT_TRUE(cmps::overlap(triangle, square));
    EXPECT_TRUE(cmps::overlap(square, within));
    EXPECT_TRUE(cmps::overlap(square, cross));
    EXPECT_FALSE(cmps::overlap(square, beside));
    EXPECT_FALSE(cmps::overlap(triangle, above));
}

TEST(Solid, FoldsAreFound) {
    std::size_t where = 0;
    EXPECT_TRUE(cmps::folds_back({{0.3, 0.1}, {0.7, 0.1}, {0.7, 0.3}, {0.7, 0.1}, {0.5, 0.05}}, where));
    EXPECT_EQ(where, 3u);
    EXPECT_TRUE(cmps::folds_back({{0.3, 0.1}, {0.7, 0.1}, {0.5, 0.1}}, where));
    EXPECT_FALSE(cmps::folds_back({{0, 0}, {0.5, 0}, {1, 0}, {1, 1}}, where));
}

/// At every point just inside the water of a wedge of any angle, the boundary fills the kernel as a lattice
/// would.
class Corner : public testing::TestWithParam<double> {};

TEST_P(Corner, HasNoHoleThatLetsWaterThrough) {
    const double angle = GetParam() * M_PI / 180, l0 = 0.01;
    Solid solid;  // floor, and a slope that rises from the origin at `angle` from the floor
    solid.add({{-2, -1}, {2, -1}, {2, 0}, {-2, 0}}, cmps::body_bed);
    solid.add({{0, 0}, {std::cos(angle), std::sin(angle)}, {-1.9, std::sin(angle)}, {-1.9, 0}}, 0);
    solid.find_surface({-1.5, -0.5}, {1.5, 0.5});
    const auto placed = cmps::place_boundary(solid, l0, -0.5, 0.5, 0.4);
    // along both faces, every point of the surface has a wall particle within 0.87 l0: half a spacing behind
    // it and at most 0.7 l0 to the side, so that no particle of diameter l0 fits between two of them
    for (const double s : {0.002, 0.005, 0.01, 0.02, 0.03, 0.05, 0.1, 0.15})
        for (const auto& [x, z] :
             {std::array{s, 0.0}, std::array{s * std::cos(angle), s * std::sin(angle)}}) {
            double nearest = 1;
            for (const auto& p : placed)
                if (p.carries_pressure) nearest = std::min(nearest, std::hypot(p.x - x, p.z - z));
            EXPECT_LT(nearest, 0.87 * l0) << "at " << x << ", " << z;
        }
    for (std::size_t a = 0; a < placed.size(); ++a)
        for (std::size_t b = a + 1; b < placed.size(); ++b)
            EXPECT_GE(std::hypot(placed[a].x - placed[b].x, placed[a].z - placed[b].z),
                      0.7 * l0 * (1 - 1e-9));
}

INSTANTIATE_TEST_SUITE_P(Angles, Corner, testing::Values(20.0, 35.0, 63.4, 90.0, 120.0, 153.4));

/// A hung wedge of any angle, faces of unequal length: no water finds its tip empty.
class Edge : public testing::TestWithParam<double> {};

TEST_P(Edge, IsFilledToItsTip) {
    const double half = 0.5 * GetParam() * M_PI / 180, l0 = 0.01, length = 0.31, other = 0.277;
    Solid solid;
    solid.add({{0, 0},
               {length * std::cos(half), -length * std::sin(half)},
               {other * std::cos(half), other * std::sin(half)}},
              0);
    solid.find_surface({-1, -1}, {1, 1});
    const auto placed = cmps::place_boundary(solid, l0, -1, 1, 1);
    for (const double side : {-1.0, 1.0})
        for (double s = 0.0; s < 0.2; s += 0.001) {
            double nearest = 1;
            for (const auto& p : placed)
                if (p.carries_pressure)
                    nearest = std::min(nearest,
                                       std::hypot(p.x - s * std::cos(half), p.z - side * s * std::sin(half)));
            // half a lattice step along the face, and 0.71 l0 behind it where two sides share a row
            EXPECT_LT(nearest, std::hypot(0.65, 0.72) * l0) << "at " << s << " from the tip, side " << side;
        }
    for (std::size_t a = 0; a < placed.size(); ++a)
        for (std::size_t b = a + 1; b < placed.size(); ++b)
            EXPECT_GE(std::hypot(placed[a].x - placed[b].x, placed[a].z - placed[b].z), 0.69 * l0);
}

INSTANTIATE_TEST_SUITE_P(Angles, Edge, testing::Values(14.0, 20.0, 28.0, 37.0, 45.0, 60.0, 75.0, 90.0));

TEST(InitialState, AreaOfTheWaterIsKeptToOneParticle) {
    const double l0 = 0.013;
    Solid solid;  // 1:2 slope
    solid.add({{-1, -1}, {2, -1}, {2, 0}, {1, 0}, {0.4, -0.3}, {-1, -0.3}}, cmps::body_bed);
    solid.find_surface({-0.5, -0.9}, {1.5, 1.0});
    cmps::Particles particles;
    cmps::fill_water(
        solid, l0, 0.0, 1.0, [&](double x) { return solid.free_intervals(x, -0.5, 0.1); }, particles);
    const double area = 0.4 * 0.4 + 0.6 * (0.4 + 0.1) / 2;
    EXPECT_NEAR(static_cast<double>(particles.fluid) * l0 * l0, area,
                1.5 * l0 * l0 + 0.5 * l0 * l0);  // one particle, and the slope seen at column centres
}

}  // namespace
