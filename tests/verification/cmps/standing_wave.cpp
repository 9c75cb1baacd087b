/// Standing wave in a tank of half a wave length: period against Airy theory, decay, and how both fall with l0.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/cmps_tank.hpp"

namespace {

constexpr double depth = 0.3, length = 0.6, amplitude = 0.015;
constexpr double wave_number = M_PI / length;

struct Wave {
    double period_ratio;  ///< simulated over Airy
    double kept;          ///< amplitude after five periods over that of the first
};

Wave run(double spacing, cmps::TimeStepping stepping) {
    auto settings = cmps_tank::settings(spacing, depth);
    settings.time_stepping = stepping;
    cmps::NearField field(settings, cmps_tank::particles(length, spacing, [](double x) { return depth + amplitude * std::cos(wave_number * x); }, 0.5));
    field.settle(100, depth);
    const double period = 2 * M_PI / std::sqrt(9.81 * wave_number * std::tanh(wave_number * depth));
    // first mode of the surface: the moment of z cos(kx) is proportional to its amplitude
    std::vector<double> time, mode;
    cmps_tank::run(field, 6.3 * period, [&](double t) {
        double sum = 0;
        for (std::size_t i = field.particles.first_fluid(); i < field.particles.size(); ++i)
            sum += field.particles.z[i] * std::cos(wave_number * field.particles.x[i]);
        time.push_back(t);
        mode.push_back(sum * spacing * spacing / (0.5 * depth * length));
    });
    std::vector<double> crossings, crests;
    double crest = 0;
    for (std::size_t k = 1; k < time.size(); ++k) {
        crest = std::max(crest, std::abs(mode[k]));
        if (mode[k - 1] * mode[k] >= 0) continue;
        crossings.push_back(time[k - 1] + (time[k] - time[k - 1]) * mode[k - 1] / (mode[k - 1] - mode[k]));
        crests.push_back(crest);
        crest = 0;
    }
    // the first half swing starts from the settled lattice: count from the second
    const double simulated = 2 * (crossings[10] - crossings[0]) / 10;
    return {.period_ratio = simulated / period, .kept = crests[11] / crests[1]};
}

TEST(StandingWave, PeriodAndHeightConverge) {
    const Wave coarse = run(0.03, cmps::TimeStepping::midpoint), fine = run(0.015, cmps::TimeStepping::midpoint);
    const double order = std::log2(std::abs(coarse.period_ratio - 1) / std::abs(fine.period_ratio - 1));
    std::printf("h/l0 = 10: period %.4f, kept %.3f; h/l0 = 20: period %.4f, kept %.3f; observed order of the period %.2f\n",
                coarse.period_ratio, coarse.kept, fine.period_ratio, fine.kept, order);
    EXPECT_NEAR(fine.period_ratio, 1.0, 0.015);  // half a spacing of depth would be 1 %; finite amplitude (ka)^2/8 < 0.1 %
    EXPECT_GT(fine.kept, 0.93);                  // 1.5 % a period; predicted stepping alone loses omega^2 dt T / 2 = 3 % a period
    EXPECT_GT(order, 0.7);                       // first order: the surface is known to a share of l0
}

TEST(StandingWave, MidpointKeepsWhatPredictedStepsLose) {
    const Wave midpoint = run(0.02, cmps::TimeStepping::midpoint), predicted = run(0.02, cmps::TimeStepping::predicted);
    std::printf("h/l0 = 15, five periods: midpoint keeps %.3f, predicted keeps %.3f\n", midpoint.kept, predicted.kept);
    EXPECT_GT(midpoint.kept, predicted.kept + 0.1);  // theory: exp(-pi omega dt) a period for predicted steps
}

}  // namespace
