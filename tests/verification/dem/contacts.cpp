/// Exact answers of contacts: Hertz impact, critical damping, friction on an incline.
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/dem_cases.hpp"

namespace {

using dem::Vector;
using dem_cases::World;

constexpr double speed = 0.2;  // m/s, closing speed of the impacts

World two_spheres(double time_step, dem::ContactLaw law = dem::ContactLaw::hertz) {
    World world;
    world.law = law;
    world.time_step = time_step;
    world.material.friction = 0;
    world.add("sphere", Vector(-0.00401, 0, 0), Vector(speed / 2, 0, 0));
    world.add("sphere", Vector(0.00401, 0, 0), Vector(-speed / 2, 0, 0));
    return world;
}

struct Impact {
    double peak_overlap = 0, duration = 0, restitution = 0;
};

/// Steps through an impact. Peak and duration are read off parabolas through the samples, so that they do not
/// snap to steps.
Impact run_impact(const World& world) {
    const auto simulation = world.build();
    simulation->start(0);
    Impact impact;
    double begin = 0, end = 0, before = -1, last = -1;
    const double d = world.element.diameter;
    for (int k = 0; k < 2000000; ++k) {
        simulation->advance(simulation->time() + world.time_step);
        const double overlap = d - (simulation->blocks.position[1] - simulation->blocks.position[0]).norm();
        if (last >= before && last > overlap && last > impact.peak_overlap) {
            const double curvature = overlap - 2 * last + before, slope = 0.5 * (overlap - before);
            impact.peak_overlap = last - 0.5 * slope * slope / curvature;
        }
        // Contact begins and ends at zero overlap: where the straight line through the two samples around it
        // crosses.
        if (last < 0 && overlap >= 0)
            begin = simulation->time() - world.time_step * overlap / (overlap - last);
        if (last >= 0 && overlap < 0 && k > 0) {
            end = simulation->time() - world.time_step * overlap / (overlap - last);
            break;
        }
        before = last;
        last = overlap;
    }
    impact.duration = end - begin;
    impact.restitution = (simulation->blocks.velocity[1] - simulation->blocks.velocity[0]).x() / speed;
    return impact;
}

TEST(HertzImpact, PeakOverlapAndDurationConvergeWithSecondOrder) {
    World world = two_spheres(1);
    world.material.damping_ratio = 0;
    const double mass = world.blocks.mass(0) / 2, radius = world.element.diameter / 4,
                 modulus = world.material.contact_modulus();
    const double peak = std::pow(15 * mass * speed * speed / (16 * modulus * std::sqrt(radius)), 0.4);
    const double duration =
        4 * std::sqrt(std::numbers::pi) * std::tgamma(0.4) / (5 * std::tgamma(0.9)) * peak / speed;
    double previous_peak = 0, previous_duration = 0;
    for (const double share : {1.0 / 20, 1.0 / 40, 1.0 / 80}) {
        world.time_step = share * duration;
        const Impact impact = run_impact(world);
        const double peak_error = impact.peak_overlap / peak - 1,
                     duration_error = impact.duration / duration - 1;
        std::printf("duration / %.0f: peak overlap error %.2e, duration error %.2e, restitution - 1 = %.1e\n",
                    1 / share, peak_error, duration_error, impact.restitution - 1);
        if (previous_peak != 0) {
            // Hertz' force has a kink in its second derivative at touch: the order wavers around 2.
            EXPECT_GT(dem_cases::order(previous_peak, peak_error), 1.5);
            EXPECT_GT(dem_cases::order(previous_duration, duration_error), 1.5);
        }
        previous_peak = peak_error;
        previous_duration = duration_error;
    }
    // Second order at an eightieth of the duration: (pi / 80)^2 / 24 = 6e-5 for a harmonic one, a few times
    // that for Hertz.
    EXPECT_LT(std::abs(previous_peak), 5e-4);
    EXPECT_LT(std::abs(previous_duration), 5e-4);
}

TEST(CriticalDamping, LinearSpringReboundsWithTheSpeedOfTheory) {
    // x = v t exp(-w t); the force k x + c v turns to tension at w t = 2, where the spheres part with exp(-2)
    // of the speed.
    World world = two_spheres(1, dem::ContactLaw::linear);
    for (const double step : {8e-6, 4e-6, 2e-6, 1e-6}) {
        world.time_step = step;
        const double error = run_impact(world).restitution - std::exp(-2.0);
        std::printf("step %.0e s: restitution error %.1e\n", step, error);
        // Dashpots act on velocities half a step old: first order, w dt / 2 with w = 1.1e4 rad/s, and where
        // in a step the spheres first touch is a matter of chance of the same size.
        EXPECT_LT(std::abs(error), 1.1e4 * step);
    }
}

/// m x'' = -(4/3 E* sqrt R) x^1.5 - 2 sqrt(m 2 E* sqrt(R x)) x', in units where both constants and m are 1.
int damped_hertz(double, const double state[], double derivative[], void*) {
    const double x = std::max(state[0], 0.0);
    const double stiffness = 1.5 * std::sqrt(x);
    derivative[0] = state[1];
    derivative[1] = -std::max(0.0, x * std::sqrt(x) + 2 * std::sqrt(stiffness) * state[1]);
    return GSL_SUCCESS;
}

TEST(CriticalDamping, HertzSpringReboundsAsTheOdeSays) {
    gsl_odeiv2_system system{damped_hertz, nullptr, 2, nullptr};
    gsl_odeiv2_driver* driver =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-6, 1e-12, 1e-12);
    double t = 0, state[2] = {0, 1};
    while (state[0] >= 0 && t < 100) gsl_odeiv2_driver_apply(driver, &t, t + 1e-3, state);
    gsl_odeiv2_driver_free(driver);
    const double theory = -state[1];
    World world = two_spheres(1e-6);
    const double measured = run_impact(world).restitution;
    std::printf("restitution %.5f, theory %.5f, error %.1e\n", measured, theory, measured - theory);
    // First order in the step, which is a thousandth of the impact.
    EXPECT_NEAR(measured, theory, 2e-3);
    EXPECT_LT(measured, std::exp(-2.0));  // and less than the linear spring
}

