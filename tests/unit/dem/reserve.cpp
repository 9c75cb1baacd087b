/// What a block at rest has left before it slides or tips, against cases worked out by hand.
#include "dem/effects/reserve.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace {

using dem::CarriedContact;
using dem::Vector;

const Vector up(0, 0, 1);
constexpr double radius = 2, friction = 0.5;

/// Four contacts of 1 N at the corners of a square of side 2, a tangential spring of `spring` N in each.
std::vector<CarriedContact> four(double spring, double x_of_load = 0) {
    std::vector<CarriedContact> contacts;
    for (const double x : {-1.0, 1.0})
        for (const double y : {-1.0, 1.0})
            contacts.push_back({Vector(x, y, -1), Vector(0, 0, -1), 1 + x * x_of_load, Vector(spring, 0, 0)});
    return contacts;
}

TEST(Reserve, IsWhatIsMissingToSlidingOrToTipping) {
    // mu N = 2 N, less 4 x 0.4 N; tipping about an edge: 4 N x 1 m over 2 R = 4 m.
    EXPECT_NEAR(dem::reserve_of(four(0.4), friction, up, radius), 0.4, 1e-12);
    EXPECT_NEAR(dem::reserve_of(four(0), friction, up, radius), 1.0, 1e-12);
    // The centre of what is carried a tenth from one edge.
    EXPECT_NEAR(dem::reserve_of(four(0, 0.9), friction, up, radius), 0.1, 1e-12);
    // All at the Coulomb limit: a hundredth of mu N.
    EXPECT_NEAR(dem::reserve_of(four(0.5), friction, up, radius), 0.02, 1e-12);
}

TEST(Reserve, NothingIsLeftWithoutFrictionOrOnALine) {
    EXPECT_EQ(dem::reserve_of(four(0), 0, up, radius), 0);
    auto line = four(0);
    for (auto& contact : line) contact.place.x() = 0;
    EXPECT_EQ(dem::reserve_of(line, friction, up, radius), 0);
    EXPECT_EQ(dem::reserve_of({}, friction, up, radius), 0);
    EXPECT_EQ(dem::reserve_of(four(0, 1.0), friction, up, radius), 0);  // about to tip
}

TEST(Reserve, DoesNotCountSidesThatLeanOnTheBlockNorWhatLiesOnIt) {
    auto contacts = four(0.4);
    contacts.push_back({Vector(3, 0, 0), Vector(1, 0, 0), 10, Vector::Zero()});
    contacts.push_back({Vector(0, 0, 1), Vector(0, 0, 1), 1, Vector::Zero()});
    EXPECT_NEAR(dem::reserve_of(contacts, friction, up, radius), 0.4, 1e-12);
}

}  // namespace
