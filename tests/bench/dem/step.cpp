/// Cost of a time step: the scene on which other programs were timed, in one and three layers, and by number
/// of blocks.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "common/parallel.hpp"
#include "dem/build_simulation.hpp"

namespace {

constexpr const char* peer_scene_path = TSUNAGI_SOURCE_DIR "/tests/support/dem_peer_scene.toml";

dem::Scene scene_with(const std::vector<std::string>& overrides) {
    const auto file = common::SceneFile::read(peer_scene_path, overrides);
    dem::Scene scene = dem::read_scene(file, nullptr);
    file.finish();
    return scene;
}

/// Lets the blocks of a scene come down, at a longer step, and stands them at rest where they are then.
std::unique_ptr<dem::Simulation> settled(const dem::Scene& scene, double settling) {
    dem::Scene coarse = scene;
    coarse.step.time_step = 1.0e-4;  // s; a third of what is stable here
    const auto falling = dem::build_simulation(coarse, true);
    falling->start(0);
    falling->advance(settling);
    auto simulation = dem::build_simulation(scene, true);
    dem::take_over(*simulation, dem::poses_of(falling->blocks), falling->memory().pairs);
    simulation->start(0);
    simulation->advance(0.01);
    return simulation;
}

/// Steps each of some scenes of the same size in turn; a block's share of contacts and lists is told beside
/// the time, since it is the work that a step has to do.
void time_steps(benchmark::State& state, const std::vector<std::unique_ptr<dem::Simulation>>& simulations) {
    constexpr int batch = 500;
    const double dt = simulations[0]->rules().time_step;
    for (auto _ : state)
        for (const auto& simulation : simulations) simulation->advance(simulation->time() + batch * dt);
    const double steps = static_cast<double>(state.iterations()) * batch;
    double blocks = 0, contacts = 0, candidates = 0, touching = 0;
    for (const auto& simulation : simulations) {
        blocks += static_cast<double>(simulation->blocks.size());
        for (const auto& pair : simulation->pair_list().pairs()) {
            contacts += static_cast<double>(pair.contacts);
            candidates += static_cast<double>(pair.candidates);
            touching += pair.contacts > 0;
        }
    }
    using benchmark::Counter;
    const auto each = [&](double amount) {
        return Counter(amount * steps, Counter::kIsRate | Counter::kInvert);
    };
    state.counters["ms_per_step"] = each(1e-3 * static_cast<double>(simulations.size()));
    state.counters["ns_per_block_step"] = each(1e-9 * blocks);
    state.counters["ns_per_sphere_step"] = each(1e-9 * blocks * 96);
    state.counters["contacts_per_block"] = contacts / blocks;
    state.counters["candidates_per_block"] = candidates / blocks;
    state.counters["touching_pairs_per_block"] = touching / blocks;
}

std::vector<std::unique_ptr<dem::Simulation>> one(std::unique_ptr<dem::Simulation> simulation) {
    std::vector<std::unique_ptr<dem::Simulation>> simulations;
    simulations.push_back(std::move(simulation));
    return simulations;
}

void peer_scene(benchmark::State& state) {
    common::use_threads(1);
    time_steps(state, one(settled(scene_with({}), 0.3)));
}
BENCHMARK(peer_scene)->Unit(benchmark::kMillisecond);

/// As others ran it: without water, under the weight that buoyancy leaves.
void peer_scene_dry(benchmark::State& state) {
    common::use_threads(1);
    time_steps(state,
               one(settled(scene_with({"effects.fluid_force=off", "dem.gravity=[0, 0, -7.15]"}), 0.3)));
}
BENCHMARK(peer_scene_dry)->Unit(benchmark::kMillisecond);

void three_layers(benchmark::State& state) {
    common::use_threads(1);
    time_steps(state, one(settled(scene_with({"dem.blocks.layers=3"}), 0.5)));
}
BENCHMARK(three_layers)->Unit(benchmark::kMillisecond);

/// Armour of so many rows and columns at rest on the same kind of bed.
dem::Scene armour(std::int64_t rows, std::int64_t columns, int seed) {
    const double width = 0.060 * static_cast<double>(columns) + 0.08;
    const double length = 0.060 * static_cast<double>(rows) + 0.08;
    return scene_with({fmt::format("dem.blocks.rows={}", rows), fmt::format("dem.blocks.columns={}", columns),
                       fmt::format("dem.blocks.origin=[{}, 0.070]", length - 0.07),
                       fmt::format("dem.mound.profile=[[0.0, -0.5], [{}, -0.5]]", length),
                       fmt::format("dem.mound.y=[0.0, {}]", width), fmt::format("dem.mound.seed={}", seed)});
}

/// At every size the same state: blocks at rest. Ten blocks are few to have the mean number of contacts, so
/// ten such scenes stand for them.
void by_number_of_blocks(benchmark::State& state) {
    common::use_threads(1);
    const std::int64_t rows = state.range(0), columns = state.range(1);
    std::vector<std::unique_ptr<dem::Simulation>> simulations;
    for (int seed = 1; seed <= (rows * columns < 100 ? 10 : 1); ++seed)
        simulations.push_back(settled(armour(rows, columns, seed), 0.5));
    time_steps(state, simulations);
}
BENCHMARK(by_number_of_blocks)
    ->Args({2, 5})
    ->Args({10, 10})
    ->Args({25, 40})
    ->Args({100, 100})
    ->Unit(benchmark::kMillisecond);

}  // namespace
