// Statistics of made-up records with known answers, tables from files, beds.
#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "boussinesq/csv_table.hpp"
#include "boussinesq/grid.hpp"
#include "boussinesq/wave_statistics.hpp"
#include "common/errors.hpp"

namespace {

using namespace boussinesq;
constexpr double pi = std::numbers::pi;

TEST(WaveStatistics, OfARegularWave) {
    std::vector<double> time, elevation;
    for (int i = 0; i <= 2000; ++i) {
        time.push_back(0.01 * i);
        elevation.push_back(0.03 + 0.05 * std::sin(2 * pi * time.back() / 2.0));
    }
    const WaveStatistics s = wave_statistics(time, elevation);
    EXPECT_EQ(s.waves, 9u);  // ten periods, whose first crossing is the record's first sample
    EXPECT_NEAR(s.significant_height, 0.1, 1e-6);  // parabola through 200 samples a wave
    EXPECT_NEAR(s.significant_period, 2.0, 1e-6);
    EXPECT_NEAR(s.mean_level, 0.03, 1e-12);  // trapezoids over whole periods
    EXPECT_NEAR(4.0 * s.root_mean_square, 4.0 * 0.05 / std::sqrt(2.0), 1e-9);
}

TEST(WaveStatistics, HighestThirdOfThreeHeights) {
    // Waves of height 0.1, 0.2, 0.3 in turn: H_1/3 is the mean of the highest third, 0.3
    std::vector<double> time, elevation;
    for (int i = 0; i <= 3635; ++i) {
        const double t = 0.01 * i - 0.25;
        time.push_back(t);
        const int wave = static_cast<int>(std::floor(t)) % 3;
        elevation.push_back(0.05 * (1 + (wave < 0 ? 2 : wave)) * std::sin(2 * pi * t));
    }
    const WaveStatistics s = wave_statistics(time, elevation);
    EXPECT_NEAR(s.significant_height, 0.3, 1e-3);  // twelve of 36 waves, 100 samples each
    EXPECT_NEAR(s.largest_height, 0.3, 1e-4);
    EXPECT_NEAR(s.mean_height, 0.2, 1e-3);  // twelve waves of each
}

TEST(Reflection, TellsTwoWavesApart) {
    const LinearDispersion dispersion{.alpha = 1.153};
    const double w = 2 * pi / 1.65, k = dispersion.wave_number(w, 0.8), length = 2 * pi / k;
    const std::array<double, 3> place{10.0, 10.0 + 0.1 * length, 10.0 + 0.25 * length};
    std::vector<double> time;
    std::array<std::vector<double>, 3> elevation;
    for (int i = 0; i <= 660; ++i) {
        time.push_back(0.025 * i);
        for (std::size_t p = 0; p < 3; ++p)
            elevation[p].push_back(0.05 * std::cos(k * place[p] - w * time.back()) +
                                   0.012 * std::cos(k * place[p] + w * time.back() + 0.7));
    }
    const double lines[] = {w};
    const Reflection r =
        reflection_of(time, {elevation[0], elevation[1], elevation[2]}, place, 0.8, dispersion, lines);
    EXPECT_NEAR(r.incident_height, 0.1, 1e-9);  // ten whole periods: exact but for rounding
    EXPECT_NEAR(r.coefficient, 0.24, 1e-9);
}

TEST(CsvTable, NamesFileAndLineOfAMistake) {
    const auto path =
        std::filesystem::temp_directory_path() / ("boussinesq_table_" + std::to_string(::getpid()) + ".csv");
    const auto message = [&](const char* text) -> std::string {
        std::ofstream(path) << text;
        try {
            read_csv(path);
        } catch (const common::InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_EQ(message("t,eta\n0,1\n1,2\n"), "accepted");
    EXPECT_NE(message("t,eta\n0,1\n1\n").find(":3:"), std::string::npos);
    EXPECT_NE(message("t,eta\n0,inf\n").find("'inf' is not a finite number"), std::string::npos);
    EXPECT_NE(message("").find("header"), std::string::npos);
    std::filesystem::remove(path);
}

TEST(Bed, FollowsThePolylineAndMirrorsItsEnds) {
    const Grid grid{.offshore_end = 1.0, .spacing = 0.5, .cells = 8};
    const Bed bed(grid, {{1.0, -1.0}, {3.0, -0.6}, {5.0, -0.6}});
    EXPECT_DOUBLE_EQ(bed.level(ghost_cells), -0.95);
    EXPECT_NEAR(bed.level(ghost_cells + 7), -0.6, 1e-15);
    EXPECT_DOUBLE_EQ(bed.level(ghost_cells - 1), bed.level(ghost_cells));
    EXPECT_DOUBLE_EQ(bed.level(ghost_cells - 3), bed.level(ghost_cells + 2));
    EXPECT_DOUBLE_EQ(bed.largest_depth(), 1.0);
}

}  // namespace
