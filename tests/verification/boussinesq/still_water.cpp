// Lakes at rest stay at rest, whatever lies under and in them.
#include <gtest/gtest.h>

#include <random>

#include "tests/support/boussinesq_flume.hpp"
#include "tests/support/figures.hpp"

namespace {

using namespace boussinesq_test;

/// Largest speed after `end` seconds of a lake with its surface at `level`.
double speed_of_rest(const Polyline& bed, double spacing, double level, bool dispersion, double end = 20.0,
                     boussinesq::End ends = boussinesq::End::wall) {
    boussinesq::FlowParameters parameters = scaled(1.0);
    parameters.offshore = parameters.shoreward = ends;
    Flume flume(bed, spacing, parameters, {.dispersion = dispersion, .shoreline = true});
    flume.start([&](double) { return level; }, [](double) { return 0.0; });
    const double water = flume.water();
    flume.run_until(end);
    EXPECT_NEAR(flume.water() / water, 1.0, 1e-12);  // half an ulp a stage, 3 x 2000 stages: 7e-13
    EXPECT_EQ(flume.flow.water_made(), 0.0);         // nothing came out below zero
    return flume.largest_speed();
}

Polyline rough_bed(unsigned seed, double roughness) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> level(-1.0 - roughness, -1.0 + roughness);
    Polyline bed;
    for (int i = 0; i <= 100; ++i) bed.push_back({0.2 * i, level(random)});
    return bed;
}

// sqrt(g d) = 3 m/s times 1e-16 times some thousand steps, as a random walk and a margin of ten.
constexpr double round_off = 1e-12;

TEST(StillWater, OverARoughBed) {
    for (const bool dispersion : {false, true}) {
        const double speed = speed_of_rest(rough_bed(1, 0.5), 0.07, 0.0, dispersion);
        std::printf("    rough, dispersion %d: %.1e m/s\n", dispersion, speed);
        EXPECT_LT(speed, round_off);
    }
}

TEST(StillWater, WithIslandsPondsAndDryEnds) {
    for (const bool dispersion : {false, true})
        for (unsigned seed = 1; seed <= 5; ++seed) {
            const double speed = speed_of_rest(rough_bed(seed, 1.5), 0.07, 0.0, dispersion);
            if (seed == 1) std::printf("    islands, dispersion %d: %.1e m/s\n", dispersion, speed);
            EXPECT_LT(speed, round_off) << "seed " << seed;
        }
}

TEST(StillWater, WithVerticalStepsAndNeedles) {
    const Polyline bed{{0, -1},      {4, -1}, {4.0001, -0.2}, {6, -0.2}, {6.0001, 0.5}, {6.2, 0.5},
                       {6.2001, -1}, {9, -1}, {9.05, -0.001}, {9.1, -1}, {12, 0.4}};
    for (const bool dispersion : {false, true}) {
        const double speed = speed_of_rest(bed, 0.05, 0.0, dispersion);
        EXPECT_TRUE(figures::limit("boussinesq",
                                   "lake at rest over steps and islands: largest speed after 20 s", speed,
                                   round_off, "m/s", "round-off of some thousand steps"));
    }
}

TEST(StillWater, AtAnyLevel) {
    for (const double level : {-0.9, -0.37, 0.21, 0.6})
        EXPECT_LT(speed_of_rest(rough_bed(7, 1.0), 0.05, level, true, 10.0), round_off) << level;
}

// The surface beyond an open end is level, whatever the bed does there: sloping up, down, rough, a beach, an
// island.
TEST(StillWater, WithOpenEnds) {
    for (const Polyline& bed :
         {Polyline{{0, -1}, {10, -0.6}}, Polyline{{0, -0.4}, {10, -1}}, rough_bed(3, 0.5),
          Polyline{{0, -1}, {10, 0.2}}, Polyline{{0, -1}, {4, 0.1}, {5, 0.1}, {10, -0.9}}})
        for (const bool dispersion : {false, true}) {
            const double speed = speed_of_rest(bed, 0.05, 0.0, dispersion, 20.0, boussinesq::End::open);
            std::printf("    open ends, bed to %.2f m, dispersion %d: %.1e m/s\n", bed.back()[1], dispersion,
                        speed);
            EXPECT_LT(speed, round_off);
        }
}

}  // namespace
