#include "common/sampling_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

using common::Interpolation;
using common::sampling_error;

namespace {

/// Interpolates a sinusoid at many instants and phases, by Lagrange's polynomials.
double found(Interpolation interpolation, double samples) {
    const double angle = 2.0 * std::numbers::pi / samples;
    double squares = 0;
    int count = 0;
    for (int phase = 0; phase < 40; ++phase)
        for (int i = 0; i < 200; ++i, ++count) {
            const double s = (i + 0.5) / 200.0;
            const auto wave = [&](double t) {
                return std::cos(angle * t + 2.0 * std::numbers::pi * phase / 40);
            };
            // slope at 0 of the cubic through -3, -2, -1 and 0, moved by m
            const auto slope = [&](double m) {
                const double step = 1e-3;
                const auto cubic = [&](double t) {
                    double sum = 0;
                    for (int a = -3; a <= 0; ++a) {
                        double basis = 1;
                        for (int b = -3; b <= 0; ++b)
                            if (b != a) basis *= (t - b) / (a - b);
                        sum += basis * wave(m + a);
                    }
                    return sum;
                };
                return (8 * (cubic(step) - cubic(-step)) - (cubic(2 * step) - cubic(-2 * step))) /
                       (12 * step);
            };
            const double value =
                interpolation == Interpolation::linear
                    ? (1 - s) * wave(0) + s * wave(1)
                    : (2 * s * s * s - 3 * s * s + 1) * wave(0) + (s * s * s - 2 * s * s + s) * slope(0) +
                          (3 * s * s - 2 * s * s * s) * wave(1) + (s * s * s - s * s) * slope(1);
            squares += std::pow(value - wave(s), 2);
        }
    return std::sqrt(2.0 * squares / count);
}

}  // namespace

TEST(SamplingError, IsThatOfASinusoidInterpolated) {
    for (const auto interpolation : {Interpolation::linear, Interpolation::cubic_slopes})
        for (const double samples : {4.3, 8.0, 12.0, 30.0})
            EXPECT_NEAR(sampling_error(interpolation, samples) / found(interpolation, samples), 1.0, 1e-3)
                << samples;
}

TEST(SamplingError, FallsWithTheOrderOfTheInterpolation) {
    const auto order = [](Interpolation interpolation) {
        return std::log2(sampling_error(interpolation, 100) / sampling_error(interpolation, 200));
    };
    EXPECT_NEAR(order(Interpolation::linear), 2.0, 0.01);
    EXPECT_NEAR(order(Interpolation::cubic_slopes), 4.0, 0.1);
    // a straight line is off by angle^2 / sqrt(120)
    EXPECT_NEAR(sampling_error(Interpolation::linear, 1000) /
                    (std::pow(2e-3 * std::numbers::pi, 2) / std::sqrt(120.0)),
                1.0, 1e-4);
}

TEST(SamplingError, SaysWhereSamplesSayNothing) {
    for (const double samples : {0.1, 0.5, 1.0, 1.5, 2.0})
        for (const auto interpolation : {Interpolation::linear, Interpolation::cubic_slopes})
            EXPECT_GT(sampling_error(interpolation, samples), 0.5) << samples;
}
