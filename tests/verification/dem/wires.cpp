/// Exact answers of wires, eq. (13): oscillation period, breaking at r_max, a hanging chain, momentum of a
/// wired cluster.
#include <gsl/gsl_integration.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/dem_cases.hpp"

namespace {

using dem::Vector;
using dem::WireLaw;
using dem::Wires;
using dem_cases::World;

Wires one_wire(WireLaw law, double rest_length, double stiffness, double longest_stretch = 1) {
    Wires wires;
    wires.law = law;
    wires.longest_stretch = longest_stretch;
    wires.add(0, 0, 1, 0, rest_length, stiffness);
    return wires;
}

struct Quadrature {
    const Wires* wires;
    double furthest, mass;
};

/// Half a swing taut: from r0 to `furthest`, dr / v with v from the energy; r = r0 + (far - r0) sin(a) takes
/// the root away.
double swing_time(double angle, void* data) {
    const auto& q = *static_cast<Quadrature*>(data);
    const double r0 = q.wires->rest_length[0], span = q.furthest - r0;
    const double r = r0 + span * std::sin(angle);
    const double energy = q.wires->energy_at(0, q.furthest) - q.wires->energy_at(0, r);
    return energy > 0 ? span * std::cos(angle) / std::sqrt(2 * energy / q.mass) : 0.0;
}

class WirePeriod : public ::testing::TestWithParam<WireLaw> {};

TEST_P(WirePeriod, TautHalfSwingTakesTheTimeOfTheQuadrature) {
    const double r0 = 0.02, start = 0.0215, k = 500;
    World world;
    world.add("sphere", Vector(0, 0, 0));
    world.add("sphere", Vector(start, 0, 0));
    const Wires wires = one_wire(GetParam(), r0, k);
    Quadrature data{&wires, start, world.blocks.mass(0) / 2};
    // Near the turning point the energy difference is all rounding; 1e-8 is what the quadrature can promise.
    gsl_integration_workspace* workspace = gsl_integration_workspace_alloc(1000);
    gsl_function function{swing_time, &data};
    double theory = 0, error = 0;
    gsl_integration_qag(&function, 0, std::numbers::pi / 2, 0, 1e-8, 1000, GSL_INTEG_GAUSS21, workspace,
                        &theory, &error);
    gsl_integration_workspace_free(workspace);

    double previous = 0;
    for (const int steps : {100, 200, 400}) {
        world.time_step = theory / (steps + 0.37);  // no step falls on the end of the swing
        const auto simulation = world.build();
        simulation->mount_wires(wires);
        simulation->start(0);
        double slack_at = 0, last = start;
        while (slack_at == 0) {
            simulation->advance(simulation->time() + world.time_step);
            const double r = (simulation->blocks.position[1] - simulation->blocks.position[0]).norm();
            if (r < r0) slack_at = simulation->time() - world.time_step * (r0 - r) / (last - r);
            last = r;
        }
        const double found = slack_at / theory - 1;
        std::printf("%d steps: error of the time to slack %.2e\n", steps, found);
        if (previous != 0) {
            EXPECT_GT(dem_cases::order(previous, found), 1.6);  // second order, read off by a straight line
        }
        previous = found;
    }
    EXPECT_LT(std::abs(previous), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(BothReadings, WirePeriod, ::testing::Values(WireLaw::hooke, WireLaw::progressive));

TEST(WireBreaking, HoldsAtTheLongestLengthAndBreaksBeyondIt) {
    World world;
    world.add("sphere", Vector(0, 0, 0));
    world.add("sphere", Vector(0.02, 0, 0));
    const double r0 = 0.015625, stretch = 0.00390625;  // both exact in binary: r_max = 0.01953125
    // r_max is known to the rounding of r0 + psi d and of the places of the ends: 1e-12 of it is still r_max.
    for (const auto& [r, intact] : {std::pair{r0 + stretch, true},
                                    {std::nextafter(r0 + stretch, 1.0), true},
                                    {(r0 + stretch) * (1 + 2e-12), false}}) {
        Wires wires = one_wire(WireLaw::hooke, r0, 100, stretch);
        world.blocks.position[1].x() = r;
        wires.pull(world.blocks, 1.5);
        EXPECT_EQ(wires.is_intact[0] != 0, intact) << r;
        EXPECT_EQ(wires.tension[0], intact ? 100 * (r - r0) : 0.0);
        EXPECT_EQ(wires.broken_at[0], intact ? -1.0 : 1.5);
    }
}

TEST(WireBreaking, StaysBrokenAndNeverPushes) {
    World world;
    world.add("sphere", Vector(0, 0, 0));
    world.add("sphere", Vector(0.03, 0, 0));
    Wires wires = one_wire(WireLaw::hooke, 0.02, 100, 0.001);
    world.blocks.position[1].x() = 0.018;  // shorter than r0
    wires.pull(world.blocks, 0);
    EXPECT_EQ(wires.tension[0], 0);
    EXPECT_EQ(world.blocks.force[0], Vector(0, 0, 0));
    world.blocks.position[1].x() = 0.03;
    wires.pull(world.blocks, 1);
    world.blocks.position[1].x() = 0.0205;
    wires.pull(world.blocks, 2);
    EXPECT_EQ(wires.is_intact[0], 0);
    EXPECT_EQ(wires.tension[0], 0);
    EXPECT_EQ(wires.broken_at[0], 1);
}

TEST(Wires, LawsDifferAsTheDesignSays) {
    const double r0 = 0.012, r = r0 + 0.3 * 0.008, k = 4395;
    const Wires hooke = one_wire(WireLaw::hooke, r0, k), progressive = one_wire(WireLaw::progressive, r0, k);
    EXPECT_DOUBLE_EQ(hooke.tension_at(0, r), k * (1 - r0 / r) * r);  // k_wire times the vector of length r
    EXPECT_DOUBLE_EQ(progressive.tension_at(0, r), k * (1 - r0 / r) * (r - r0));  // k_wire times the stretch
    EXPECT_NEAR(hooke.tension_at(0, r) / progressive.tension_at(0, r), 6, 1e-9);
}

TEST(HangingChain, EachWireCarriesTheWeightBelow) {
    constexpr std::size_t count = 6;
    World world;
    world.gravity = Vector(0, 0, -9.81);
    world.time_step = 1e-4;
    world.wet = true;  // drag brings the chain to rest
    world.water.viscosity = 1e-2;
    world.motion.surface = false;
    Wires wires;
    wires.longest_stretch = 1;
    for (std::size_t i = 0; i < count; ++i)
        world.add("sphere", Vector(0, 0, -0.02 * static_cast<double>(i) - 1), Vector::Zero(), i == 0);
    for (std::uint32_t i = 0; i + 1 < count; ++i) wires.add(i, 0, i + 1, 0, 0.02, 200);
    const auto simulation = world.build();
    simulation->mount_wires(wires);
    simulation->start(0);
    simulation->advance(10);
    const double weight = 1000 * (3.689 - 1) * world.element.volume() * 9.81;
    for (std::size_t k = 0; k + 1 < count; ++k) {
        const double expected = static_cast<double>(count - 1 - k) * weight;
        std::printf("wire %zu: tension error %.1e\n", k + 1, simulation->wires.tension[k] / expected - 1);
        EXPECT_NEAR(simulation->wires.tension[k], expected,
                    1e-6 * expected);  // what is left of the swing after 10 s
    }
}

TEST(WiredCluster, KeepsMomentumAndAngularMomentum) {
    World world;
    world.time_step = 5e-5;
    world.add("beehive96", Vector(0, 0, 0), Vector(0.1, 0, 0));
    world.add("beehive96", Vector(0, 0.06, 0), Vector(-0.2, 0.3, 0.1), false, dem::Quaternion::Identity(),
              Vector(3, 0, 1));
    world.add("beehive96", Vector(0, 0.12, 0), Vector(0, 0, -0.2));
    Wires wires;
    wires.longest_stretch = 0.1;
    for (std::uint32_t pair = 0; pair < 2; ++pair)
        for (const auto& place : dem::facing_spheres(world.blocks, pair, pair + 1))
            wires.add(place.block_a, place.sphere_a, place.block_b, place.sphere_b, 0.02, 300);
    const auto simulation = world.build();
    simulation->mount_wires(wires);
    simulation->start(0);
    const auto sums = [&] {
        Vector momentum = Vector::Zero(), angular = Vector::Zero();
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector p = simulation->blocks.mass(i) * simulation->blocks.velocity[i];
            momentum += p;
            angular += simulation->blocks.position[i].cross(p) + simulation->blocks.angular_momentum[i];
        }
        return std::pair(momentum, angular);
    };
    const auto [momentum, angular] = sums();
    simulation->advance(1);
    EXPECT_GT(simulation->wires.largest_tension[0], 0);
    // Rounding of 2e4 steps with forces of some newtons.
    EXPECT_LT((sums().first - momentum).norm(), 1e-13);
    EXPECT_LT((sums().second - angular).norm(), 1e-14);
}

/// Two plates fly apart on 18 parallel wires: at the limit of the step they come back with their energy to
/// within the share that it promises, at whatever point of a step the wires tighten; twice past it they do
/// not.
TEST(WireStepLimit, ParallelWiresGiveBackWhatTheyTook) {
    const auto largest_change = [](double steps_of_limit) {
        double worst = 0;
        for (int phase = 0; phase < 20; ++phase) {
            World world;
            world.time_step = 1e-4;
            const double start = 0.06, speed = 0.1;
            world.add("beehive96", Vector(0, 0, 0), Vector(-speed, 0, 0));
            world.add("beehive96", Vector(start, 0, 0), Vector(speed, 0, 0));
            Wires wires;
            wires.longest_stretch = 1;
            for (std::uint32_t k = 0; k < 18; ++k) wires.add(0, k, 1, k, 1, 5e5);
            auto probe = world.build();
            probe->mount_wires(wires);
            world.time_step = steps_of_limit * probe->step_limit().time_step;
            for (std::uint32_t k = 0; k < 18; ++k)
                wires.rest_length[k] = start + 2 * speed * world.time_step * (3 + phase / 20.0);
            const auto simulation = world.build();
            simulation->mount_wires(wires);
            simulation->start(0);
            const double energy = simulation->energy().kinetic;
            simulation->advance(20 * world.time_step / std::min(1.0, steps_of_limit));
            EXPECT_LT(simulation->blocks.velocity[1].x(), 0) << "they come back";
            worst = std::max(worst, std::abs(simulation->energy().kinetic / energy - 1));
        }
        return worst;
    };
    EXPECT_LE(largest_change(1), 0.1);
    // The bound counts that the plates may turn as well, which these do not.
    EXPECT_GE(largest_change(1), 0.04) << "the limit is no smaller than it need be";
    EXPECT_GE(largest_change(2), 0.15);
}

}  // namespace