/// A block on a plane under gravity tilted by an angle; returns the distance it slides in `seconds` after
/// settling.
struct Slide {
    double distance, acceleration;
};
Slide slide(double tangent_over_friction, double seconds) {
    World world;
    world.time_step = 5e-5;
    const double angle = std::atan(tangent_over_friction * world.material.friction);
    world.surroundings.planes.push_back({Vector(0, 0, 0), Vector(0, 0, 1)});
    world.add("beehive96", Vector(0, 0, 0.012));
    world.gravity = Vector(0, 0, -9.81 * std::cos(angle));
    auto simulation = world.build();
    simulation->start(0);
    simulation->advance(0.5);
    // The slope is tilted once the block rests.
    World tilted = world;
    tilted.blocks = simulation->blocks;
    tilted.gravity = Vector(9.81 * std::sin(angle), 0, -9.81 * std::cos(angle));
    auto sliding = tilted.build();
    auto memory = sliding->memory();
    memory.pairs = simulation->memory().pairs;
    sliding->restore(memory);
    sliding->start(0);
    sliding->advance(0.5);  // the load is taken up, and a slide is under way
    const double x = sliding->blocks.position[0].x(), v = sliding->blocks.velocity[0].x();
    sliding->advance(0.5 + seconds);
    return {sliding->blocks.position[0].x() - x, (sliding->blocks.velocity[0].x() - v) / seconds};
}

TEST(Incline, BelowTheFrictionAngleNothingCreeps) {
    for (const double share : {0.5, 0.9, 0.99}) {
        const Slide found = slide(share, 2.0);
        std::printf("tan(angle) = %.2f mu: slid %.2e d in 2 s\n", share, found.distance / 0.008);
        EXPECT_LT(std::abs(found.distance), 1e-9);  // m: a millionth of the elastic give
    }
}

TEST(Incline, AboveTheFrictionAngleItSlidesWithTheRightAcceleration) {
    for (const double ratio : {1.01, 1.1, 1.5}) {
        const Slide found = slide(ratio, 0.5);
        const double angle = std::atan(ratio * 0.577),
                     theory = 9.81 * (std::sin(angle) - 0.577 * std::cos(angle));
        std::printf("tan(angle) = %.2f mu: acceleration error %.2e\n", ratio,
                    found.acceleration / theory - 1);
        EXPECT_NEAR(found.acceleration, theory, 1e-3 * 9.81);  // jitter of the normal force
    }
}

TEST(Contacts, MomentumAndAngularMomentumOfAnIsolatedCollisionAreKept) {
    World world;
    world.time_step = 2e-5;
    world.add("beehive96", Vector(0, 0, 0), Vector(0.3, 0, 0), false, dem::Quaternion::Identity(),
              Vector(1, 2, 3));
    world.add("tetrapod", Vector(0.06, 0.01, 0.005), Vector(-0.5, 0, 0));
    const auto simulation = world.build();
    simulation->start(0);
    const auto sums = [&] {
        Vector momentum = Vector::Zero(), angular = Vector::Zero();
        for (std::size_t i = 0; i < 2; ++i) {
            const Vector p = simulation->blocks.mass(i) * simulation->blocks.velocity[i];
            momentum += p;
            angular += simulation->blocks.position[i].cross(p) + simulation->blocks.angular_momentum[i];
        }
        return std::pair(momentum, angular);
    };
    const auto [momentum, angular] = sums();
    simulation->advance(0.2);
    EXPECT_GT(simulation->energy().dissipated, 0) << "they must have hit";
    EXPECT_LT((sums().first - momentum).norm(), 1e-15);  // kg m/s: rounding of 1e4 steps
    EXPECT_LT((sums().second - angular).norm(), 1e-15);
}

TEST(Energy, BudgetOfADampedTumbleClosesWithTheTimeStep) {
    double previous = 0;
    for (const double step : {1e-4, 5e-5, 2.5e-5}) {
        World world;
        world.time_step = step;
        world.gravity = Vector(0, 0, -9.81);
        world.surroundings.planes.push_back({Vector(0, 0, 0), Vector(0, 0, 1)});
        world.add("beehive96", Vector(0, 0, 0.08), Vector(0.2, 0, 0), false,
                  dem::Quaternion(Eigen::AngleAxisd(0.5, Vector(1, 2, 0).normalized())));
        const auto simulation = world.build();
        simulation->start(0);
        const double first = simulation->energy().balance();
        simulation->advance(0.6);
        const double error = (simulation->energy().balance() - first) / simulation->energy().dissipated;
        std::printf("step %.1e s: energy balance off by %.2e of what was dissipated\n", step, error);
        if (previous != 0) {
            EXPECT_LT(std::abs(error), std::abs(previous));
        }
        previous = error;
    }
    EXPECT_LT(std::abs(previous), 0.005);  // first order; 1 % at the default step, in one hard fall
}

}  // namespace
