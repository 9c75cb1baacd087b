// Wave theory, incident waves and the vertical profile against exact or published answers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "boussinesq/grid.hpp"
#include "boussinesq/vertical_profile.hpp"
#include "boussinesq/waves/permanent_wave.hpp"
#include "boussinesq/waves/solitary_wave.hpp"
#include "boussinesq/waves/wave_components.hpp"
#include "boussinesq/waves/wave_theory.hpp"
#include "common/errors.hpp"

namespace {

using namespace boussinesq;
constexpr double pi = std::numbers::pi;

TEST(AiryWaves, SatisfyTheirDispersionRelation) {
    for (const double kd : {0.05, 0.5, 1.35, 3.0, 10.0}) {
        const double w = std::sqrt(gravity * kd / 0.8 * std::tanh(kd));
        EXPECT_NEAR(airy_wave_number(w, 0.8) * 0.8, kd, 1e-13 * kd);  // Newton to the last digits
    }
    // Deep water: half the phase speed; shallow water: sqrt(g d)
    EXPECT_NEAR(airy_group_speed(10.0, 1.0), 0.5 * std::sqrt(gravity / 10.0), 1e-6);  // 1/sinh(20) is left
    EXPECT_NEAR(airy_group_speed(0.01, 1.0), std::sqrt(gravity), 1e-3);               // (k d)^2 / 2 is left
}

TEST(LinearDispersionOfTheEquations, InvertsItself) {
    for (const double alpha : {1.0, 1.153, 1.2})
        for (const double kd : {0.1, 1.0, 3.0}) {
            const LinearDispersion relation{.alpha = alpha};
            EXPECT_NEAR(relation.wave_number(relation.angular_frequency(kd / 0.5, 0.5), 0.5) * 0.5, kd,
                        1e-12);  // closed form
        }
    // alpha = 1 carries no frequency with w^2 d / g >= 3
    EXPECT_TRUE(std::isnan(LinearDispersion{.alpha = 1.0}.wave_number(std::sqrt(3.5 * gravity), 1.0)));
}

TEST(PermanentForm, OfTheClassicalEquationsIsTheExactCnoidalWave) {
    for (const double height : {0.02, 0.1, 0.2}) {
        const CnoidalWave exact = cnoidal_wave(height, 3.0, 0.4);
        const PermanentForm form = permanent_form(1.0, height, 3.0, 0.4);
        EXPECT_NEAR(form.speed, exact.speed(0.4), 1e-9);
        for (int i = 0; i <= 50; ++i)
            EXPECT_NEAR(form.elevation(pi * i / 50), exact.depth_at(pi * i / 50) - 0.4,
                        1e-9);  // Newton stops at 1e-13, modes at 1e-10
        // The same by Newton where alpha = 1 takes the elliptic functions.
        const PermanentForm beside = permanent_form(1.0 + 1e-9, height, 3.0, 0.4);
        EXPECT_NEAR(beside.speed, exact.speed(0.4), 1e-7);
        EXPECT_NEAR(beside.elevation(0.0), form.elevation(0.0), 1e-7);
    }
}

TEST(PermanentForm, TendsToTheLinearWave) {
    const PermanentForm form = permanent_form(1.153, 1e-4, 1.65, 0.8);
    const double k = LinearDispersion{.alpha = 1.153}.wave_number(2 * pi / 1.65, 0.8);
    EXPECT_NEAR(form.length, 2 * pi / k, 1e-6);  // corrections are of second order in steepness: 1e-8
    EXPECT_NEAR(form.elevation(0.0), 0.5e-4, 1e-8);
}

TEST(PermanentForm, CarriesNoMeanMass) {
    const RegularWave wave(permanent_form(1.153, 0.3, 1.65, 0.8), 0.0);
    std::vector<double> x(1000), elevation(1000), velocity(1000);
    const double length = permanent_form(1.153, 0.3, 1.65, 0.8).length;
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = length * static_cast<double>(i) / 1000.0;
    wave.at(0.7, x, elevation, velocity);
    double level = 0, flux = 0, lowest = 0, highest = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        level += elevation[i] / 1000.0;
        flux += (0.8 + elevation[i]) * velocity[i] / 1000.0;
        lowest = std::min(lowest, elevation[i]);
        highest = std::max(highest, elevation[i]);
    }
    EXPECT_NEAR(level, 0.0, 1e-9);  // cubic interpolation in a table of 2048
    EXPECT_NEAR(flux, 0.0, 1e-9);
    EXPECT_NEAR(highest - lowest, 0.3, 1e-5);
}

TEST(PermanentForm, RefusesWavesTheEquationsDoNotCarry) {
    EXPECT_THROW(permanent_form(1.0, 0.01, 0.9, 0.8), common::InputError);
}

TEST(LargestWaveHeight, IsFentonsFitOfWilliamsWaves) {
    EXPECT_NEAR(largest_wave_height(1000.0, 1.0), 0.833, 0.002);     // solitary limit
    EXPECT_NEAR(largest_wave_height(0.5, 1.0) / 0.5, 0.141, 0.005);  // deep water: H/L = 0.141
}

