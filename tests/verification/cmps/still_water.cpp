/// Water at rest must stay at rest: pressure rho g h, level, noise, energy.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/cmps_tank.hpp"

namespace {

struct StillWater {
    double mean = 0, noise = 0, rise = 0,
           speed = 0;  ///< pressure over rho g h, its rms; rise of the centre over depth; rms speed, m/s
};

StillWater run(double spacing, double duration) {
    constexpr double depth = 0.3, length = 0.4;
    cmps::NearField field(cmps_tank::settings(spacing, depth),
                          cmps_tank::particles(
                              length, spacing, [](double) { return depth; }, 0.5));
    field.settle(100, depth);
    const auto centre = [&] {
        double sum = 0;
        for (std::size_t i = field.particles.first_fluid(); i < field.particles.size(); ++i)
            sum += field.particles.z[i];
        return sum / static_cast<double>(field.particles.fluid);
    };
    const double before = centre();
    // wall particles stand half a spacing below the floor
    const double scale = 1000 * 9.81 * (depth + 0.5 * spacing);
    std::vector<double> pressure;
    cmps_tank::run(field, duration, [&](double time) {
        if (time > 0.5 * duration)
            pressure.push_back(cmps_tank::floor_pressure(field.particles, 0.5 * length, 1.1 * spacing) /
                               scale);
    });
    StillWater result;
    for (const double p : pressure) result.mean += p / static_cast<double>(pressure.size());
    for (const double p : pressure)
        result.noise += std::pow(p - result.mean, 2) / static_cast<double>(pressure.size());
    result.noise = std::sqrt(result.noise);
    result.rise = (centre() - before) / depth;
    for (std::size_t i = field.particles.first_fluid(); i < field.particles.size(); ++i)
        result.speed +=
            field.particles.u[i] * field.particles.u[i] + field.particles.w[i] * field.particles.w[i];
    result.speed = std::sqrt(result.speed / static_cast<double>(field.particles.fluid));
    return result;
}

TEST(StillWater, PressureLevelAndCalm) {
    const StillWater water = run(0.015, 10.0);
    RecordProperty("pressure", std::to_string(water.mean));
    RecordProperty("noise", std::to_string(water.noise));
    std::printf("pressure %.4f, noise %.4f, rise %.5f, rms speed %.4f m/s\n", water.mean, water.noise,
                water.rise, water.speed);
    EXPECT_NEAR(water.mean, 1.0, 0.01);   // a fifth of a spacing of depth
    EXPECT_LT(water.noise, 0.005);        // a tenth of what the standard method leaves (4-7 %)
    EXPECT_NEAR(water.rise, 0.0, 0.005);  // a tenth of a spacing
    EXPECT_LT(water.speed, 0.05);         // 3 % of the wave speed 1.7 m/s
}

}  // namespace
