/// Pair lists against brute force, layouts, water motion, sleeping, snapshots, same bits on any number of
/// threads.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <set>

#include "common/parallel.hpp"
#include "dem/layout.hpp"
#include "dem/motion.hpp"
#include "dem/placement.hpp"
#include "dem/snapshot.hpp"
#include "dem/water_motion.hpp"
#include "tests/support/dem_cases.hpp"

namespace {

using dem::Quaternion;
using dem::Vector;
using dem_cases::World;

/// Blocks of several shapes thrown together over a rough floor.
World heap(int count, unsigned seed, double period = 0) {
    World world;
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0, 0.2), turn(-1, 1);
    const char* names[] = {"beehive96", "tetrapod", "cube27", "sphere"};
    for (int k = 0; k < count; ++k) {
        // Drawn one by one: the order in which arguments are evaluated is the compiler's.
        std::array<double, 12> drawn;
        for (std::size_t i = 0; i < 10; ++i) drawn[i] = turn(random);
        for (std::size_t i = 10; i < 12; ++i) drawn[i] = place(random);
        world.add(names[k % 4], Vector(drawn[11], drawn[10], 0.05 + 0.06 * k / 4.0),
                  Vector(drawn[9], drawn[8], drawn[7]) * 0.3, false,
                  Quaternion(drawn[6], drawn[5], drawn[4], drawn[3]).normalized(),
                  Vector(drawn[2], drawn[1], drawn[0]) * 5);
    }
    std::vector<Vector> floor;
    for (int i = -10; i < 40; ++i)
        for (int j = -10; j < 40; ++j) floor.emplace_back(0.008 * i, 0.008 * j, 0.003 * turn(random));
    world.surroundings.fixed_spheres = dem::FixedSpheres(floor, 0.008, 0.0098, period);
    world.surroundings.planes.push_back({Vector(-0.05, 0, 0), Vector(1, 0, 0)});
    world.surroundings.planes.push_back({Vector(0.25, 0, 0), Vector(-1, 0, 0)});
    world.surroundings.period = period;
    world.gravity = Vector(0, 0, -9.81);
    world.time_step = 1e-4;
    return world;
}

using Touching = std::set<std::array<std::uint32_t, 4>>;

/// All touching sphere pairs, the slow and sure way.
Touching touching_by_brute_force(const dem::Blocks& blocks, const dem::Surroundings& around) {
    Touching found;
    const auto count = static_cast<std::uint32_t>(blocks.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto& a = blocks.shape_of(i);
        for (std::uint32_t k = 0; k < a.spheres.size(); ++k) {
            const Vector centre = blocks.sphere_centre(i, k);
            for (std::uint32_t j = i + 1; j < count; ++j) {
                if ((blocks.position[i] - blocks.position[j]).norm() > 0.12) continue;
                const auto& b = blocks.shape_of(j);
                for (std::uint32_t l = 0; l < b.spheres.size(); ++l)
                    if ((blocks.sphere_centre(j, l) - centre).norm() < 0.5 * (a.diameter + b.diameter))
                        found.insert({i, j, k, l});
            }
            for (std::uint32_t l = 0; l < around.fixed_spheres.size(); ++l)
                if ((around.fixed_spheres.centre(l) - centre).norm() <
                    0.5 * (a.diameter + around.fixed_spheres.diameter()))
                    found.insert({i, count, k, l});
            for (std::uint32_t p = 0; p < around.planes.size(); ++p)
                if ((centre - around.planes[p].point).dot(around.planes[p].normal) < 0.5 * a.diameter)
                    found.insert({i, count + 1 + p, k, 0});
        }
    }
    return found;
}

