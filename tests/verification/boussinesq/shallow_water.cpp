// Exact solutions of the shallow-water equations (dispersion off): Stoker, Ritter, Thacker.
#include <gtest/gtest.h>

#include <numbers>

#include "tests/support/boussinesq_flume.hpp"
#include "tests/support/figures.hpp"

namespace {

using namespace boussinesq_test;
using boussinesq::gravity;

Flume broken_dam(double upstream, double downstream, double spacing, double end) {
    Flume flume({{-10.0, 0.0}, {10.0, 0.0}}, spacing, scaled(upstream),
                {.dispersion = false, .shoreline = true});
    flume.start([&](double x) { return x < 0 ? upstream : downstream; }, [](double) { return 0.0; });
    flume.run_until(end);
    return flume;
}

/// Stoker (1957): depth at x after t of a dam at x = 0 between h1 and h0 > 0; Ritter (1892) for h0 = 0.
double dam_break_depth(double h1, double h0, double x, double t) {
    const double c1 = std::sqrt(gravity * h1);
    double middle = 0, shock = 2.0 * c1;
    if (h0 > 0) {
        // u_m = 2 (c1 - c_m) from the fan and from the shock relation, by bisection
        double low = h0, high = h1;
        for (int i = 0; i < 200; ++i) {
            middle = 0.5 * (low + high);
            const double fan = 2.0 * (c1 - std::sqrt(gravity * middle));
            const double jump = (middle - h0) * std::sqrt(0.5 * gravity * (middle + h0) / (middle * h0));
            (jump < fan ? low : high) = middle;
        }
        const double u = 2.0 * (c1 - std::sqrt(gravity * middle));
        shock = middle * u / (middle - h0);
    }
    if (x <= -c1 * t) return h1;
    const double tail = 2.0 * c1 - 3.0 * std::sqrt(gravity * middle);
    if (x <= tail * t) return std::pow(2.0 * c1 - x / t, 2) / (9.0 * gravity);
    return x <= shock * t ? middle : h0;
}

double dam_break_error(double h1, double h0, double spacing) {
    const double end = 1.5;
    const Flume flume = broken_dam(h1, h0, spacing, end);
    double error = 0;
    for (std::size_t i = 0; i < flume.grid.cells; ++i)
        error += std::abs(flume.depth(i) - dam_break_depth(h1, h0, flume.grid.centre(i), end)) * spacing;
    return error / (h1 * 10.0);
}

TEST(DamBreak, OnAWetBedIsStokers) {
    const double coarse = dam_break_error(1.0, 0.2, 0.1), fine = dam_break_error(1.0, 0.2, 0.05);
    std::printf("    mean error %.2e, %.2e of the depth: order %.2f\n", coarse, fine,
                std::log2(coarse / fine));
    EXPECT_TRUE(figures::error("boussinesq", "Stoker's dam break by cells of 0.05 m: mean difference", fine,
                               "of the depth"));
    EXPECT_LT(fine, 3e-3);                     // a cell of the shock is dx / 10 m = 5e-3 times its jump
    EXPECT_GT(std::log2(coarse / fine), 0.8);  // first order at a shock
}

TEST(DamBreak, OnADryBedIsRitters) {
    const double coarse = dam_break_error(1.0, 0.0, 0.1), fine = dam_break_error(1.0, 0.0, 0.05);
    std::printf("    mean error %.2e, %.2e of the depth: order %.2f\n", coarse, fine,
                std::log2(coarse / fine));
    EXPECT_TRUE(figures::error("boussinesq", "Ritter's dam break by cells of 0.05 m: mean difference", fine,
                               "of the depth"));
    EXPECT_LT(fine, 3e-3);                     // the front is a thin film, one to two cells late
    EXPECT_GT(std::log2(coarse / fine), 0.7);  // between the fan's second and the front's first order
}

TEST(ParabolicBowl, IsThackers) {
    // Thacker (1981), plane surface in a parabola: depth d over half-width a, surface slopes to and fro.
    const double depth = 1.0, half_width = 4.0, slope = 0.5;
    const double frequency = std::sqrt(2.0 * gravity * depth) / half_width;
    Polyline bowl;
    for (int i = 0; i <= 600; ++i) {
        const double x = -6.0 + 0.02 * i;
        bowl.push_back({x, depth * (x * x / (half_width * half_width) - 1.0)});
    }
    const auto surface = [&](double x, double t) {
        const double c = std::cos(frequency * t);
        return slope * depth / half_width * (2.0 * x * c / half_width - slope * c * c / half_width);
    };
    const double period = 2.0 * std::numbers::pi / frequency;
    const auto error_of = [&](double spacing) {
        Flume flume(bowl, spacing, scaled(depth), {.dispersion = false, .shoreline = true});
        flume.start([&](double x) { return surface(x, 0.0); }, [](double) { return 0.0; });
        const double water = flume.water();
        flume.run_until(2.0 * period);
        EXPECT_NEAR(flume.water() / water, 1.0, 1e-12);  // closed basin
        EXPECT_LT(flume.flow.water_made() / water, 1e-12);
        double error = 0, motion = 0;
        for (std::size_t i = 0; i < flume.grid.cells; ++i) {
            const double x = flume.grid.centre(i), bed = flume.flow.bed().level(i + boussinesq::ghost_cells);
            const double exact = std::max(surface(x, flume.time) - bed, 0.0);
            error += std::pow(flume.depth(i) - exact, 2);
            motion += std::pow(exact - std::max(-bed, 0.0), 2);
        }
        return std::sqrt(error / motion);
    };
    const double coarse = error_of(0.1), fine = error_of(0.05);
    std::printf("    error after two periods %.3f, %.3f of the motion: order %.2f\n", coarse, fine,
                std::log2(coarse / fine));
    EXPECT_TRUE(figures::error("boussinesq", "Thacker's bowl after two periods by 160 cells: rms difference",
                               fine, "of the motion"));
    EXPECT_GT(std::log2(coarse / fine), 0.8);  // first order there
}

}  // namespace
