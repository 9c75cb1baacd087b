/// Tables over time: the period of a path that swings.
#include "cmps/time_table.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>

namespace {

double period_of(const std::function<double(double)>& path) {
    const auto file = std::filesystem::temp_directory_path() /
                      ("tsunagi_path_that_swings_" + std::to_string(::getpid()) + ".csv");
    {
        std::ofstream rows(file);
        for (int i = 0; i <= 1000; ++i) rows << 0.01 * i << ", " << path(0.01 * i) << "\n";
    }
    const double period = cmps::TimeTable(file, 2).period(1);
    std::filesystem::remove(file);
    return period;
}

TEST(TimeTable, KnowsThePeriodOfAPathThatSwings) {
    const double omega = 2 * M_PI / 0.8;
    const auto swing = [&](double t) { return 0.05 * std::sin(omega * t); };
    EXPECT_NEAR(period_of(swing), 0.8, 0.01);  // a row
    EXPECT_NEAR(period_of([&](double t) { return 0.03 * t + swing(t); }), 0.8, 0.01);
    // what a probe adds is no swing
    EXPECT_NEAR(period_of([&](double t) { return swing(t) + 0.002 * std::sin(900.0 * t); }), 0.8, 0.02);
    EXPECT_NEAR(period_of([&](double t) { return t < 4 ? 0.0 : swing(t); }), 0.8, 0.01);
}

TEST(TimeTable, APathThatGoesOneWayHasNoPeriod) {
    EXPECT_EQ(period_of([](double) { return 0.3; }), 0.0);
    EXPECT_EQ(period_of([](double t) { return std::tanh(t - 5); }), 0.0);
    EXPECT_EQ(period_of([](double t) { return std::exp(-(t - 5) * (t - 5)); }), 0.0);  // there and back
}

}  // namespace