TEST(PairList, TouchesWhatBruteForceTouchesAllTheWayDown) {
    const World world = heap(16, 11);
    const auto simulation = world.build();
    simulation->start(0);
    std::size_t seen = 0;
    for (int k = 1; k <= 40; ++k) {
        simulation->advance(0.01 * k);
        Touching listed;
        for (const auto& pair : simulation->pair_list().pairs())
            for (const auto& contact : simulation->pair_list().contacts(pair))
                listed.insert({pair.block, pair.partner, contact.a, contact.b});
        const Touching expected = touching_by_brute_force(simulation->blocks, simulation->surroundings());
        // Spheres inside a clump are not listed: what brute force finds beyond the list must be such.
        for (const auto& touch : listed) EXPECT_TRUE(expected.contains(touch));
        for (const auto& touch : expected) {
            const auto& exposed = simulation->blocks.shape_of(touch[0]).exposed;
            const bool inner =
                std::find(exposed.begin(), exposed.end(), static_cast<int>(touch[2])) == exposed.end();
            EXPECT_TRUE(inner || listed.contains(touch)) << touch[0] << ' ' << touch[1];
        }
        seen += expected.size();
    }
    EXPECT_GT(seen, 100u);
}

TEST(PairList, ResultsDoNotDependOnTheSkin) {
    const World world = heap(12, 11);
    std::vector<Vector> first;
    for (const double skin : {0.0004, 0.0012, 0.0018}) {
        dem::Simulation simulation(world.blocks, world.surroundings,
                                   dem::make_contact_model(world.law, world.material, 0.008, 8e-5),
                                   world.gravity, {.time_step = 1e-4, .skin = skin});
        simulation.start(0);
        simulation.advance(0.4);
        if (first.empty()) first = simulation.blocks.position;
        EXPECT_EQ(first, simulation.blocks.position) << "skin " << skin;  // to the bit
    }
}

TEST(PairList, NoPointGoesFartherThanTheBoundThatListsRelyOn) {
    World world;
    world.add("tetrapod", Vector(0, 0, 0));  // three different moments
    auto& blocks = world.blocks;
    double most = 0;
    for (int k = 0; k < 2000; ++k) {
        const Vector spin =
            Vector::Random() * std::pow(10.0, k % 5);  // up to 1e4 rad/s: 57 degrees in a step
        blocks.place(0, Vector::Random(), dem::Quaternion::UnitRandom(), Vector::Random(), spin);
        const dem::Shape& shape = blocks.shape_of(0);
        std::vector<Vector> before;
        for (std::size_t i = 0; i < shape.spheres.size(); ++i) before.push_back(blocks.sphere_centre(0, i));
        const double bound = dem::drift(blocks, 0, 1e-4);
        for (std::size_t i = 0; i < before.size(); ++i)
            most = std::max(most, (blocks.sphere_centre(0, i) - before[i]).norm() / bound);
    }
    std::printf("farthest way over its bound: %.3f\n", most);
    EXPECT_LE(most, 1.0);
    EXPECT_GT(most, 0.4);  // a bound too wide would have lists searched for nothing
}

TEST(PairList, PeriodicBoxIsTheSameAnywhere) {
    // A pair across the seam behaves as the same pair in the middle of the box.
    std::vector<Vector> moved;
    for (const double shift : {0.0, 0.1}) {
        World world;
        world.surroundings.period = 0.2;
        world.add("cube27", Vector(0, 0.085 + shift, 0), Vector(0, 0.2, 0.01));
        world.add("cube27", Vector(0, 0.115 + shift - (shift > 0 ? 0.2 : 0.0), 0.003), Vector(0, -0.2, 0));
        const auto simulation = world.build();
        simulation->start(0);
        simulation->advance(0.05);
        moved.push_back(simulation->blocks.velocity[0]);
        EXPECT_GT(simulation->largest_overlap(), 0);
    }
    EXPECT_LT((moved[0] - moved[1]).norm(), 1e-9);  // m/s: rounding of other coordinates
}

