#include "boussinesq/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>

#include "boussinesq/build_simulation.hpp"
#include "boussinesq/waves/wave_theory.hpp"
#include "common/check_report.hpp"

namespace boussinesq {

namespace {

/// Measured errors (workflows/studies/cost_boussinesq.py), by cells per wave length: relative, at the
/// defaults.
struct Measured {
    double cells_per_length, error;
};
constexpr Measured level_bed[] = {
    {18.5, 2.7e-2}, {37.0, 2.9e-3}, {74.0, 3.5e-4}, {148.0, 4.6e-5}};                 // dispersion
constexpr Measured uneven_bed[] = {{37.4, 8.9e-2}, {74.8, 2.0e-2}, {149.6, 1.9e-3}};  // bar

/// Power law through the two nearest measurements.
template <std::size_t count>
double interpolated(const Measured (&table)[count], double cells_per_length) {
    std::size_t i = 0;
    while (i + 2 < count && cells_per_length > table[i + 1].cells_per_length) ++i;
    const double order = std::log(table[i].error / table[i + 1].error) /
                         std::log(table[i + 1].cells_per_length / table[i].cells_per_length);
    return table[i].error * std::pow(table[i].cells_per_length / cells_per_length, order);
}

bool is_level(const Scene& scene) {
    for (const auto& point : scene.bed)
        if (std::abs(point[1] - scene.bed.front()[1]) > 0.05 * scene.waves.depth) return false;
    return true;
}

}  // namespace

Forecast forecast(const Scene& scene) {
    Simulation simulation = build_simulation(scene);
    const double cells = static_cast<double>(scene.grid.cells);
    // Long enough to time, short enough to wait for: about a tenth of a second.
    const int steps = static_cast<int>(std::clamp(1e6 / cells, 4.0, 200.0));
    double fastest_step = 1e30, nanoseconds = 1e30;
    for (int repeat = 0; repeat < 3; ++repeat) {
        const std::clock_t begun = std::clock();  // processor time: what else runs does not count
        int done = 0;
        for (; done < steps && (done == 0 || simulation.time() < scene.time.end); ++done) {
            fastest_step = std::min(fastest_step, simulation.next_step());
            simulation.advance();
        }
        const double seconds = static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
        nanoseconds = std::min(nanoseconds, 1e9 * seconds / (cells * done));
        if (simulation.time() >= scene.time.end) break;  // no farther than the run goes
    }
    // Waves add their own speed to that of long waves in still water.
    const double depth = scene.waves.depth, height = scene.waves.height;
    const double still = std::sqrt(gravity * depth), crest = std::sqrt(gravity * (depth + 0.6 * height)) +
                                                             0.6 * height * std::sqrt(gravity / depth);
    Forecast result{};
    result.steps =
        scene.time.end / std::min(fastest_step, scene.courant * scene.grid.spacing / std::max(still, crest));
    result.nanoseconds_per_cell_step = nanoseconds;
    const double samples = scene.time.end / scene.output_interval,
                 windows = scene.time.end / scene.time.window;
    // Starting and ending: two hundredths of a second. Writing: 16 ns per value and a few ms per window,
    // measured with checksums and fsync.
    result.seconds =
        0.02 + 1e-9 * nanoseconds * result.steps * cells + samples * cells * 16e-9 + windows * 4e-3;
    result.memory = 22e6 + cells * 200.0 + samples / windows * cells * 32.0;
    if (scene.waves.length > 0) {
        const double cells_per_length = scene.waves.length / scene.grid.spacing;
        const bool level = is_level(scene);
        result.relative_error =
            level ? interpolated(level_bed, cells_per_length) : interpolated(uneven_bed, cells_per_length);
        result.error_from =
            fmt::format("{:.0f} cells a wave length {}", cells_per_length,
                        level ? "over a level bed" : "over an uneven bed, as over the bar of the cost study");
    }
    return result;
}

void print_check(const common::SceneFile& file, const Scene& scene, bool all) {
    if (all) {
        fmt::print("{}", file.reference());
        return;
    }
    const Forecast expected = forecast(scene);
    std::vector<common::ForecastLine> lines{
        {"cells", fmt::format("{} of {:.4g} m", scene.grid.cells, scene.grid.spacing)},
        {"steps", fmt::format("about {:.0f}", expected.steps)},
        {"run time",
         fmt::format("about {} on this machine ({:.0f} ns per cell and step)",
                     common::run_time_text(expected.seconds), expected.nanoseconds_per_cell_step)},
        {"memory", fmt::format("about {:.0f} MB", 1e-6 * expected.memory)}};
    if (expected.relative_error > 0)
        lines.push_back({"error", fmt::format("about {:.1g} of the wave height ({})", expected.relative_error,
                                              expected.error_from)});
    if (!scene.sponge_note.empty()) lines.push_back({"note", scene.sponge_note});
    common::print_check_report(scene.effects, lines);
}

}  // namespace boussinesq
