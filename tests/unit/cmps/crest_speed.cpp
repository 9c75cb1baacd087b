#include "cmps/crest_speed.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "cmps/linear_waves.hpp"

namespace {

constexpr double l0 = 0.02, depth = 0.4, height = 0.12, middle = 2.0;

double surface(double x) {
    return height * std::exp(-std::pow((x - middle) / 0.3, 2));
}

/// A lattice of water from z = -`under` up to a hump whose water moves at `speed`; none moves elsewhere.
cmps::Particles hump(double speed, double under = depth) {
    cmps::Particles particles;
    std::int32_t number = 0;
    for (int i = 0; i < 200; ++i) {
        const double x = (i + 0.5) * l0;
        for (int k = 0; - under + (k + 1) * l0 < surface(x) + 1e-9; ++k) {
            const bool moves = std::abs(x - middle) < 0.2;
            particles.add_fluid(x, -under + (k + 0.5) * l0, number++, moves ? speed : 0.0);
        }
    }
    return particles;
}

cmps::Crest fastest(const cmps::Particles& particles, double period = 0, double gravity = 9.81) {
    return cmps::CrestSpeed(l0, 0.0, period, gravity).fastest(particles, 0.0, 4.0);
}

TEST(CrestSpeed, IsThatOfTheWaterAtTheCrestOverItsCelerity) {
    const double celerity = std::sqrt(9.81 * (depth + height));
    for (const double ratio : {0.3, 0.84, 0.86, 1.2}) {
        const cmps::Crest crest = fastest(hump(ratio * celerity));
        // the columns beside the top, whose water moves as fast, are up to a fifth of the crest lower
        EXPECT_NEAR(crest.speed_over_celerity, ratio, 0.06 * ratio);
        EXPECT_NEAR(crest.x, middle, 0.2 + l0);
    }
}

TEST(CrestSpeed, TakesTheCelerityOfThePeriod) {
    constexpr double period = 0.8;
    const double celerity = cmps::phase_speed(period, depth + height);
    EXPECT_LT(celerity, 0.6 * std::sqrt(9.81 * (depth + height)));
    EXPECT_NEAR(fastest(hump(0.5 * celerity), period).speed_over_celerity, 0.5, 0.03);
    // Froude's law: four times the gravity, half the period, twice the speed
    EXPECT_NEAR(fastest(hump(celerity), 0.5 * period, 4 * 9.81).speed_over_celerity, 0.5, 0.03);
}

TEST(CrestSpeed, SprayAndThinWaterAndTroughsAreNoCrests) {
    cmps::Particles spray = hump(0.1);
    for (int k = 0; k < 6; ++k)
        spray.add_fluid(1.0, 0.1 + 3 * k * l0, static_cast<std::int32_t>(spray.fluid), 5.0);
    EXPECT_LT(fastest(spray).speed_over_celerity, 0.1);
    EXPECT_EQ(fastest(hump(5.0, -height + 5 * l0)).speed_over_celerity, 0.0);  // five particles deep
    cmps::Particles trough;                                                    // fast, but below still water
    for (int i = 0; i < 200; ++i)
        for (int k = 0; k < 15; ++k)
            trough.add_fluid((i + 0.5) * l0, -depth + (k + 0.5) * l0, static_cast<std::int32_t>(trough.fluid),
                             5.0);
    EXPECT_EQ(fastest(trough).speed_over_celerity, 0.0);
    EXPECT_EQ(fastest(cmps::Particles()).speed_over_celerity, 0.0);
}

TEST(LinearWaves, ShoalAsTheirEnergyFluxSays) {
    // from deep water to 4 m: H/H0 = sqrt(c0 / (2 n c))
    const double deep = 9.81 * 8.0 / (2 * M_PI);
    const double k = 2 * M_PI / (8.0 * cmps::phase_speed(8.0, 4.0));
    EXPECT_NEAR(k * std::tanh(4.0 * k), 2 * M_PI / (8.0 * deep), 1e-12);  // dispersion relation
    const double n = 0.5 * (1 + 8.0 * k / std::sinh(8.0 * k));
    EXPECT_NEAR(cmps::shoaling(8.0, 500.0, 4.0), std::sqrt(0.5 * deep / (n * cmps::phase_speed(8.0, 4.0))),
                1e-9);
    EXPECT_DOUBLE_EQ(cmps::shoaling(0.0, 0.8, 0.05), 2.0);  // Green: (0.8 / 0.05)^(1/4)
}

}  // namespace
