/// Figures a run states about itself: closure of the energy budget, damage number, time-step limit of wires.
#include <gtest/gtest.h>

#include <cmath>

#include "dem/damage.hpp"
#include "dem/report.hpp"
#include "tests/support/dem_cases.hpp"

namespace {

using dem::Vector;
using dem_cases::World;

TEST(EnergyClosure, ABounceHalfAPercentTooHighIsSeenWhereNothingIsDissipated) {
    // A sphere of unit weight, dropped from rest at 1 m, at the top of its first bounce.
    const dem::EnergyBudget first{.potential = 1};
    const dem::EnergyBudget top{.potential = 1.005, .largest_kinetic = 1};
    EXPECT_NEAR(dem::closure_error(top, first), 0.005, 1e-12);  // rounding
    const dem::EnergyBudget exact{.potential = 1, .largest_kinetic = 1};
    EXPECT_EQ(dem::closure_error(exact, first), 0);
}

TEST(EnergyClosure, IsThatOfThisRunAloneWhenItGoesOnFromAnother) {
    const dem::EnergyBudget first{.potential = 1, .dissipated = 50, .water_work = 49, .gross_water_work = 80};
    const dem::EnergyBudget later{.potential = 1,
                                  .dissipated = 50,
                                  .water_work = 48.9,
                                  .gross_water_work = 80.9,
                                  .largest_kinetic = 0.1};
    // 0.1 J missing of 0.9 J of the water and 0.1 J of motion; rounding of 50.
    EXPECT_NEAR(dem::closure_error(later, first), 0.1, 1e-12);
}

TEST(Damage, BlocksOfSeveralLengthsCountWithTheirOwn) {
    World world;
    for (int k = 0; k < 4; ++k) world.add("beehive96", Vector(0, 0.1 * k, 0));
    world.add("sphere", Vector(0, 0.5, 0));
    std::vector<dem::Displacement> moved(5, {0.03, 0.03, 0});  // beyond half of either length
    // Strips of the width, 1 m: four of 48 mm and one of 8 mm.
    EXPECT_NEAR(dem::assess_damage(world.blocks, moved, 1).number, 0.2, 1e-12);
    moved[4].total = 0;
    EXPECT_NEAR(dem::assess_damage(world.blocks, moved, 1).number, 4 / (1 / 0.048), 1e-12);
    moved[0].total = 0.02;  // short of half a length
    EXPECT_NEAR(dem::assess_damage(world.blocks, moved, 1).number, 3 / (1 / 0.048), 1e-12);
}

TEST(TimeStepLimit, OfWiresIsThatOfTheStiffestBlock) {
    World world;
    for (int k = 0; k < 4; ++k) world.add("sphere", Vector(0.02 * k, 0, 0));
    const auto simulation = world.build();
    dem::Wires wires;
    wires.longest_stretch = 1;
    for (std::uint32_t k = 0; k < 3; ++k) wires.add(k, 0, k + 1, 0, 0.02, 100.0 * (k + 1));
    simulation->mount_wires(wires);
    // The third sphere holds 200 and 300 N/m in one line; neighbours that move as well double them.
    const double mass = world.blocks.mass(2);
    EXPECT_NEAR(simulation->stable_time_step() / (2 / std::sqrt(2 * 500 / mass)), std::sqrt(0.1),
                1e-9);  // of eigenvalues
    simulation->wires.is_intact[2] = 0;
    EXPECT_NEAR(simulation->stable_time_step() / (2 / std::sqrt(2 * 300 / mass)), std::sqrt(0.1), 1e-9);
}

}  // namespace
