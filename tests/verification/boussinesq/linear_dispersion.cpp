// Standing waves of small height between walls: their frequency against the equations' own dispersion
// relation and Airy's.
#include <gtest/gtest.h>

#include <numbers>

#include "boussinesq/waves/wave_theory.hpp"
#include "tests/support/boussinesq_flume.hpp"
#include "tests/support/figures.hpp"

namespace {

using namespace boussinesq_test;
constexpr double pi = std::numbers::pi;

/// Angular frequency of the standing wave with k d = kh in 1 m of water, from the zero crossings of its
/// amplitude.
double standing_frequency(double alpha, double kh, double cells_per_length) {
    const double length = 2.0 * pi / kh, basin = 1.5 * length;
    Flume flume({{0.0, -1.0}, {basin, -1.0}}, length / cells_per_length, scaled(1.0, alpha),
                {.dispersion = true, .shoreline = false});
    flume.start([&](double x) { return 1e-4 * std::cos(kh * x); }, [](double) { return 0.0; });
    const double expected = boussinesq::LinearDispersion{.alpha = alpha}.angular_frequency(kh, 1.0);
    std::vector<double> crossings;
    double before = 1.0, time_before = 0.0;
    flume.run_until(10.0 * 2.0 * pi / expected, 0.5, [&] {
        double amplitude = 0;
        for (std::size_t i = 0; i < flume.grid.cells; ++i)
            amplitude += flume.elevation(i) * std::cos(kh * flume.grid.centre(i));
        if (before * amplitude < 0.0)
            crossings.push_back(time_before + (flume.time - time_before) * before / (before - amplitude));
        before = amplitude;
        time_before = flume.time;
    });
    return pi * static_cast<double>(crossings.size() - 1) / (crossings.back() - crossings.front());
}

TEST(LinearDispersion, StandingWavesHaveTheFrequencyOfTheEquationsAndNearlyAirys) {
    double off_equations = 0, off_airy = 0;
    for (const double kh : {0.5, 1.0, 1.5, 2.0, 2.5, 3.0}) {
        const double measured = standing_frequency(1.153, kh, 40);
        const double equations = boussinesq::LinearDispersion{.alpha = 1.153}.angular_frequency(kh, 1.0);
        const double airy = std::sqrt(boussinesq::gravity * kh * std::tanh(kh));
        std::printf("    kh %.1f: %+.4f %% of the equations, %+.3f %% of Airy\n", kh,
                    100 * (measured / equations - 1), 100 * (measured / airy - 1));
        off_equations = std::max(off_equations, std::abs(measured / equations - 1));
        off_airy = std::max(off_airy, std::abs(measured / airy - 1));
    }
    const std::string of =
        "frequency of standing waves at kh 0.5 to 3 by 40 cells a length: largest difference to ";
    EXPECT_TRUE(figures::error("boussinesq", of + "the equations", 100 * off_equations, "%"));
    EXPECT_LT(off_airy, 0.0090);  // the equations themselves: at most 0.89 %, at kh = 2.5
    EXPECT_TRUE(figures::error("boussinesq", of + "Airy", 100 * off_airy, "%"));
}

TEST(LinearDispersionOrder, FrequencyConvergesAtFourthOrderOnALevelBed) {
    const double exact = boussinesq::LinearDispersion{.alpha = 1.153}.angular_frequency(1.0, 1.0);
    const double coarse = std::abs(standing_frequency(1.153, 1.0, 10) / exact - 1),
                 fine = std::abs(standing_frequency(1.153, 1.0, 20) / exact - 1);
    const double order = std::log2(coarse / fine);
    std::printf("    errors %.2e, %.2e: order %.2f\n", coarse, fine, order);
    EXPECT_GT(order, 2.8);  // third order in time, fourth in space
}

TEST(LinearDispersionAlpha, PhaseSpeedsOfTheThreeAlphasAreThePublishedOnes) {
    const auto error = [](double alpha, double kh) {
        return boussinesq::LinearDispersion{.alpha = alpha}.angular_frequency(kh, 1.0) /
                   std::sqrt(boussinesq::gravity * kh * std::tanh(kh)) -
               1.0;
    };
    // Madsen and Sorensen (1992) with B = 1/15, the same relation as alpha = 1.2, to the digits quoted
    EXPECT_NEAR(error(1.2, 1.0), 0.0002, 5e-5);
    EXPECT_NEAR(error(1.2, 2.0), 0.0053, 5e-5);
    EXPECT_NEAR(error(1.2, 3.0), 0.024, 5e-4);
    EXPECT_NEAR(error(1.153, 2.0), -0.0078, 1e-4);
}

}  // namespace
