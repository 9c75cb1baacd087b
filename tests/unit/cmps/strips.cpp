#include "cmps/strips.hpp"

#include <gtest/gtest.h>

namespace {

TEST(Strips, AskOnlyIntervalsNearby) {
    std::vector<std::array<double, 2>> intervals;
    constexpr std::size_t count = 10'000;
    for (std::size_t i = 0; i < count; ++i)
        intervals.push_back({static_cast<double>(i), static_cast<double>(i) + 1.0});
    const cmps::Strips strips(intervals);
    std::size_t asked = 0;
    for (std::size_t i = 0; i < count; ++i) {
        bool is_found = false;
        const double at = static_cast<double>(i) + 0.5;
        strips.for_near(at, at, [&](std::size_t k) { ++asked, is_found = is_found || k == i; });
        EXPECT_TRUE(is_found) << i;
    }
    EXPECT_LE(asked, 4 * count);
}

}  // namespace
