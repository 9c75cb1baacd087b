/// Means over a fixed time of steps of any length.
#include "cmps/running_mean.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace {

/// The mean over [t - duration, t] of a step function, by its antiderivative; steps 0.1 to 0.9 ms long.
double step_length(int k) {
    return 1e-4 * (1 + (7 * k) % 9);
}
double value(int k, double channel) {
    return std::sin(0.3 * k) + channel;
}

TEST(RunningMean, IsExactForStepsOfAnyLength) {
    constexpr double duration = 4e-3;
    cmps::RunningMean means(duration, 2);
    std::vector<double> ends = {0.0}, integral = {0.0};
    for (int k = 0; k < 200; ++k) {
        const auto values = means.add_step(step_length(k));
        values[0] = value(k, 0), values[1] = value(k, 10);
        ends.push_back(ends.back() + step_length(k));
        integral.push_back(integral.back() + step_length(k) * value(k, 0));
        const auto until = [&](double time) {
            std::size_t i = 0;
            while (ends[i + 1] < time) ++i;
            return integral[i] + (time - ends[i]) / (ends[i + 1] - ends[i]) * (integral[i + 1] - integral[i]);
        };
        const double end = ends.back(), from = std::max(0.0, end - duration);
        const double truth = (until(end) - until(from)) / (end - from);
        ASSERT_NEAR(means.mean(0), truth, 1e-11) << k;  // differences of sums that grow to 0.1
        ASSERT_NEAR(means.mean(1), truth + 10, 1e-11) << k;
    }
}

TEST(RunningMean, GoesOnBitForBit) {
    cmps::RunningMean whole(4e-3, 1), stopped(4e-3, 1), resumed(4e-3, 1);
    for (int k = 0; k < 60; ++k) {
        whole.add_step(step_length(k))[0] = value(k, 0);
        if (k < 40) stopped.add_step(step_length(k))[0] = value(k, 0);
        if (k == 39) resumed.restore(stopped.state());
        if (k >= 40) resumed.add_step(step_length(k))[0] = value(k, 0);
        if (k < 39) continue;
        ASSERT_EQ(whole.mean(0), resumed.mean(0)) << k;
    }
    EXPECT_EQ(whole.state(), resumed.state());
}

TEST(RunningMean, OfNoTimeIsTheLastStep) {
    cmps::RunningMean means(0, 1);
    EXPECT_TRUE(means.is_empty());
    for (int k = 0; k < 50; ++k) {
        means.add_step(step_length(k))[0] = value(k, 0);
        EXPECT_EQ(means.mean(0), value(k, 0));
    }
}

}  // namespace
