// What windows lose of the waves, against incident waves sampled and interpolated.
#include "boussinesq/output_sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "boussinesq/waves/permanent_wave.hpp"
#include "boussinesq/waves/solitary_wave.hpp"

namespace {

using namespace boussinesq;

Scene scene_of(const std::string& waves) {
    return read_scene(common::SceneFile::parse(
        "[time]\nend = 20.0\n[flume]\nbed = [[0.0, -0.5], [60.0, -0.5]]\n[waves]\n" + waves, "test"));
}

/// Rms error over rms elevation from `begin` to `end` of a wave at one place, known every `interval` seconds.
template <class Wave>
double measured(const Wave& at, double interval, double begin, double end) {
    double lost = 0, all = 0;
    for (double t = begin; t < end; t += 0.0477) {
        const double k = std::floor(t / interval), s = t / interval - k;
        const auto sample = [&](double n) { return at((k + n) * interval); };
        const auto slope = [&](double n) {
            return 11.0 / 6.0 * sample(n) - 3.0 * sample(n - 1) + 1.5 * sample(n - 2) - sample(n - 3) / 3.0;
        };
        const double value = (1 + 2 * s) * (1 - s) * (1 - s) * sample(0) + s * (1 - s) * (1 - s) * slope(0) +
                             s * s * (3 - 2 * s) * sample(1) - s * s * (1 - s) * slope(1);
        const double exact = at(t);
        lost += std::pow(value - exact, 2), all += exact * exact;
    }
    return std::sqrt(lost / all);
}

/// Elevation at x = 0.
auto elevation_of(const IncidentWave& wave) {
    return [&wave](double t) {
        const double x[] = {0.0};
        double eta[1], u[1];
        wave.at(t, x, eta, u);
        return eta[0];
    };
}

TEST(OutputSampling, OfRegularWavesWithTheirHarmonics) {
    const Scene scene = scene_of("kind = \"regular\"\nheight = 0.15\nperiod = 2.0");
    const RegularWave wave(permanent_form(1.153, 0.15, 2.0, 0.5), 0.0);
    for (const double interval : {0.0917, 0.1531, 0.2713})
        EXPECT_NEAR(
            output_sampling_error(scene, interval) / measured(elevation_of(wave), interval, 0.0, 100.0), 1.0,
            0.1)
            << interval;
}

TEST(OutputSampling, OfASea) {
    const Scene scene = scene_of("kind = \"jonswap\"\nheight = 0.05\nperiod = 2.0\ncomponents = 50");
    const auto components = sea_components(scene.waves.sea, {.alpha = 1.153}, 0.5);
    const auto sum = [&](double t) {
        double eta = 0;
        for (const WaveComponent& c : components)
            eta += c.elevation_amplitude * std::cos(c.elevation_phase - c.angular_frequency * t);
        return eta;
    };
    for (const double interval : {0.0917, 0.1531, 0.2713})
        EXPECT_NEAR(output_sampling_error(scene, interval) / measured(sum, interval, 10.0, 1500.0), 1.0, 0.1)
            << interval;
}

TEST(OutputSampling, OfASolitaryWave) {
    const Scene scene = scene_of("kind = \"solitary\"\nheight = 0.2\nposition = 20.0");
    // where the crest lies between samples matters: mean of twenty places
    for (const double interval : {0.0917, 0.1531}) {
        double squares = 0;
        for (int place = 0; place < 20; ++place) {
            const SolitaryWave wave(1.153, 0.2, 0.5, -20.0 - 0.03 * place);  // passes x = 0 after about 8 s
            squares += std::pow(measured(elevation_of(wave), interval, 0.0, 20.0), 2) / 20.0;
        }
        EXPECT_NEAR(output_sampling_error(scene, interval) / std::sqrt(squares), 1.0, 0.25) << interval;
    }
}

TEST(OutputSampling, DefaultsLoseNothingOfAnyWaves) {
    for (const char* waves :
         {"kind = \"regular\"\nheight = 0.2\nperiod = 3.0", "kind = \"jonswap\"\nheight = 0.05\nperiod = 2.0",
          "kind = \"solitary\"\nheight = 0.2\nposition = 20.0"}) {
        const Scene scene = scene_of(waves);
        EXPECT_LT(output_sampling_error(scene, scene.output_interval), 2e-4) << waves;  // a tenth of fine
        EXPECT_EQ(scene.sampling_note, "");
    }
}

}  // namespace
