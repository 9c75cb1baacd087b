/// Blocks put back into gaps that others have moved into: the smallest shift that frees them.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "dem/placement.hpp"
#include "dem/put_back.hpp"
#include "tests/support/dem_cases.hpp"

namespace {

using dem::Quaternion;
using dem::Vector;
using dem_cases::World;

constexpr double d = 0.008;               // of elements, m
constexpr double tolerance = 1.5e-3 * d;  // of the search, in overlap; a little more in a shift across it
constexpr dem::Pressing pressing{0.02 * d, 0.1 * d};

/// Puts block `block` back to `packed`, from somewhere far away; returns how far from it it ends.
Vector shift_of(World& world, std::uint32_t block, const Vector& packed) {
    dem::PackedPoses poses = dem::poses_of(world.blocks);
    poses.position[block] = packed;
    const auto placed = dem::put_back(world.blocks, world.surroundings, pressing, {block}, poses);
    EXPECT_EQ(placed, std::vector<std::uint32_t>{block});
    EXPECT_EQ(world.blocks.velocity[block], Vector::Zero());
    return world.blocks.position[block] - packed;
}

TEST(PuttingBack, FreePlaceIsTakenExactly) {
    World world;
    world.add("beehive96", Vector(0.3, 0, 0.1), Vector(1, 2, 3));
    world.add("beehive96", Vector(0, 0.05, 0));
    EXPECT_EQ(shift_of(world, 0, Vector::Zero()), Vector::Zero());
}

TEST(PuttingBack, NeighbourInTheGapIsLeftByTheShortestWay) {
    // Two spheres half a diameter apart, in any direction: away from the other till it is pressed no deeper.
    for (const Vector& direction :
         {Vector(1, 0, 0), Vector(0, -1, 0), Vector(0, 0, -1), Vector(1, -2, 0.5)}) {
        World world;
        const Vector towards = direction.normalized();
        world.add("sphere", Vector(0, 0, 0.1));
        world.add("sphere", 0.5 * d * towards);
        const Vector expected = -(d - pressing.into_blocks - 0.5 * d) * towards;
        EXPECT_LT((shift_of(world, 0, Vector::Zero()) - expected).norm(), tolerance);
    }
}

TEST(PuttingBack, FixedOnesAndWallsGiveWayLess) {
    World world;
    world.add("sphere", Vector(0, 0, 0.1));
    world.add("sphere", Vector(0.5 * d, 0, 0), Vector::Zero(), true);
    EXPECT_NEAR(shift_of(world, 0, Vector::Zero()).x(), -(0.5 * d - pressing.into_fixed), tolerance);
    World walled;
    walled.add("sphere", Vector(0, 0, 0.1));
    walled.surroundings.planes.push_back({Vector(0, 0, -0.2 * d), Vector(0, 0, 1)});
    EXPECT_NEAR(shift_of(walled, 0, Vector::Zero()).z(), 0.3 * d - pressing.into_fixed, tolerance);
}

TEST(PuttingBack, TooNarrowAGapIsLeftUpwards) {
    // Neighbours on both sides nearer than their diameters, walls before and behind, a floor below.
    World world;
    const double half_gap = 0.7 * d;
    world.add("sphere", Vector(0, 0, 0.1));
    world.add("sphere", Vector(half_gap, 0, 0));
    world.add("sphere", Vector(-half_gap, 0, 0));
    for (const double side : {-1.0, 1.0})
        world.surroundings.planes.push_back({Vector(0, side * d / 2, 0), Vector(0, -side, 0)});
    world.surroundings.planes.push_back({Vector(0, 0, -d / 2), Vector(0, 0, 1)});
    const double reach = d - pressing.into_blocks;
    const Vector shift = shift_of(world, 0, Vector::Zero());
    // Sideways it may go as far as the walls give way; where it meets two spheres, height answers less than
    // overlap does by the slope there.
    EXPECT_NEAR(shift.z(), std::sqrt(reach * reach - half_gap * half_gap), 2 * tolerance);
    EXPECT_LT(std::abs(shift.x()), tolerance);
    EXPECT_LT(std::abs(shift.y()), 1.1 * pressing.into_fixed);
}

TEST(PuttingBack, ThroughTheEndOfAPeriodicBox) {
    World world;
    world.surroundings.period = 0.1;
    world.add("sphere", Vector(0, 0.05, 0.1));
    world.add("sphere", Vector(0, 0.1 - 0.3 * d, 0));
    EXPECT_NEAR(shift_of(world, 0, Vector(0, 0.2 * d, 0)).y(), 0.5 * d - pressing.into_blocks, tolerance);
}

TEST(PuttingBack, NoDeeperThanPressedAndNoFartherThanStraightUp) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int trial = 0; trial < 12; ++trial) {
        World world;
        world.add("beehive96", Vector(0, 0, 0.5));
        for (const Vector& beside : {Vector(0.05, 0, 0), Vector(-0.05, 0, 0), Vector(0, 0.05, 0),
                                     Vector(0, -0.05, 0), Vector(0, 0, -0.028)})
            world.add("beehive96", beside + 0.003 * Vector(any(random), any(random), any(random)),
                      Vector::Zero(), false,
                      Quaternion(1, 0.05 * any(random), 0.05 * any(random), 0.05 * any(random)).normalized());
        const Vector shift = shift_of(world, 0, Vector::Zero());
        EXPECT_LT(dem::deepest_overlap(world.blocks, world.surroundings, 0).depth,
                  pressing.into_blocks + tolerance);
        double lift = 0;
        for (;; lift += 0.01 * d) {
            world.blocks.position[0] = Vector(0, 0, lift);
            if (dem::deepest_overlap(world.blocks, world.surroundings, 0).depth < pressing.into_blocks) break;
        }
        EXPECT_LE(shift.norm(), lift + tolerance) << "trial " << trial;
    }
}

