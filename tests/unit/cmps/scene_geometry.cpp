#include "cmps/scene_geometry.hpp"

#include <gtest/gtest.h>

namespace {

using cmps::Polygon;
using cmps::Scene;

const Polygon hung = {{8.0, -0.15}, {8.2, -0.15}, {8.2, 0.10}, {8.0, 0.10}};
const Polygon caisson = {{9.5, -0.4}, {9.8, -0.4}, {9.8, 0.10}, {9.5, 0.10}};
const Polygon sill = {{7.0, -0.4}, {7.4, -0.4}, {7.4, -0.2}, {7.0, -0.2}};

Scene flume(const std::vector<Polygon>& structure) {
    Scene scene;
    scene.bed = {{0, -0.4}, {14, -0.4}};
    scene.offshore = 5, scene.onshore = 11;
    scene.settings.spacing = 0.02, scene.settings.depth = 0.4;
    scene.structure = structure;
    return scene;
}

TEST(SceneGeometry, WaterPassesUnderWhatHangsFreeOfTheBed) {
    for (const auto& structure :
         {std::vector{hung, caisson}, std::vector{caisson, hung}, std::vector{sill, caisson, hung}}) {
        const Scene scene = flume(structure);
        const cmps::Solid solid = make_solid(scene);
        EXPECT_NEAR(end_of_water(scene, solid), 9.5, 1e-6);  // found by halving
        EXPECT_NEAR(rear_of_structure(scene, solid), 9.8, 1e-12);
        ASSERT_EQ(barriers(scene, solid).size(), 1u);
        EXPECT_EQ(structure[barriers(scene, solid)[0]], caisson);
    }
}

TEST(SceneGeometry, RoundedCoordinatesLetNoWaterThrough) {
    Polygon above_bed = caisson;
    for (auto& point : above_bed) point[1] = std::max(point[1], -0.4 + 1e-6);
    const Scene scene = flume({above_bed});
    EXPECT_NEAR(end_of_water(scene, make_solid(scene)), 9.5, 1e-6);
    EXPECT_NEAR(rear_of_structure(scene, make_solid(scene)), 9.8, 1e-12);
}

TEST(SceneGeometry, TheBarrierFarthestShorewardEndsTheStructure) {
    const Polygon second = {{10.2, -0.4}, {10.5, -0.4}, {10.5, 0.05}, {10.2, 0.05}};
    for (const auto& structure : {std::vector{second, caisson}, std::vector{caisson, second}}) {
        const Scene scene = flume(structure);
        EXPECT_NEAR(rear_of_structure(scene, make_solid(scene)), 10.5, 1e-12);
        EXPECT_NEAR(end_of_water(scene, make_solid(scene)), 9.5, 1e-6);
    }
}

TEST(SceneGeometry, NothingHoldsBackWaterThatPassesBelow) {
    const Scene scene = flume({hung, sill});
    const cmps::Solid solid = make_solid(scene);
    EXPECT_TRUE(barriers(scene, solid).empty());
    EXPECT_EQ(end_of_water(scene, solid), 11.0);
    EXPECT_EQ(rear_of_structure(scene, solid), 11.0);
}

double highest_wall(const cmps::Particles& particles) {
    double top = -1e300;
    for (std::size_t i = 0; i < particles.first_fluid(); ++i)
        if (particles.body[i] == cmps::body_moving_wall) top = std::max(top, particles.z[i]);
    return top;
}

TEST(SceneGeometry, APistonStandsWhereItsPathBeginsAndAboveTheWater) {
    Scene scene = flume({});
    scene.bed = {{0, 0}, {14, 0}};
    scene.drive = cmps::Drive::piston;
    scene.piston = {.start = 0.3, .least = -2.0, .most = 0.3, .fastest = 1.0};
    scene.water = {{{5.3, 0}, {11, 0}, {11, 0.4}, {5.3, 0.4}}};
    const cmps::Solid solid = make_solid(scene);
    const auto particles = initial_particles(scene, solid, nullptr);
    EXPECT_GT(highest_wall(particles), 0.4 + 0.25);  // v sqrt(h/g) + v2/2g
    double right = -1e300, left = 1e300;
    for (std::size_t i = 0; i < particles.first_fluid(); ++i)
        if (particles.body[i] == cmps::body_moving_wall)
            right = std::max(right, particles.x[i]);
        else
            left = std::min(left, particles.x[i]);
    EXPECT_NEAR(right, 5.3 - 0.01, 1e-12);
    EXPECT_LT(left, 5.0 - 2.0);  // the bed goes on below it wherever it retreats
}

TEST(SceneGeometry, APistonStandsInPlaceOfTheTanksWall) {
    Scene scene = flume({});
    scene.bed.clear();
    scene.tank = {5, 11, -0.4, 1.0};
    scene.drive = cmps::Drive::piston;
    scene.piston = {.least = -0.5, .most = 0.5, .fastest = 0.5};
    const cmps::Solid solid = make_solid(scene);
    EXPECT_FALSE(solid.contains(4.95, 0.0));
    EXPECT_TRUE(solid.contains(4.6, -0.41));
    scene.drive = cmps::Drive::none;
    EXPECT_TRUE(make_solid(scene).contains(4.95, 0.0));
}

TEST(SceneGeometry, WaterFillsNarrowChannelsToItsLevel) {
    for (const double width : {0.03, 0.056, 0.1, 0.106, 0.2}) {
        Scene scene = flume({});
        scene.bed.clear();
        scene.tank = {0, 1, 0, 0.8};
        scene.offshore = 0, scene.onshore = 1, scene.settings.spacing = 0.0125;
        scene.drive = cmps::Drive::none;
        const double left = 0.5 - 0.5 * width, right = 0.5 + 0.5 * width;
        scene.structure = {{{0, 0}, {left, 0}, {left, 0.8}, {0, 0.8}},
                           {{right, 0}, {1, 0}, {1, 0.8}, {right, 0.8}}};
        scene.water = {{{0, 0}, {1, 0}, {1, 0.4}, {0, 0.4}}};
        const cmps::Solid solid = make_solid(scene);
        const auto particles = initial_particles(scene, solid, nullptr);
        const double l0 = scene.settings.spacing, area = 0.4 * width;
        EXPECT_NEAR(initial_area(scene, solid, nullptr), area, 1e-9);  // round-off: vertical faces
        EXPECT_NEAR(static_cast<double>(particles.fluid) * l0 * l0, area, 0.51 * l0 * l0);  // half a particle
        for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i) {
            EXPECT_GT(particles.x[i], left + 0.33 * l0);  // columns stand half their width off the faces
            EXPECT_LT(particles.x[i], right - 0.33 * l0);
        }
    }
}

TEST(SceneGeometry, OneDropIsOneParticle) {
    Scene scene = flume({});
    scene.bed.clear();
    scene.tank = {0, 1, 0, 1};
    scene.offshore = 0, scene.onshore = 1;
    scene.drive = cmps::Drive::none;
    scene.water = {{{0.5, 0.5}, {0.52, 0.5}, {0.52, 0.52}, {0.5, 0.52}}};
    EXPECT_EQ(initial_particles(scene, make_solid(scene), nullptr).fluid, 1u);
}

}  // namespace