TEST(SolitaryWave, OfTheClassicalEquationsIsTheSechSquared) {
    const SolitaryWave wave(1.0, 0.2, 1.0, 0.0);
    const double k = std::sqrt(3.0 * 0.2 / (4.0 * 1.2));
    for (const double x : {0.0, 0.7, 2.0, 5.0, 9.0})
        EXPECT_NEAR(wave.elevation(x), 0.2 / std::pow(std::cosh(k * x), 2),
                    1e-8);  // RK4 at 0.01 of the decay length
}

TEST(SeaState, HasTheEnergyAskedForAndRepeats) {
    const SeaState sea{.spectrum = Spectrum::jonswap,
                       .significant_height = 0.1,
                       .peak_period = 2.0,
                       .components = 300,
                       .seed = 5};
    const auto components = sea_components(sea, LinearDispersion{.alpha = 1.153}, 0.8);
    double energy = 0;
    for (const auto& c : components) energy += 0.5 * c.elevation_amplitude * c.elevation_amplitude;
    EXPECT_NEAR(4.0 * std::sqrt(energy), 0.1, 1e-12);  // equal shares by construction
    const auto again = sea_components(sea, LinearDispersion{.alpha = 1.153}, 0.8);
    EXPECT_EQ(components[17].elevation_phase, again[17].elevation_phase);
    auto other = sea;
    other.seed = 6;
    EXPECT_NE(components[17].elevation_phase,
              sea_components(other, LinearDispersion{.alpha = 1.153}, 0.8)[17].elevation_phase);
}

TEST(ComponentWave, IsTheSumOfItsComponents) {
    const auto components =
        sea_components({.significant_height = 0.1, .peak_period = 2.0, .components = 50, .seed = 2},
                       LinearDispersion{.alpha = 1.153}, 0.8);
    const ComponentWave wave(components, 3.0, 0.02);
    std::vector<double> x{0.0, 0.5, 1.0, 1.5}, elevation(4), velocity(4);
    for (const double t : {0.0, 0.731, 12.5}) {
        wave.at(t, x, elevation, velocity);
        for (std::size_t i = 0; i < x.size(); ++i) {
            double expected = 0;
            for (const auto& c : components)
                expected += c.elevation_amplitude * std::cos(c.wave_number * (x[i] - 3.0) -
                                                             c.angular_frequency * t + c.elevation_phase);
            EXPECT_NEAR(elevation[i], expected, 1e-6);  // cubic in time: (w dt)^4 / 40 of the height
        }
    }
}

TEST(RecordComponents, GiveTheRecordBack) {
    std::vector<double> time, elevation;
    for (int i = 0; i <= 800; ++i) {
        const double t = 0.05 * i;
        time.push_back(t);
        elevation.push_back(0.02 * std::exp(-std::pow((t - 20.0) / 6.0, 2)) * std::cos(3.0 * t));
    }
    const LinearDispersion dispersion{.alpha = 1.153};
    const WaveRecord record{.time = time, .elevation = elevation, .velocity = {}};
    const WaveDuration duration = record_duration(record, -2.0, 5.0, 2.1, dispersion, 0.8);
    const ComponentWave wave(record_components(record, duration.end - duration.begin, dispersion, 0.8), 7.0,
                             0.01, std::nullopt, duration);
    std::vector<double> x{7.0}, e(1), u(1);
    for (const double t : {10.0, 18.3, 24.7, 30.0}) {
        wave.at(t, x, e, u);
        EXPECT_NEAR(e[0], 0.02 * std::exp(-std::pow((t - 20.0) / 6.0, 2)) * std::cos(3.0 * t),
                    2e-5);  // a thousandth of the height: splines and left-out lines
    }
    // Once it is over it is over: to the last bit, at any later time.
    for (const double t : {duration.begin - 0.1, duration.end + 0.1, 52.0, 60.0, 100.0}) {
        wave.at(t, x, e, u);
        EXPECT_EQ(e[0], 0.0) << t;
        EXPECT_EQ(u[0], 0.0) << t;
    }
}

TEST(VerticalProfile, IsTheLinearWavesToItsOrder) {
    const double kd = 0.5, depth = 1.0, average = 1.0;
    // Airy: u ~ cosh k(z + d), w ~ sinh; normalised to the depth average of u
    const auto airy = [&](double z) {
        return average * kd * std::cosh(kd * (z + depth)) / std::sinh(kd * depth);
    };
    const Column column{.velocity = average,
                        .velocity_slope = 0.0,
                        .velocity_curvature = -kd * kd * average,
                        .bed = -depth,
                        .bed_slope = 0.0,
                        .bed_curvature = 0.0,
                        .depth = depth};
    for (const double z : {-1.0, -0.7, -0.3, 0.0})
        EXPECT_NEAR(velocity_at(column, z).horizontal, airy(z), 0.003);  // (k d)^4 / 24 = 0.0026
    double mean = 0;
    for (int i = 0; i < 1000; ++i) mean += velocity_at(column, -1.0 + (i + 0.5) / 1000.0).horizontal / 1000.0;
    EXPECT_NEAR(mean, average, 1e-6);  // midpoint rule
    // Through a sloping bed no water flows: w = u b_x at the bed
    const Column slope{.velocity = 0.4,
                       .velocity_slope = 0.1,
                       .velocity_curvature = 0.02,
                       .bed = -1.0,
                       .bed_slope = 0.1,
                       .bed_curvature = 0.0,
                       .depth = 1.0};
    EXPECT_DOUBLE_EQ(velocity_at(slope, -1.0).vertical, 0.04);
}

}  // namespace
