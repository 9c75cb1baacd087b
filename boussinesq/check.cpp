#include "boussinesq/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "boussinesq/build_simulation.hpp"
#include "boussinesq/waves/wave_theory.hpp"
#include "common/check_report.hpp"
#include "common/errors.hpp"

namespace boussinesq {

namespace {

/// Measured errors at the defaults, by cells per length (workflows/studies/cost_boussinesq.py).
struct Measured {
    double cells_per_length, error;
};
/// Rms difference over the height after 5.4 wave lengths, low waves (the study's complex gain over 2
/// sqrt(2)).
constexpr Measured periodic[] = {{18.5, 9.7e-3}, {37.0, 1.0e-3}, {74.0, 1.2e-4}, {148.0, 1.6e-5}};
/// Largest difference over the height after 100 depths; the length is that of the crest, 2 / K.
constexpr Measured solitary[] = {{14.25, 7.2e-3}, {28.5, 6.5e-4}, {57.0, 9.5e-5}, {114.0, 2.9e-5}};
/// Against the measured beach (README): what is left however small the cells.
constexpr double surf_zone_error = 0.08;

/// Power law through the two nearest measurements.
template <std::size_t count>
double interpolated(const Measured (&table)[count], double cells_per_length) {
    std::size_t i = 0;
    while (i + 2 < count && cells_per_length > table[i + 1].cells_per_length) ++i;
    const double order = std::log(table[i].error / table[i + 1].error) /
                         std::log(table[i + 1].cells_per_length / table[i].cells_per_length);
    return table[i].error * std::pow(table[i].cells_per_length / cells_per_length, order);
}

/// Error half way along the flume, over the wave height.
void forecast_error(const Scene& scene, Forecast& result) {
    const WaveSection& waves = scene.waves;
    if (waves.length <= 0) return;
    const double half_way = 0.5 * (scene.grid.shoreward_end() - scene.grid.offshore_end);
    const Shallowest place = shallowest_place(scene.expectation);
    if (waves.kind == WaveKind::solitary) {
        const double width = 2.0 * std::sqrt(4.0 * std::pow(place.depth, 2) * (place.depth + place.height) /
                                             (3.0 * place.height));
        result.relative_error =
            interpolated(solitary, width / scene.grid.spacing) * half_way / (100.0 * waves.depth);
        result.error_from = fmt::format("{:.0f} cells a crest", width / scene.grid.spacing);
    } else {
        // Harmonics grow with the Ursell number and need their own cells: fitted to eight scenes within a
        // factor of 3, from level beds (1) to bars (100).
        const double ursell = place.height * std::pow(place.length, 2) / std::pow(place.depth, 3);
        const double cells = waves.length / scene.grid.spacing;
        result.relative_error = interpolated(periodic, cells) * half_way / (5.4 * waves.length) *
                                (1.0 + std::pow(ursell / 10.0, 2.3));
        result.error_from =
            fmt::format("{:.0f} cells a wave length, Ursell number up to {:.2g}", cells, ursell);
    }
    if (place.breaks) {
        result.relative_error = surf_zone_error;
        result.error_from = "of heights where waves break, as against a measured beach; less ahead of it";
    }
    result.relative_error = std::min(result.relative_error, 1.0);  // out of phase
}

}  // namespace

Forecast forecast(const Scene& scene) {
    Simulation simulation = build_simulation(scene);
    const double cells = static_cast<double>(scene.grid.cells);
    // Long enough to time, short enough to wait for: about a tenth of a second.
    const int steps = static_cast<int>(std::clamp(1e6 / cells, 4.0, 200.0));
    double fastest_step = 1e30, nanoseconds = 1e30;
    Forecast result{};
    for (int repeat = 0; repeat < 3 && result.warning.empty(); ++repeat) {
        const std::clock_t begun = std::clock();  // processor time: what else runs does not count
        int done = 0;
        try {
            for (; done < steps && (done == 0 || simulation.time() < scene.time.end); ++done) {
                fastest_step = std::min(fastest_step, simulation.next_step());
                simulation.advance();
            }
        } catch (const common::RunError& error) {
            result.warning = error.what();
        }
        const double seconds = static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
        if (done > 0) nanoseconds = std::min(nanoseconds, 1e9 * seconds / (cells * done));
        if (simulation.time() >= scene.time.end) break;  // no farther than the run goes
    }
    // Waves add their own speed to that of long waves in still water.
    const double depth = scene.waves.depth, height = scene.waves.height;
    const double still = std::sqrt(gravity * depth), crest = std::sqrt(gravity * (depth + 0.6 * height)) +
                                                             0.6 * height * std::sqrt(gravity / depth);
    result.steps =
        scene.time.end / std::min(fastest_step, scene.courant * scene.grid.spacing / std::max(still, crest));
    result.nanoseconds_per_cell_step = nanoseconds;
    const double samples = scene.time.end / scene.output_interval,
                 windows = scene.time.end / scene.time.window;
    // Starting and ending: two hundredths of a second. Writing: 16 ns per value and a few ms per window,
    // measured with checksums and fsync.
    result.seconds =
        0.02 + 1e-9 * nanoseconds * result.steps * cells + samples * cells * 16e-9 + windows * 4e-3;
    // Measured from 1e3 to 1e6 cells; windows, the state to go on from and their copies in the file included.
    result.memory =
        22e6 + cells * (276.0 + (scene.has_breaking ? 43.0 : 0.0) + 27.0 * std::ceil(samples / windows));
    forecast_error(scene, result);
    return result;
}

void print_check(const common::SceneFile& file, const Scene& scene, bool all) {
    if (all) {
        fmt::print("{}", file.reference());
        return;
    }
    const Forecast expected = forecast(scene);
    std::vector<common::ForecastLine> lines;
    if (scene.waves.kind == WaveKind::regular || scene.waves.kind == WaveKind::irregular)
        lines.push_back(
            {"waves",
             scene.waves.kind == WaveKind::regular
                 ? fmt::format("H = {:.4g} m, T = {:.4g} s in {:.4g} m of water, {:.4g} m long",
                               scene.waves.height, scene.waves.period, scene.waves.depth, scene.waves.length)
                 : fmt::format("H_s = H_m0 = {:.4g} m, T_p = {:.4g} s in {:.4g} m of water, "
                               "{:.4g} m long",
                               scene.waves.height, scene.waves.period, scene.waves.depth,
                               scene.waves.length)});
    if (scene.waves.kind == WaveKind::solitary)
        lines.push_back({"waves", fmt::format("solitary, H = {:.4g} m in {:.4g} m of water",
                                              scene.waves.height, scene.waves.depth)});
    const std::vector<common::ForecastLine> costs{
        {"cells", fmt::format("{} of {:.4g} m", scene.grid.cells, scene.grid.spacing)},
        {"steps", fmt::format("about {:.0f}", expected.steps)},
        {"run time",
         fmt::format("about {} on this machine ({:.0f} ns per cell and step)",
                     common::run_time_text(expected.seconds), expected.nanoseconds_per_cell_step)},
        {"memory", fmt::format("about {:.0f} MB", 1e-6 * expected.memory)}};
    lines.insert(lines.end(), costs.begin(), costs.end());
    if (expected.relative_error > 0)
        lines.push_back({"error", fmt::format("about {:.1g} of the wave height, of the cells ({})",
                                              expected.relative_error, expected.error_from)});
    if (!expected.warning.empty()) lines.push_back({"warning", "the run will stop: " + expected.warning});
    if (!scene.waves.record_note.empty()) lines.push_back({"record", scene.waves.record_note});
    for (const std::string* note : {&scene.sponge_note, &scene.sampling_note})
        if (!note->empty()) lines.push_back({"note", *note});
    common::print_check_report(scene.effects, lines);
}

}  // namespace boussinesq
