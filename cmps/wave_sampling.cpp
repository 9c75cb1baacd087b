#include "cmps/wave_sampling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cmps {
namespace {

using common::Interpolation;

constexpr double pi = std::numbers::pi, gravity = 9.81;

/// Errors of the levels: in waves offshore, by which the stage before judges its windows too; for the flow,
/// which is linear between samples, that of a standing wave in the near field (expected_error.cpp) where it
/// is larger.
double level_error(common::Accuracy accuracy, Interpolation interpolation) {
    if (accuracy == common::Accuracy::draft) return 0.08;
    if (accuracy == common::Accuracy::standard) return 0.02;
    return interpolation == Interpolation::linear ? 0.005 : 0.002;
}

/// JONSWAP over frequencies from half the peak to what Boussinesq waves can carry, kh = 5 offshore; above ten
/// peaks there is a ten-thousandth of the energy.
std::vector<WaveLine> sea_lines(const Scene& scene) {
    const double peak = 2 * pi / scene.wave_period, depth = -scene.bed.front()[1];
    const double highest = std::clamp(std::sqrt(5.0 * gravity / depth) / peak, 1.0, 10.0);
    constexpr double step = 0.05;  // of the peak
    std::vector<WaveLine> lines;
    for (double f = 0.5; f <= highest; f += step) {
        const double width = f <= 1.0 ? 0.07 : 0.09;
        const double enhancement =
            std::pow(scene.sea_enhancement, std::exp(-0.5 * std::pow((f - 1) / width, 2)));
        lines.push_back(
            {f * peak, std::sqrt(std::pow(f, -5) * std::exp(-1.25 * std::pow(f, -4)) * enhancement)});
    }
    return lines;
}

/// Of sech^2(r t), in steps of r: w / sinh(pi w / (2 r)).
std::vector<WaveLine> crest_lines(double rate) {
    std::vector<WaveLine> lines;
    for (int i = 1; i <= 60; ++i) {
        const double w = 0.125 * i;
        lines.push_back({w * rate, w / std::sinh(0.5 * pi * w)});
    }
    return lines;
}

/// Of the (peak) waves, s; of a solitary wave, which passes as sech^2(r t), 2 pi / r.
double period_of(const Scene& scene) {
    if (scene.drive == Drive::piston) return scene.piston.period;
    if (scene.wave_period > 0) return scene.wave_period;
    const double depth = scene.settings.depth, height = scene.wave_height;
    return 2 * pi / (std::sqrt(0.75 * height / depth) / depth * std::sqrt(gravity * (depth + height)));
}

double rounded_down(double value) {
    const double digit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
    return std::floor(value / digit * (1 + 1e-9)) * digit;
}

}  // namespace

std::vector<WaveLine> wave_lines(const Scene& scene) {
    if (scene.drive == Drive::piston && scene.piston.period > 0) return {{2 * pi / scene.piston.period, 1.0}};
    if (scene.drive != Drive::waves || scene.wave_height == 0) return {};
    if (scene.wave_period == 0) return crest_lines(2 * pi / period_of(scene));
    if (scene.sea_enhancement > 0 && !scene.bed.empty() && scene.bed.front()[1] < 0) return sea_lines(scene);
    return {{2 * pi / scene.wave_period, 1.0}};
}

double wave_sampling_error(const std::vector<WaveLine>& lines, Interpolation interpolation, double interval) {
    double lost = 0, all = 0;
    for (const WaveLine& line : lines) {
        const double square = line.amplitude * line.amplitude;
        const double error =
            common::sampling_error(interpolation, 2 * pi / (line.angular_frequency * interval));
        lost += square * error * error, all += square;
    }
    return all > 0 ? std::sqrt(lost / all) : 0.0;
}

double interval_of_error(const std::vector<WaveLine>& lines, Interpolation interpolation, double bound) {
    double low = pi / lines.front().angular_frequency;
    while (wave_sampling_error(lines, interpolation, low) > bound) low *= 0.5;
    double high = 2 * low;
    for (int i = 0; i < 20; ++i) {
        const double middle = 0.5 * (low + high);
        (wave_sampling_error(lines, interpolation, middle) > bound ? high : low) = middle;
    }
    return rounded_down(low);
}

SamplingVerdict judge_sampling(const Scene& scene, Interpolation interpolation, double interval) {
    const std::vector<WaveLine> lines = wave_lines(scene);
    const double error = wave_sampling_error(lines, interpolation, interval);
    const double largest = level_error(scene.accuracy, interpolation);
    if (error <= 0.1 * largest) return {};
    const bool is_refused = error > largest;
    const double period = period_of(scene);
    const bool is_crest = scene.drive == Drive::waves && scene.wave_period == 0;
    return {is_refused,
            fmt::format(
                "{:.4g} s: {:.3g} samples a {}; between them {} wrong by {:.2g} % (rms), {} {:.2g} % of "
                "this accuracy; {} at most {:.3g} s",
                interval, period / interval, is_crest ? "crest" : "wave",
                interpolation == Interpolation::linear ? "the flow is" : "the waves are", 100 * error,
                is_refused ? "more than the" : "for the", 100 * largest, is_refused ? "expected" : "better",
                interval_of_error(lines, interpolation, (is_refused ? 1.0 : 0.1) * largest))};
}

double default_flow_interval(const Scene& scene) {
    constexpr double unknown = 0.02, samples = 80;
    const std::vector<WaveLine> lines = wave_lines(scene);
    if (lines.empty()) return unknown;
    const double enough = interval_of_error(lines, Interpolation::linear,
                                            0.1 * level_error(scene.accuracy, Interpolation::linear));
    return std::min({enough, period_of(scene) / samples, scene.time.window});
}

}  // namespace cmps
