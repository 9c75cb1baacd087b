#include <gtest/gtest.h>

#include <cmath>

#include "common/parallel.hpp"
#include "common/window_clock.hpp"

using namespace common;

TEST(WindowClock, TheSameInstantHasTheSameBitsForAnyWindowLength) {
    const auto all_samples = [](double length) {
        const WindowClock clock(2.0, 7.0, length);
        std::vector<double> all;
        for (std::int64_t k = 0; k < clock.window_count(); ++k) {
            auto samples = clock.samples_in(k, 0.025);
            all.insert(all.end(), samples.begin() + (k > 0), samples.end());
        }
        return all;
    };
    const auto whole = all_samples(5.0);
    EXPECT_EQ(whole.size(), 201u);
    EXPECT_EQ(all_samples(0.05), whole);
    EXPECT_EQ(all_samples(0.5), whole);
    EXPECT_EQ(all_samples(0.7), whole);  // 0.7 is 28 samples; the last window is shorter
}

TEST(WindowClock, LastWindowEndsExactlyAtTheEnd) {
    const WindowClock clock(0, 2.5, 1);
    EXPECT_EQ(clock.window_count(), 3);
    EXPECT_EQ(clock.end_of(2), 2.5);
    EXPECT_EQ(clock.begin_of(2), 2.0);
    EXPECT_EQ(WindowClock(0, 3 * 0.1, 0.1).window_count(), 3) << "rounding made a window of its own";
}

TEST(WindowClock, SamplesHoldBothEndsAndDoNotDependOnTheWindowLength) {
    const WindowClock clock(0, 1, 0.25);
    EXPECT_EQ(clock.samples_in(1, 0.1), (std::vector<double>{0.25, 0.3, 0.4, 0.5}));
    const WindowClock whole(0, 1, 1);
    const auto samples = whole.samples_in(0, 0.1);
    ASSERT_EQ(samples.size(), 11u);
    EXPECT_EQ(samples[3], 0.3);
}

TEST(WindowClock, TimesIncreaseHoweverOddTheIntervals) {
    // None of these is a whole number of nanoseconds: samples come as near to window ends as rounding allows.
    for (const double end : {0.2, 0.20000000037, 0.2000000021, 0.2333333333333333})
        for (const double length : {0.05, 0.0333333333333, 0.0100000000003})
            for (const double interval : {0.00333333333333, 0.0000999999994, 1.0000000004e-6, 1e-6}) {
                const WindowClock clock(0.0123456789012, end, length);
                for (std::int64_t k = 0; k < clock.window_count(); ++k) {
                    const auto samples = clock.samples_in(k, interval);
                    ASSERT_EQ(samples.front(), clock.begin_of(k));
                    ASSERT_EQ(samples.back(), clock.end_of(k));
                    for (std::size_t i = 1; i < samples.size(); ++i)
                        ASSERT_GT(samples[i], samples[i - 1]) << end << ' ' << length << ' ' << interval;
                }
            }
}

TEST(WindowClock, SamplesOfALongRunHaveNoSlivers) {
    const WindowClock clock(0, 4000, 0.7);
    for (std::int64_t k = 0; k < clock.window_count(); ++k) {
        const auto samples = clock.samples_in(k, 0.07);
        EXPECT_EQ(samples.front(), clock.begin_of(k));
        EXPECT_EQ(samples.back(), clock.end_of(k));
        for (std::size_t i = 1; i < samples.size(); ++i) EXPECT_GT(samples[i] - samples[i - 1], 0.01 * 0.07);
    }
}

TEST(WindowClock, IntervalsThatAreNoWholeNanosecondsGiveNoInstantTwice) {
    for (const double interval : {1e-4 / 3, 1e-5 / 7, 3.3e-5 + 1e-13, 1e-6})
        for (const double end : {0.01, 300 * interval, 0.01 + 4e-10}) {
            const auto samples = WindowClock(0, end, 1).samples_in(0, interval);
            for (std::size_t i = 1; i < samples.size(); ++i)
                ASSERT_GT(samples[i], samples[i - 1]) << interval;
        }
    for (const double length : {1e-4, 1e-3 / 3, 1e-4 + 1e-13}) {
        const WindowClock clock(0, 0.1, length);
        const auto last = clock.window_count() - 1;
        EXPECT_LT(clock.begin_of(last), clock.end_of(last)) << length;
    }
}

TEST(OrderedSum, SameBitsForAnyNumberOfThreads) {
    const auto sum = [] {
        return ordered_sum(300000, [](std::size_t i) { return std::sin(static_cast<double>(i)) * 1e3; });
    };
    omp_set_num_threads(1);
    const double one = sum();
    omp_set_num_threads(3);
    EXPECT_EQ(one, sum());
    omp_set_num_threads(1);
}
