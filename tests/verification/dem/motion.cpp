/// Exact answers of motion: free fall in still water, the free rotor, PMS and Newton-Euler, drag of a moving
/// current.
#include <gtest/gtest.h>

#include <cmath>

#include "dem/motion.hpp"
#include "tests/support/dem_cases.hpp"

namespace {

using dem::Quaternion;
using dem::Vector;
using dem_cases::World;

/// Archimedes: the cap below the surface, (3 - 2 x) x^2 of the sphere when x of its diameter is immersed,
/// displaces the sphere's weight.
TEST(Floating, SphereLiesWhereItsCapCarriesIt) {
    for (const double s : {0.1, 0.3, 0.5, 0.7, 0.9}) {
        double dry = 0, wet = 1;  // immersed shares between which the cap's is s
        while (wet - dry > 1e-15) {
            const double x = 0.5 * (dry + wet);
            ((3 - 2 * x) * x * x < s ? dry : wet) = x;
        }
        World world;
        world.wet = true;
        world.gravity = Vector(0, 0, -9.81);
        world.time_step = 2e-4;
        world.element.density_ratio = s;
        world.water.viscosity = 1e-3;  // brings it to rest
        const double d = world.element.diameter, expected = (0.5 - wet) * d;
        world.add("sphere", Vector(0, 0, expected + 0.05 * d));
        const auto simulation = world.build();
        simulation->start(0);
        simulation->advance(4);
        EXPECT_NEAR(simulation->blocks.position[0].z() / d, expected / d, 1e-6) << "s = " << s;
        if (s == 0.7) {
            EXPECT_NEAR(expected / d, -0.137, 5e-4);
        }
    }
}

TEST(FreeFall, StartsWithReducedWeightAndEndsAtTheTerminalSpeed) {
    World world;
    world.wet = true;
    world.gravity = Vector(0, 0, -9.81);
    world.time_step = 1e-4;
    world.flow_interval = 1e-4;
    world.motion.surface = false;
    world.add("sphere", Vector(0, 0, -1));
    const auto simulation = world.build();
    simulation->start(0);
    simulation->advance(1e-3);
    const double s = world.element.density_ratio, cm = 0.5, g = 9.81, d = world.element.diameter;
    const double first = (s - 1) / (s + cm) * g;
    // Drag after a millisecond at 6 mm/s is a thousandth of the weight.
    EXPECT_NEAR(-simulation->blocks.velocity[0].z() / 1e-3, first, 2e-3 * first);
    simulation->advance(5.0);
    // (s - 1) A3 d^3 g = 1/2 (0.4 v + 24 nu / d) v A2 d^2
    const double weight = (s - 1) * g * d * 2.0 / 3.0, viscous = 24 * 1e-6 / d;
    const double terminal = (-viscous + std::sqrt(viscous * viscous + 8 * 0.4 * weight)) / (2 * 0.4);
    std::printf("terminal speed error %.1e\n", -simulation->blocks.velocity[0].z() / terminal - 1);
    EXPECT_NEAR(-simulation->blocks.velocity[0].z(), terminal,
                1e-9 * terminal);  // a fixed point: no error of the step
}

/// Position after 0.5 s of fall from rest with drag C_D = 0.4 (nu = 0): (v_t^2 / a) ln cosh(a t / v_t).
TEST(FreeFall, SecondOrderInTheFlowInterval) {
    double previous = 0;
    for (const double interval : {0.04, 0.02, 0.01}) {
        World world;
        world.wet = true;
        world.water.viscosity = 0;
        world.gravity = Vector(0, 0, -9.81);
        world.time_step = 1e-4;
        world.flow_interval = interval;
        world.motion.surface = false;
        world.add("sphere", Vector(0, 0, -1));
        const auto simulation = world.build();
        simulation->start(0);
        simulation->advance(0.48);
        const double s = world.element.density_ratio, d = world.element.diameter;
        const double a = (s - 1) / (s + 0.5) * 9.81, terminal = std::sqrt((s - 1) * 9.81 * d * 4 / 3 / 0.4);
        const double fall = terminal * terminal / a * std::log(std::cosh(a * 0.48 / terminal));
        const double error = (-1 - simulation->blocks.position[0].z()) / fall - 1;
        std::printf("flow interval %.3f s: distance error %.2e\n", interval, error);
        if (previous != 0) {
            EXPECT_GT(dem_cases::order(previous, error), 1.7);
        }
        previous = error;
    }
    EXPECT_LT(std::abs(previous), 1e-3);
}

TEST(Current, AcceleratingWaterCarriesANeutralSphereAlong) {
    // s = 1, no drag difference at the start: (s + C_M) du_b/dt = (1 + C_M) Du/Dt gives u_b = u.
    World world;
    world.wet = true;
    world.element.density_ratio = 1;
    world.motion.surface = false;
    world.motion.acceleration = Vector(0.5, 0, 0);
    world.water.viscosity = 0;
    world.time_step = 1e-4;
    world.add("sphere", Vector(0, 0, -1));
    const auto simulation = world.build();
    simulation->start(0);
    simulation->advance(0.002);
    EXPECT_NEAR(simulation->blocks.velocity[0].x(), 0.001, 1e-6);  // drag at 1 mm/s: a thousandth
}

/// A clump without symmetry.
dem::Shape lopsided(const dem::Element& element) {
    dem::ShapeDescription description;
    description.name = "lopsided";
    description.spheres = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0.2, 0}, {0, 1, 0}, {0, 2, 0.3}, {0, 0, 1}};
    return dem::make_shape(description, element, 1000);
}