TEST(Simulation, SameBitsForOneAndTwoThreads) {
    // 2000 pairs and more are shared out between threads.
    std::vector<std::vector<Vector>> results;
    for (const int threads : {1, 2}) {
        common::use_threads(threads);
        World world;
        for (int i = 0; i < 14; ++i)
            for (int j = 0; j < 14; ++j)
                for (int k = 0; k < 4; ++k)
                    world.add("cube27", Vector(0.0239 * i, 0.0239 * j, 0.0239 * k + 0.013),
                              Vector(0.1 * (i % 3 - 1), 0.1 * (j % 2), 0));
        world.surroundings.planes.push_back({Vector(0, 0, 0), Vector(0, 0, 1)});
        world.gravity = Vector(0, 0, -9.81);
        world.time_step = 5e-5;
        const auto simulation = world.build();
        simulation->start(0);
        simulation->advance(0.02);
        results.push_back(simulation->blocks.position);
    }
    common::use_threads(1);
    EXPECT_EQ(results[0], results[1]);
}

TEST(Snapshot, GoesOnBitForBitThroughItsFileForm) {
    World world = heap(12, 21);
    world.wet = true;
    const auto build = [&] {
        auto simulation = world.build();
        simulation->add_sleeping({});
        return simulation;
    };
    const auto mount = [](dem::Simulation& simulation) {
        dem::Wires wires;
        wires.longest_stretch = 0.3 * 0.008;
        wires.add(0, 3, 4, 5, 0.05, 500);
        simulation.mount_wires(wires);
    };
    const auto whole = build();
    mount(*whole);
    whole->start(0);
    whole->advance(0.3);
    const dem::PackedPoses packed = dem::poses_of(whole->blocks);
    const dem::Snapshot saved =
        dem::snapshot_from(dem::to_data_file(dem::take_snapshot(*whole, packed, "digest")));
    whole->advance(0.6);

    const auto later = build();
    later->mount_wires(saved.wires);
    dem::restore(*later, saved);
    later->advance(0.6);
    EXPECT_EQ(whole->blocks.position, later->blocks.position);
    EXPECT_EQ(whole->blocks.angular_momentum, later->blocks.angular_momentum);
    EXPECT_EQ(whole->energy().balance(), later->energy().balance());
    EXPECT_EQ(whole->wires.tension, later->wires.tension);
}

TEST(Layout, FacingSidesArePairedAcrossTheGap) {
    World world;
    world.add("beehive96", Vector(0, 0, 0));
    world.add("beehive96", Vector(0, 0.05, 0));
    world.add("beehive96", Vector(-0.05, 0, 0));
    const auto along = dem::facing_spheres(world.blocks, 0, 1),
               across = dem::facing_spheres(world.blocks, 0, 2);
    EXPECT_EQ(along.size(), 18u);
    EXPECT_EQ(across.size(), 18u);
    for (const auto& place : along) {
        const Vector between = world.blocks.sphere_centre(place.block_b, place.sphere_b) -
                               world.blocks.sphere_centre(place.block_a, place.sphere_a);
        EXPECT_LT((between - Vector(0, 0.01, 0)).norm(), 1e-12);
    }
    EXPECT_EQ(dem::wires_of(world.blocks, {.block_a = 0,
                                           .block_b = 1,
                                           .spheres = {},
                                           .wires = 5,
                                           .rest_length = {},
                                           .slack = 0,
                                           .stiffness = {}})
                  .size(),
              5u);
}

/// The wires of a link, lower block first, in order of the spheres.
std::vector<dem::WirePlace> in_block_order(std::vector<dem::WirePlace> places) {
    for (auto& place : places) place = dem::in_order(place);
    std::sort(places.begin(), places.end());
    return places;
}

TEST(Layout, TheSmallerSideChoosesItsNearestWhicheverEndIsNamedFirst) {
    World world;
    world.add("beehive96", Vector(0, 0, 0));
    world.add("sphere", Vector(0.05, 0.004, 0));
    const auto one = dem::facing_spheres(world.blocks, 0, 1);
    ASSERT_EQ(one.size(), 1u);
    const Vector across =
        world.blocks.sphere_centre(1, one[0].sphere_b) - world.blocks.sphere_centre(0, one[0].sphere_a);
    // Columns of the face stand at odd multiples of 4 mm: the sphere looks straight at one of them.
    EXPECT_LT(Vector(0, across.y(), across.z()).norm(), 1e-12);
    EXPECT_EQ(in_block_order(one), in_block_order(dem::facing_spheres(world.blocks, 1, 0)));
    // Faces shifted against each other: who is nearest depends on who chooses first.
    world.add("cube27", Vector(0, 0.2, 0));
    world.add("cube27", Vector(0.05, 0.212, 0.013));
    EXPECT_EQ(in_block_order(dem::facing_spheres(world.blocks, 2, 3)),
              in_block_order(dem::facing_spheres(world.blocks, 3, 2)));
}

