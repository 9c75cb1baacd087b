// What samples lose of waves, against waves that are sampled and interpolated.
#include "cmps/wave_sampling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "cmps/effect_rules.hpp"
#include "common/errors.hpp"

namespace {

using common::Interpolation;

cmps::Scene scene_of(const std::string& waves, const std::string& flow, const std::string& accuracy) {
    const auto file = common::SceneFile::parse(
        "accuracy = \"" + accuracy +
            "\"\n[time]\nend = 20.0\nwindow = 2.0\n[flume]\nbed = [[0.0, -0.4], [60.0, -0.4]]\n[waves]\n" +
            waves +
            "\n[cmps]\noffshore = 30.0\nonshore = 34.0\nparticle_spacing = 0.025\n[cmps.flow]\nx = [31.0, "
            "33.0]\n"
            "z = [-0.4, 0.2]\n" +
            flow,
        "test");
    cmps::Scene scene = cmps::read_scene(file);
    decide_effects(file, scene);
    file.finish();
    return scene;
}

const std::string regular = "kind = \"regular\"\nheight = 0.1\nperiod = 1.65";
const std::string sea = "kind = \"jonswap\"\nheight = 0.1\nperiod = 2.0";
const std::string solitary = "kind = \"solitary\"\nheight = 0.1";

/// Rms error over rms of waves that are straight between samples.
template <class Wave>
double measured(const Wave& at, double interval, double begin, double end) {
    double lost = 0, all = 0;
    for (double t = begin; t < end; t += 0.00477) {
        const double k = std::floor(t / interval), s = t / interval - k, exact = at(t);
        lost += std::pow((1 - s) * at(k * interval) + s * at((k + 1) * interval) - exact, 2);
        all += exact * exact;
    }
    return std::sqrt(lost / all);
}

TEST(WaveSampling, ErrorIsThatOfWavesBetweenTheirSamples) {
    const auto lines = wave_lines(scene_of(regular, "interval = 0.02", "draft"));
    const auto wave = [](double t) { return std::cos(2 * std::acos(-1.0) / 1.65 * t); };
    for (const double interval : {0.02, 0.0917, 0.271})
        EXPECT_NEAR(
            wave_sampling_error(lines, Interpolation::linear, interval) / measured(wave, interval, 0, 90),
            1.0, 0.03);
    const auto crest = wave_lines(scene_of(solitary, "interval = 0.02", "draft"));
    const double rate = std::sqrt(0.75 * 0.1 / 0.4) / 0.4 * std::sqrt(9.81 * 0.5);
    const auto pulse = [&](double t) { return std::pow(std::cosh(rate * (t - 10.0131)), -2); };
    for (const double interval : {0.02, 0.0917})
        EXPECT_NEAR(
            wave_sampling_error(crest, Interpolation::linear, interval) / measured(pulse, interval, 0, 20),
            1.0, 0.1);
}

TEST(WaveSampling, ASeaLosesMoreThanItsPeak) {
    const auto lines = wave_lines(scene_of(sea, "interval = 0.02", "draft"));
    const double of_sea = wave_sampling_error(lines, Interpolation::linear, 0.05);
    const double of_peak = common::sampling_error(Interpolation::linear, 40);
    EXPECT_GT(of_sea, 1.5 * of_peak);
    EXPECT_LT(of_sea, 4.0 * of_peak);
}

TEST(WaveSampling, DefaultLosesLessThanATenthOfTheLevel) {
    for (const std::string& waves : {regular, sea, solitary})
        for (const char* accuracy : {"draft", "standard", "fine"}) {
            const cmps::Scene scene = scene_of(waves, "", accuracy);
            EXPECT_EQ(judge_sampling(scene, Interpolation::linear, scene.flow.interval).text, "") << waves;
        }
    EXPECT_DOUBLE_EQ(scene_of(regular, "", "standard").flow.interval, 1.65 / 80);
}

TEST(WaveSampling, TooCoarseIsToldOrRefused) {
    const auto remarks = [](const std::string& flow) { return scene_of(regular, flow, "standard").remarks; };
    EXPECT_TRUE(remarks("interval = 0.02").empty());  // 0.05 %
    ASSERT_EQ(remarks("interval = 0.1").size(), 1u);  // 1.3 % of the 2 %
    EXPECT_EQ(remarks("interval = 0.1")[0].name, "flow.interval");
    EXPECT_THROW(remarks("interval = 0.2"), common::InputError);  // 5.4 %
    EXPECT_EQ(judge_sampling(scene_of("kind = \"series\"\nfile = \"none.csv\"", "interval = 1.0", "standard"),
                             Interpolation::linear, 1.0)
                  .text,
              "");  // nothing is known of them
}

}  // namespace
