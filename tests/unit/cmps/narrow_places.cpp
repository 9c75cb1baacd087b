#include "cmps/narrow_places.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using cmps::Polygon;
using cmps::Solid;

constexpr double spacing = 0.01, far_above = 10;

/// A body over a floor at z = 0.
Solid above_floor(const Polygon& body) {
    Solid solid;
    solid.add({{-2, -1}, {3, -1}, {3, 0}, {-2, 0}}, cmps::body_bed);
    solid.add(body, 0);
    solid.find_surface({-1.5, -0.5}, {2.5, 2});
    return solid;
}

Polygon rectangle(double x0, double x1, double z0, double z1) {
    return {{x0, z0}, {x1, z0}, {x1, z1}, {x0, z1}};
}

TEST(NarrowPlaces, PlatesBelowThreeSpacingsAreFound) {
    for (const double width : {0.004, 0.02, 0.0299}) {
        const auto place =
            thinnest_body(above_floor(rectangle(0.5, 0.5 + width, 0, 1)), 3 * spacing, spacing, far_above);
        ASSERT_TRUE(place) << width;
        EXPECT_NEAR(place->width, width, 1e-9);  // round-off
        EXPECT_EQ(place->body, 0);
    }
    EXPECT_FALSE(thinnest_body(above_floor(rectangle(0.5, 0.53, 0, 1)), 3 * spacing, spacing, far_above));
}

TEST(NarrowPlaces, OnlyWhatWaterReachesCounts) {
    const Solid solid = above_floor({{0.5, 0}, {1, 0}, {1, 1.5}, {0.98, 1.5}, {0.98, 0.8}, {0.5, 0.8}});
    EXPECT_TRUE(thinnest_body(solid, 3 * spacing, spacing, far_above));
    EXPECT_FALSE(thinnest_body(solid, 3 * spacing, spacing, 0.7));
}

TEST(NarrowPlaces, TipsOfWedgesAreNotThinButBladesAre) {
    for (const double degrees : {14.0, 30.0, 60.0}) {
        const double half = 0.5 * std::tan(0.5 * degrees * M_PI / 180);
        EXPECT_FALSE(thinnest_body(above_floor({{0.2, 0.5}, {0.7, 0.5 - half}, {0.7, 0.5 + half}}),
                                   3 * spacing, spacing, far_above))
            << degrees;
    }
    EXPECT_TRUE(
        thinnest_body(above_floor({{0.2, 0.5}, {0.7, 0.48}, {0.7, 0.52}}), 3 * spacing, spacing, far_above));
}

TEST(NarrowPlaces, BodiesOfTipsOnlyAreThin) {
    // an equilateral triangle of 0.05 m holds a ball of 1.44 spacings' radius; on the floor it is part of
    // more
    EXPECT_TRUE(thinnest_body(above_floor({{0.5, 0.5}, {0.55, 0.5}, {0.525, 0.5433}}), 3 * spacing, spacing,
                              far_above));
    EXPECT_FALSE(
        thinnest_body(above_floor({{0.5, 0}, {0.55, 0}, {0.525, 0.0433}}), 3 * spacing, spacing, far_above));
}

TEST(NarrowPlaces, GapsBelowOneAndAHalfSpacingsAreFound) {
    const auto place = narrowest_gap(above_floor(rectangle(0.5, 0.7, 0.012, 0.5)), spacing, far_above);
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->width, 0.012, 1e-9);  // round-off
    EXPECT_FALSE(narrowest_gap(above_floor(rectangle(0.5, 0.7, 0.0151, 0.5)), spacing, far_above));
    EXPECT_FALSE(narrowest_gap(above_floor(rectangle(0.5, 0.7, 0.0, 0.5)), spacing, far_above));
    EXPECT_FALSE(narrowest_gap(above_floor(rectangle(0.5, 0.7, 1e-6, 0.5)), spacing, far_above));  // rounding
    // a corner of the water, 20 degrees: none
    EXPECT_FALSE(narrowest_gap(above_floor({{0.5, 0}, {1, 0.5 * std::tan(M_PI / 9)}, {0.5, 0.5}}), spacing,
                               far_above));
}

}  // namespace