TEST(FreeRotor, KeepsEnergyAndAngularMomentumOver1e5Steps) {
    World world;
    world.blocks.shapes.push_back(lopsided(world.element));
    world.blocks.add(0, Vector(0, 0, 0), Quaternion(0.5, 0.5, -0.5, 0.5), false, Vector::Zero(),
                     Vector(20, 3, -11));
    dem::Blocks blocks = world.blocks;
    const Vector momentum = blocks.angular_momentum[0];
    const double energy = blocks.kinetic_energy(0);
    double farthest = 0;
    for (int k = 0; k < 100000; ++k) {
        dem::drift(blocks, 0, 1e-4);
        farthest = std::max(farthest, std::abs(blocks.kinetic_energy(0) / energy - 1));
    }
    std::printf("largest energy error %.2e over 1e5 steps of 2.4e-3 rad\n", farthest);
    EXPECT_EQ(blocks.angular_momentum[0], momentum);  // never touched: exact
    // Symplectic and second order: the error stays at (angle per step)^2 times a number of order one, without
    // drift.
    EXPECT_LT(farthest, 1e-5);
    EXPECT_NEAR(blocks.orientation[0].norm(), 1, 1e-14);
}

TEST(FreeRotor, SecondOrderInTheStep) {
    World world;
    world.blocks.shapes.push_back(lopsided(world.element));
    world.blocks.add(0, Vector(0, 0, 0), Quaternion::Identity(), false, Vector::Zero(), Vector(20, 3, -11));
    const auto turned = [&](double step) {
        dem::Blocks blocks = world.blocks;
        for (int k = 0; k < static_cast<int>(std::lround(1.0 / step)); ++k) dem::drift(blocks, 0, step);
        return blocks.orientation[0];
    };
    const Quaternion reference = turned(1.0 / 64000);
    const double coarse = turned(1.0 / 500).angularDistance(reference),
                 fine = turned(1.0 / 1000).angularDistance(reference);
    std::printf("orientation error %.2e, %.2e rad after 1 s, order %.2f\n", coarse, fine,
                dem_cases::order(coarse, fine));
    EXPECT_NEAR(dem_cases::order(coarse, fine), 2, 0.1);
}

/// One step of the paper's way: every sphere moves by itself, then translation and rotation are taken from
/// sums over spheres (Koshizuka 1998), sphere spins included. Equals Newton-Euler to round-off.
TEST(PassivelyMovingSolid, OneStepEqualsNewtonEuler) {
    World world;
    const int shape = world.shape("beehive96");
    world.blocks.add(shape, Vector(0.3, -0.2, 0.1), Quaternion(0.8, 0.2, -0.4, 0.4), false,
                     Vector(0.1, 0.3, -0.2), Vector(2, -1, 3));
    dem::Blocks blocks = world.blocks;
    const auto& spheres = blocks.shape_of(0).spheres;
    const double m = blocks.mass(0) / 96, dt = 1e-4, own = 0.4 * m * 0.004 * 0.004;
    std::vector<Vector> force;
    Vector total = Vector::Zero(), torque = Vector::Zero();
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        force.emplace_back(std::sin(1.0 + 3 * static_cast<double>(k)), std::cos(2.0 * static_cast<double>(k)),
                           std::sin(5.0 * static_cast<double>(k)));
        total += force[k];
        torque += blocks.arm(0, k).cross(force[k]);
    }
    // Spheres one by one, then the projection.
    Vector momentum = Vector::Zero(), angular = Vector::Zero();
    dem::Rotation inertia = dem::Rotation::Zero();
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        const Vector r = blocks.arm(0, k);
        const Vector velocity = blocks.velocity[0] + blocks.angular_velocity[0].cross(r) + dt / m * force[k];
        momentum += m * velocity;
        angular += m * r.cross(velocity) + own * blocks.angular_velocity[0];
        inertia += m * (r.squaredNorm() * dem::Rotation::Identity() - r * r.transpose()) +
                   own * dem::Rotation::Identity();
    }
    const Vector projected_velocity = momentum / (96 * m), projected_spin = inertia.inverse() * angular;
    // The rigid body.
    blocks.force[0] = total;
    blocks.torque[0] = torque;
    dem::kick_half(blocks, 0, dt);
    blocks.update_angular_velocity(0);
    EXPECT_LT((blocks.velocity[0] - projected_velocity).norm(), 1e-14);  // round-off of sums over 96 spheres
    EXPECT_LT((blocks.angular_velocity[0] - projected_spin).norm(), 1e-12);
}

}  // namespace
