#include "common/perturbation.hpp"

#include <gtest/gtest.h>

#include <set>

using common::perturbation;

TEST(Perturbation, SeedZeroPerturbsNothing) {
    for (std::uint64_t index = 0; index < 100; ++index) EXPECT_EQ(perturbation(0, index), 0.0);
}

TEST(Perturbation, IsSpreadEvenlyBetweenMinusOneAndOne) {
    constexpr int count = 100000;
    double sum = 0, squares = 0, neighbours = 0, seeds = 0;
    for (int i = 0; i < count; ++i) {
        const double p = perturbation(7, static_cast<std::uint64_t>(i));
        ASSERT_LE(std::abs(p), 1.0);
        sum += p, squares += p * p;
        neighbours += p * perturbation(7, static_cast<std::uint64_t>(i) + 1);
        seeds += p * perturbation(8, static_cast<std::uint64_t>(i));
    }
    // five standard errors of an even distribution: 1/sqrt(3 n), 2/sqrt(45 n), 1/(3 sqrt n)
    EXPECT_NEAR(sum / count, 0.0, 0.0092);
    EXPECT_NEAR(squares / count, 1.0 / 3.0, 0.0048);
    EXPECT_NEAR(neighbours / count, 0.0, 0.0053);
    EXPECT_NEAR(seeds / count, 0.0, 0.0053);
}

TEST(Perturbation, IsTheSameOnEveryMachine) {
    EXPECT_EQ(perturbation(1, 0), perturbation(1, 0));
    std::set<double> values;
    for (int seed = 1; seed <= 100; ++seed)
        for (std::uint64_t index = 0; index < 100; ++index) values.insert(perturbation(seed, index));
    EXPECT_EQ(values.size(), 10000u);
}