TEST(PuttingBack, BlocksThatStandWhereTheyWerePackedAreLeftAlone) {
    World world;
    world.add("beehive96", Vector(0, 0, 0), Vector(0.1, 0, 0));
    world.add("beehive96", Vector(0, 0.02, 0));  // deep in the first
    dem::PackedPoses packed = dem::poses_of(world.blocks);
    packed.position[0].x() += 1e-5 * d;
    const auto before = dem::poses_of(world.blocks);
    EXPECT_TRUE(dem::put_back(world.blocks, world.surroundings, pressing, {0, 1}, packed).empty());
    EXPECT_EQ(world.blocks.position, before.position);
    EXPECT_EQ(world.blocks.velocity[0], Vector(0.1, 0, 0));
}

TEST(PuttingBack, PressingFollowsHertz) {
    World world;
    world.add("beehive96", Vector(0, 0, 0));
    const auto found = dem::pressing_of(world.blocks, world.material, 9.81);
    const auto force = [&](double overlap) {
        return 4.0 / 3 * world.material.contact_modulus() * std::sqrt(d / 4) * std::pow(overlap, 1.5);
    };
    const double weight = 9.81 * world.blocks.shape_of(0).mass;
    EXPECT_NEAR(force(found.into_fixed), weight, 1e-12 * weight);       // rounding
    EXPECT_NEAR(force(found.into_blocks), 8 * weight, 1e-12 * weight);  // rounding
}

TEST(PuttingBack, ContactsOfPlacedBlocksAreForgotten) {
    const std::vector<dem::TouchingPair> pairs{{.block = 0, .partner = 1, .contacts = {}, .last = {}},
                                               {.block = 1, .partner = 2, .contacts = {}, .last = {}},
                                               {.block = 2, .partner = 9, .contacts = {}, .last = {}}};
    const auto kept = dem::contacts_without(pairs, {1});
    ASSERT_EQ(kept.size(), 1u);
    EXPECT_EQ(kept[0].block, 2u);
}

}  // namespace