TEST(Wires, MountedAgainTheyReplaceThoseThere) {
    World world;
    for (int k = 0; k < 2; ++k) world.add("sphere", Vector(0.02 * k, 0, 0));
    const auto simulation = world.build();
    dem::Wires wires;
    wires.longest_stretch = 1;
    wires.add(0, 0, 1, 0, 0.01, 100);
    for (int times = 0; times < 2; ++times) simulation->mount_wires(wires);
    simulation->start(0);
    EXPECT_NEAR(simulation->blocks.force[0].x(), 100 * 0.01, 1e-12);  // rounding
}

/// u = 1 + 2x - z, w = x z, at t; bilinear and linear in time, so that interpolation is exact.
dem::FlowHistory linear_flow() {
    dem::FlowHistory history;
    history.time = {1.0, 1.5, 2.0};
    for (int i = 0; i < 5; ++i) history.x.push_back(0.25 * i);
    for (int j = 0; j < 4; ++j) history.z.push_back(-0.5 + 0.125 * j);
    for (const double t : history.time)
        for (const double z : history.z)
            for (const double x : history.x)
                for (const double value : {(1 + 2 * x - z) * t, x * z * t, t, -t, 0.5})
                    history.values.push_back(static_cast<float>(value));
    return history;
}

dem::WaterSamples water_at(const dem::FlowGrid& grid, double x, double z) {
    dem::WaterSamples samples;
    samples.resize(1);
    grid.sample({x}, {z}, samples);
    return samples;
}

TEST(FlowGrid, IsExactForBilinearFieldsAndLinearTime) {
    dem::FlowGrid grid(linear_flow());
    for (const double t : {1.0, 1.2, 1.5, 1.93, 2.0}) {
        grid.set_time(t);
        for (const double x : {0.0, 0.1, 0.77, 1.0})
            for (const double z : {-0.5, -0.33, -0.125}) {
                const auto sample = water_at(grid, x, z);
                // Fields are stored in single precision.
                EXPECT_NEAR(sample.velocity.x[0], (1 + 2 * x - z) * t, 1e-6);
                EXPECT_NEAR(sample.velocity.z[0], x * z * t, 1e-6);
                EXPECT_NEAR(sample.acceleration.x[0], t, 1e-6);
                EXPECT_NEAR(sample.wet[0], 0.5, 1e-7);
            }
    }
}

TEST(FlowGrid, OutsideIsAnErrorUnlessStill) {
    const dem::FlowGrid strict(linear_flow()), still(linear_flow(), dem::UniformWater{});
    EXPECT_THROW(water_at(strict, 1.01, -0.3), std::out_of_range);
    EXPECT_EQ(water_at(still, 1.01, -0.3).velocity.x[0], 0);
    EXPECT_EQ(water_at(still, 1.01, -0.3).wet[0], 1);
    EXPECT_EQ(water_at(still, 1.01, 0.3).wet[0], 0);
    // A quarter of an element below z = 0: the cap of a sphere, 3/4 of its diameter deep.
    EXPECT_DOUBLE_EQ(water_at(still, 1.01, -0.002).wet[0], 27.0 / 32);
}

