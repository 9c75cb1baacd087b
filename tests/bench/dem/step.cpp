/// Cost of a time step: the scene on which other programs were timed, in one and three layers, and by number
/// of blocks.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "common/parallel.hpp"
#include "dem/build_simulation.hpp"

namespace {

dem::Scene scene_with(const std::vector<std::string>& overrides) {
    const auto here = std::filesystem::path(__FILE__).parent_path();
    const auto file = common::SceneFile::read(here / "../../support/dem_peer_scene.toml", overrides);
    dem::Scene scene = dem::read_scene(file, nullptr);
    file.finish();
    return scene;
}

/// Times steps after `settling` seconds.
void time_steps(benchmark::State& state, const dem::Scene& scene, double settling) {
    common::use_threads(1);
    const auto simulation = dem::build_simulation(scene, true);
    simulation->start(0);
    simulation->advance(settling);
    constexpr int batch = 500;
    const double dt = scene.step.time_step;
    for (auto _ : state) simulation->advance(simulation->time() + batch * dt);
    const double steps = static_cast<double>(state.iterations()) * batch;
    const double blocks = static_cast<double>(simulation->blocks.size());
    std::size_t contacts = 0, candidates = 0;
    for (const auto& pair : simulation->pair_list().pairs()) {
        contacts += pair.contacts.size();
        candidates += pair.candidates.size();
    }
    state.counters["ms_per_step"] =
        benchmark::Counter(1e-3 * steps, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["ns_per_block_step"] =
        benchmark::Counter(1e-9 * steps * blocks, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["ns_per_sphere_step"] = benchmark::Counter(
        1e-9 * steps * blocks * 96, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["contacts"] = static_cast<double>(contacts);
    state.counters["candidates"] = static_cast<double>(candidates);
}

void peer_scene(benchmark::State& state) {
    time_steps(state, scene_with({}), 0.3);
}
BENCHMARK(peer_scene)->Unit(benchmark::kMillisecond);

void three_layers(benchmark::State& state) {
    time_steps(state, scene_with({"dem.blocks.layers=3"}), 0.5);
}
BENCHMARK(three_layers)->Unit(benchmark::kMillisecond);

/// The same armour, wider: rows of ten.
void by_number_of_blocks(benchmark::State& state) {
    const auto columns = state.range(0) / 10;
    const double width = 0.060 * static_cast<double>(columns) + 0.08;
    time_steps(state,
               scene_with({fmt::format("dem.blocks.columns={}", columns),
                           fmt::format("dem.mound.y=[0.0,{}]", width)}),
               0.1);
}
BENCHMARK(by_number_of_blocks)->Arg(10)->Arg(100)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

}  // namespace
