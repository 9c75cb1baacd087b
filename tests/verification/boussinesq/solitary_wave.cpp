// The solitary wave of the equations over 100 depths: shape, speed, energy; and the order of the scheme on
// it.
#include <gtest/gtest.h>

#include "boussinesq/waves/solitary_wave.hpp"
#include "tests/support/boussinesq_flume.hpp"
#include "tests/support/figures.hpp"

namespace {

using namespace boussinesq_test;

struct Outcome {
    double shape_error;   ///< largest difference to the exact wave over its height
    double speed_error;   ///< relative, from the crest's place
    double height_error;  ///< relative
    double energy_error;  ///< relative, of the classical energy
};

Outcome travel(double alpha, double height, double spacing, double distance = 100.0) {
    const double begin = 25.0;
    const boussinesq::SolitaryWave wave(alpha, height, 1.0, begin);
    Flume flume({{0.0, -1.0}, {distance + 55.0, -1.0}}, spacing, scaled(1.0, alpha),
                {.dispersion = true, .shoreline = false});
    flume.start([&](double x) { return wave.elevation(x - begin); },
                [&](double x) {
                    const double e = wave.elevation(x - begin);
                    return wave.speed() * e / (1.0 + e);
                });
    const auto energy = [&] {
        double sum = 0;
        for (std::size_t i = 1; i + 1 < flume.grid.cells; ++i) {
            const double h = flume.depth(i), u = flume.discharge(i) / h;
            const double stretch =
                (flume.discharge(i + 1) / flume.depth(i + 1) - flume.discharge(i - 1) / flume.depth(i - 1)) /
                (2.0 * spacing);
            sum += 0.5 * boussinesq::gravity * (h - 1.0) * (h - 1.0) + 0.5 * h * u * u +
                   h * h * h * stretch * stretch / 6.0;
        }
        return sum * spacing;
    };
    const double energy_before = energy();
    const double duration = distance / wave.speed();
    flume.run_until(duration);
    Outcome outcome{};
    double crest = 0, place = 0;
    for (std::size_t i = 1; i + 1 < flume.grid.cells; ++i) {
        const double e = flume.elevation(i), x = flume.grid.centre(i);
        // Simpson's average of the exact wave over the cell
        const double d = x - begin - distance;
        const double exact = (wave.elevation(d - 0.5 * spacing) + 4.0 * wave.elevation(d) +
                              wave.elevation(d + 0.5 * spacing)) /
                             6.0;
        outcome.shape_error = std::max(outcome.shape_error, std::abs(e - exact) / height);
        const double left = flume.elevation(i - 1), right = flume.elevation(i + 1);
        if (e > left && e >= right && e > 0.5 * height) {
            const double shift = 0.5 * (left - right) / (left - 2.0 * e + right);
            place = x + shift * spacing;
            crest = e - 0.25 * (left - right) * shift;
        }
    }
    outcome.speed_error = (place - begin) / distance - 1.0;
    outcome.height_error = crest / height - 1.0;
    outcome.energy_error = energy() / energy_before - 1.0;
    std::printf(
        "    alpha %.3f, H/d %.1f, dx/d %.3f: shape %.2e H, speed %+.2e, height %+.2e, energy %+.2e\n", alpha,
        height, spacing, outcome.shape_error, outcome.speed_error, outcome.height_error,
        outcome.energy_error);
    return outcome;
}

TEST(SolitaryWave, SpeedOfTheClassicalEquationsIsTheExactOne) {
    // c^2 = g (d + H) for alpha = 1 (Serre 1953); quadrature error below 1e-10
    for (const double height : {0.1, 0.3, 0.6})
        EXPECT_NEAR(boussinesq::solitary_speed(1.0, height, 1.0),
                    std::sqrt(boussinesq::gravity * (1.0 + height)), 1e-9);
}

TEST(SolitaryWave, KeepsShapeSpeedAndEnergyOverAHundredDepths) {
    for (const double alpha : {1.0, 1.153}) {
        const Outcome outcome = travel(alpha, 0.2, 0.1);
        const std::string wave = fmt::format("solitary wave of 0.2 d after 100 d (alpha {}): ", alpha);
        EXPECT_TRUE(figures::error("boussinesq", wave + "shape", outcome.shape_error, "H"));
        EXPECT_TRUE(figures::error("boussinesq", wave + "speed", outcome.speed_error));
        EXPECT_TRUE(figures::error("boussinesq", wave + "height", outcome.height_error));
        EXPECT_TRUE(figures::error("boussinesq", wave + "energy", outcome.energy_error));
    }
}

TEST(SolitaryWave, KeepsFormAtThreeFifthsOfTheDepth) {
    const Outcome outcome = travel(1.153, 0.6, 0.1);
    const std::string wave = "solitary wave of 0.6 d after 100 d (alpha 1.153): ";
    EXPECT_TRUE(figures::error("boussinesq", wave + "shape", outcome.shape_error, "H"));
    EXPECT_TRUE(figures::error("boussinesq", wave + "energy", outcome.energy_error));
}

TEST(SolitaryWave, ErrorFallsAtSecondOrder) {
    const double coarse = travel(1.0, 0.2, 0.2).shape_error, middle = travel(1.0, 0.2, 0.1).shape_error,
                 fine = travel(1.0, 0.2, 0.05).shape_error;
    std::printf("    orders %.2f, %.2f\n", std::log2(coarse / middle), std::log2(middle / fine));
    EXPECT_GT(std::log2(coarse / middle), 1.8);  // formal order 2 of the nonlinear terms
    EXPECT_GT(std::log2(middle / fine), 1.8);
}

}  // namespace