TEST(FluidLoads, LoadKeptForASleeperIsOffByNoMoreThanItSays) {
    // A standing wave of 2 s, sampled every 0.02 s; looks every 2 ms over several samples.
    dem::FlowHistory history;
    for (int k = 0; k <= 50; ++k) history.time.push_back(0.02 * k);
    for (int i = 0; i < 11; ++i) history.x.push_back(0.02 * i);
    for (int j = 0; j < 11; ++j) history.z.push_back(-0.4 + 0.02 * j);
    for (const double t : history.time)
        for (const double z : history.z)
            for (const double x : history.x) {
                const double u = (0.05 + x) * std::sin(3.14 * t), w = 0.3 * z * x * std::sin(3.14 * t + 1);
                for (const double value : {u, w, 0.3 * std::cos(3.14 * t), x * std::cos(3.14 * t), 1.0})
                    history.values.push_back(static_cast<float>(value));
            }
    World world;
    world.add("beehive96", Vector(0.1, 0, -0.3), Vector::Zero(), false,
              Quaternion(1, 0.2, 0.3, -0.1).normalized());
    const dem::FluidProperties properties{
        .water = world.water, .element = world.element, .gravity = Vector(0, 0, -9.81)};
    const dem::FlowGrid grid(history);
    dem::FluidLoads kept(world.blocks, properties, grid);
    kept.waves_reach_blocks = 0;  // until they do, sleepers in faster water are sampled every time
    kept.awake_changed({0});
    const std::vector<std::uint32_t> wanted{0};
    double largest_share = 0;
    for (int k = 0; k < 450; ++k) {
        const double t = 2e-3 * k;
        dem::FluidLoads exact(world.blocks, properties, grid);
        dem::Blocks by_kept = world.blocks, by_exact = world.blocks;
        kept.sample(by_kept, t, 2e-3);
        exact.sample(by_exact, t, 2e-3);
        kept.add(by_kept, wanted, {1}, t);
        exact.add(by_exact, wanted, {1}, t);
        const double off = (by_kept.force[0] - by_exact.force[0]).norm() +
                           (by_kept.torque[0] - by_exact.torque[0]).norm() / by_kept.shape_of(0).radius;
        // Rounding of forces of about 1 N.
        ASSERT_LE(off, kept.uncertainty(0) + 1e-12) << "t = " << t;
        if (kept.uncertainty(0) > 0) largest_share = std::max(largest_share, off / kept.uncertainty(0));
        if (k % 150 == 149) {
            kept.sample_block(by_kept, 0, t);
            EXPECT_EQ(kept.uncertainty(0), 0);
        }
    }
    EXPECT_GT(largest_share, 0.2);  // a bound of any use: not far above what it bounds
}

TEST(Sleeping, RestsWhenNothingMovesAndWakesWhenPushed) {
    World world;
    world.gravity = Vector(0, 0, -9.81);
    world.time_step = 1e-4;
    world.surroundings.planes.push_back({Vector(0, 0, 0), Vector(0, 0, 1)});
    world.add("beehive96", Vector(0, 0, 0.0121));
    world.add("beehive96", Vector(0.3, 0, 0.012), Vector(-0.5, 0, 0));  // slides into the first
    const auto simulation = world.build();
    simulation->add_sleeping({});
    simulation->start(0);
    std::size_t most_asleep = 0;
    for (int k = 1; k <= 20; ++k) {
        simulation->advance(0.1 * k);
        most_asleep = std::max(most_asleep, simulation->asleep_count());
    }
    EXPECT_EQ(simulation->asleep_count(), 2u);
    EXPECT_EQ(simulation->blocks.velocity[0], Vector(0, 0, 0));
    const double steps = static_cast<double>(simulation->awake_block_steps());
    simulation->advance(3.0);
    EXPECT_EQ(static_cast<double>(simulation->awake_block_steps()), steps);  // nobody is moved any more

    // One asleep is hit by one that slides.
    World struck = world;
    struck.blocks = simulation->blocks;
    struck.blocks.place(1, Vector(0.1, 0, 0.012), Quaternion::Identity(), Vector(-1.5, 0, 0), Vector::Zero());
    const auto hit = struck.build();
    hit->add_sleeping({.rest_time = 0.01});
    hit->start(0);
    const double before = hit->blocks.position[0].x();
    hit->advance(0.5);
    EXPECT_LT(hit->blocks.position[0].x(), before - 1e-3);
}

}  // namespace
