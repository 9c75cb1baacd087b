#include "cmps/neighbours.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "tests/support/cmps_tank.hpp"

namespace {

cmps::Particles jittered_tank() {
    cmps::Particles particles = cmps_tank::particles(
        0.3, 0.01, [](double) { return 0.2; }, 0.3);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> jitter(-0.004, 0.004);
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
        particles.x[i] += jitter(random), particles.z[i] += jitter(random);
    return particles;
}

TEST(Neighbours, ListsAreThoseOfABruteForceSearch) {
    cmps::Particles particles = jittered_tank();
    cmps::NeighbourSearch search(0.026, 0.003);
    ASSERT_TRUE(search.update(particles, {}));
    const auto& lists = search.lists();
    const std::size_t first = particles.first_wall();
    for (std::size_t r = 0; r < particles.size() - first; ++r) {
        std::vector<std::int32_t> expected;
        for (std::size_t j = 0; j < particles.size(); ++j) {
            const double dx = particles.x[j] - particles.x[first + r],
                         dz = particles.z[j] - particles.z[first + r];
            if (j != first + r && dx * dx + dz * dz < 0.029 * 0.029)
                expected.push_back(static_cast<std::int32_t>(j));
        }
        const std::vector<std::int32_t> found(lists.neighbour.begin() + lists.start[r],
                                              lists.neighbour.begin() + lists.start[r + 1]);
        ASSERT_EQ(found, expected) << "row " << r;
        for (std::uint32_t k = lists.start[r]; k < lists.start[r + 1]; ++k)
            ASSERT_EQ(k >= lists.carriers[r], static_cast<std::size_t>(lists.neighbour[k]) >= first);
    }
}

TEST(Neighbours, ListsLiveUntilParticlesHaveMovedByTheSkinAgainstEachOther) {
    cmps::Particles particles = jittered_tank();
    cmps::NeighbourSearch search(0.026, 0.003);
    search.update(particles, {});
    particles.x.back() += 0.0029;
    EXPECT_FALSE(search.update(particles, {}));
    particles.x.back() += 0.0002;
    EXPECT_TRUE(search.update(particles, {}));
    // all of it together: no pair has changed
    for (double& x : particles.x) x += 0.0060;
    EXPECT_FALSE(search.update(particles, {}));
}

TEST(Neighbours, ListsThatHoldMissNoPairWithinTheRadius) {
    cmps::Particles particles = jittered_tank();
    cmps::NeighbourSearch search(0.026, 0.003);
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0, 0.0001);
    int held = 0;
    for (int step = 0; step < 40; ++step) {
        for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i) {
            // shear, strain and drops that run through the rest
            particles.x[i] += 0.003 * particles.z[i] + noise(random) + (i % 97 == 0 ? 0.0007 : 0.0);
            particles.z[i] += 0.002 * (0.15 - particles.x[i]) + noise(random);
        }
        held += !search.update(particles, {});
        const auto& lists = search.lists();
        const std::size_t first = particles.first_wall();
        for (std::size_t r = 0; r < particles.size() - first; ++r) {
            const std::set<std::int32_t> listed(lists.neighbour.begin() + lists.start[r],
                                                lists.neighbour.begin() + lists.start[r + 1]);
            for (std::size_t j = 0; j < particles.size(); ++j) {
                const double dx = particles.x[j] - particles.x[first + r],
                             dz = particles.z[j] - particles.z[first + r];
                const bool is_near = j != first + r && dx * dx + dz * dz < 0.026 * 0.026;
                ASSERT_TRUE(!is_near || listed.contains(static_cast<std::int32_t>(j))) << "step " << step;
            }
        }
    }
    EXPECT_GT(held, 10);  // otherwise nothing was tried
}

TEST(Neighbours, ReorderingCarriesEveryArrayAlong) {
    cmps::Particles particles = jittered_tank();
    std::vector<double> companion(particles.size());
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i) {
        particles.u[i] = particles.x[i], particles.pressure[i] = particles.z[i];
        companion[i] = particles.x[i] + particles.z[i];
    }
    std::reverse(particles.x.begin() + static_cast<std::ptrdiff_t>(particles.first_fluid()),
                 particles.x.end());
    std::reverse(particles.u.begin() + static_cast<std::ptrdiff_t>(particles.first_fluid()),
                 particles.u.end());
    std::reverse(particles.z.begin() + static_cast<std::ptrdiff_t>(particles.first_fluid()),
                 particles.z.end());
    std::reverse(particles.pressure.begin() + static_cast<std::ptrdiff_t>(particles.first_fluid()),
                 particles.pressure.end());
    std::reverse(companion.begin() + static_cast<std::ptrdiff_t>(particles.first_fluid()), companion.end());
    cmps::NeighbourSearch search(0.026, 0.003);
    search.update(particles, {&companion});
    std::set<std::int32_t> identities;
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i) {
        EXPECT_EQ(particles.u[i], particles.x[i]);
        EXPECT_EQ(particles.pressure[i], particles.z[i]);
        EXPECT_EQ(companion[i], particles.x[i] + particles.z[i]);
        identities.insert(particles.identity[i]);
    }
    EXPECT_EQ(identities.size(), particles.fluid);
}

TEST(Neighbours, NoParticlesAtAll) {
    cmps::Particles particles;
    cmps::NeighbourSearch search(0.026, 0.003);
    EXPECT_TRUE(search.update(particles, {}));
    EXPECT_TRUE(search.lists().neighbour.empty());
}

}  // namespace
