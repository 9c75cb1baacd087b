#include "boussinesq/output_sampling.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "boussinesq/waves/permanent_wave.hpp"
#include "common/sampling_error.hpp"

namespace boussinesq {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// Errors of the levels: those of waves over a bar by cells alone (workflows/studies/cost_boussinesq.py).
double level_error(common::Accuracy accuracy) {
    return accuracy == common::Accuracy::draft ? 0.08 : accuracy == common::Accuracy::standard ? 0.02 : 0.002;
}

struct Line {
    double angular_frequency, amplitude;  ///< rad/s, any unit
};

/// Spectrum of the incident waves at one place.
std::vector<Line> spectrum_of(const Scene& scene) {
    const WaveSection& waves = scene.waves;
    const LinearDispersion dispersion{.alpha = scene.flow.alpha, .is_dispersive = scene.terms.dispersion};
    std::vector<Line> lines;
    std::vector<WaveComponent> components;
    switch (waves.kind) {
        case WaveKind::none:
            break;
        case WaveKind::regular: {
            std::vector<double> harmonics{waves.height};
            if (scene.terms.dispersion)
                harmonics =
                    permanent_form(scene.flow.alpha, waves.height, waves.period, waves.depth).amplitude;
            for (const double amplitude : harmonics)
                lines.push_back({two_pi / waves.period * static_cast<double>(lines.size() + 1), amplitude});
            break;
        }
        case WaveKind::irregular:
            components = sea_components(waves.sea, dispersion, waves.depth);
            break;
        case WaveKind::series:
            components =
                record_components(waves.record, 1.25 * (waves.record.time.back() - waves.record.time.front()),
                                  dispersion, waves.depth);
            break;
        case WaveKind::solitary: {
            // of sech^2(r t), in steps of r: w / sinh(pi w / (2 r))
            const double rate = waves.crest_rate;
            constexpr int count = 60;
            for (int i = 1; i <= count; ++i) {
                const double w = 0.125 * i;
                lines.push_back({w * rate, w / std::sinh(0.5 * std::numbers::pi * w)});
            }
            break;
        }
    }
    for (const WaveComponent& component : components)
        lines.push_back({component.angular_frequency, component.elevation_amplitude});
    return lines;
}

double error_of(const std::vector<Line>& lines, double interval) {
    double lost = 0, all = 0;
    for (const Line& line : lines) {
        if (!(line.angular_frequency > 0)) continue;
        const double error = common::sampling_error(common::Interpolation::cubic_slopes,
                                                    two_pi / (line.angular_frequency * interval));
        lost += std::pow(line.amplitude * error, 2), all += std::pow(line.amplitude, 2);
    }
    return all > 0 ? std::sqrt(lost / all) : 0.0;
}

}  // namespace

double output_sampling_error(const Scene& scene, double interval) {
    return error_of(spectrum_of(scene), interval);
}

void check_output_sampling(const common::SceneFile& file, common::Accuracy accuracy, Scene& scene) {
    const std::vector<Line> lines = spectrum_of(scene);
    const double error = error_of(lines, scene.output_interval), largest = level_error(accuracy);
    if (error <= 0.1 * largest) return;
    // The largest interval within the bound: halved until it is, then half way between; of two digits,
    // rounded down.
    const auto interval_for = [&](double bound) {
        double low = scene.output_interval, high = low;
        while (error_of(lines, low) > bound) high = std::exchange(low, 0.5 * low);
        for (int i = 0; i < 12; ++i) {
            const double middle = 0.5 * (low + high);
            (error_of(lines, middle) > bound ? high : low) = middle;
        }
        const double digit = std::pow(10.0, std::floor(std::log10(low)) - 1.0);
        return std::floor(low / digit) * digit;
    };
    const double period =
        scene.waves.kind == WaveKind::solitary ? two_pi / scene.waves.crest_rate : scene.waves.period;
    const std::string told = fmt::format(
        "of {:.4g} s gives {:.2g} samples a {}, and waves interpolated between them are wrong by {:.2g} % "
        "(rms)",
        scene.output_interval, period / scene.output_interval,
        scene.waves.kind == WaveKind::solitary ? "crest" : "wave", 100.0 * error);
    if (error > largest && file.has_section("cmps"))
        file.section("boussinesq")
            .problem("output_interval",
                     fmt::format("{}, more than the {:.2g} % of this accuracy; expected at most {:.3g} s",
                                 told, 100.0 * largest, interval_for(largest)));
    else
        scene.sampling_note = fmt::format(
            "boussinesq.output_interval {}: a near field that follows the windows should have at most {:.3g} "
            "s",
            told, interval_for(0.1 * largest));
}

}  // namespace boussinesq
