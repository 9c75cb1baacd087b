// Cost of one step per cell: all three stages, look for the step size included. Counters: ns per cell-step,
// bytes per cell.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>

#include "boussinesq/effects/breaking.hpp"
#include "boussinesq/effects/friction.hpp"
#include "boussinesq/simulation.hpp"
#include "common/run_record.hpp"

namespace {

using namespace boussinesq;

enum Choice { dispersion = 1, shoreline = 2, breaking = 4, friction = 8, beach = 16 };

/// Waves of 5 % of the depth over a level bed, or towards a beach over the last fifth.
void step(benchmark::State& state, int choice) {
    const auto cells = static_cast<std::size_t>(state.range(0));
    const Grid grid{.offshore_end = 0.0, .spacing = 0.05, .cells = cells};
    const double length = grid.shoreward_end(), depth = 0.8;
    const FlowParameters flow{.spacing = grid.spacing,
                              .dry_depth = 1e-4 * depth,
                              .discharge_scale = 1e-2 * depth * std::sqrt(gravity * depth),
                              .elevation_scale = 1e-2 * depth};
    Bed bed(grid,
            choice & beach
                ? std::vector<std::array<double, 2>>{{0.0, -depth}, {0.8 * length, -depth}, {length, 0.3}}
                : std::vector<std::array<double, 2>>{{0.0, -depth}, {length, -depth}});
    WaveState initial(grid);
    for (std::size_t i = 0; i < cells; ++i) {
        const std::size_t k = i + ghost_cells;
        const double elevation = 0.02 * std::cos(1.7 * grid.centre(i));
        initial.depth[k] = std::max(elevation - bed.level(k), 0.0);
        initial.discharge[k] = initial.depth[k] > 0.1 ? 2.2 * elevation : 0.0;
    }
    std::vector<std::unique_ptr<StepEffect>> effects;
    if (choice & breaking)
        effects.push_back(
            std::make_unique<EddyViscosity>(grid, bed, flow, ghost_cells + 1, EddyViscosityConstants{}));
    if (choice & friction) effects.push_back(std::make_unique<Friction>(grid, 0.005, false, flow.dry_depth));
    Simulation simulation(grid, std::move(bed), flow,
                          {.dispersion = (choice & dispersion) != 0, .shoreline = (choice & shoreline) != 0},
                          0.5, std::move(initial), std::move(effects));
    for (auto _ : state) {
        simulation.next_step();
        simulation.advance();
    }
    state.counters["ns_per_cell_step"] =
        benchmark::Counter(static_cast<double>(state.iterations() * cells) * 1e-9,
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["peak_bytes_per_cell"] = common::peak_memory() / static_cast<double>(cells);
}

// Flat over the length of the flume.
BENCHMARK_CAPTURE(step, dispersion, dispersion)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(100000)
    ->Arg(1000000)
    ->Unit(benchmark::kMillisecond);
// What each effect costs, and that one that is off costs nothing (the first line is all off).
BENCHMARK_CAPTURE(step, all_off, 0)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(step, dispersion_shoreline, dispersion | shoreline)
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(step, dispersion_breaking, dispersion | breaking)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(step, dispersion_friction, dispersion | friction)->Arg(1000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(step, beach_with_all, dispersion | shoreline | breaking | friction | beach)
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond);

}  // namespace
