/// What each optional effect costs where it is on, and saves where it is off: the peer scene at rest in a
/// slow current, rows linked along. Figures are per simulated second.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <string>
#include <vector>

#include "common/parallel.hpp"
#include "dem/build_simulation.hpp"

namespace {

constexpr const char* peer_scene_path = TSUNAGI_SOURCE_DIR "/tests/support/dem_peer_scene.toml";

constexpr const char* links = "wires.along=[{rows=[1,2,3,4,5,6,7,8,9,10],columns=[1,10],wires=4}]";

/// A second of the scene with these settings, its blocks settled and its wires mounted.
void a_second(benchmark::State& state, std::vector<std::string> settings) {
    common::use_threads(1);
    // Steps of the paper's scene: with the short ones of the peer scene settling would take most of the time.
    settings.push_back("dem.time_step=1e-4");
    const auto file = common::SceneFile::read(peer_scene_path, settings);
    dem::Scene scene = dem::read_scene(file, nullptr);
    file.finish();
    const auto simulation = dem::build_simulation(scene, true);
    simulation->start(0);
    simulation->advance(2.0);
    mount_layout(*simulation, scene, nullptr);
    const auto steps = simulation->steps(), block_steps = simulation->awake_block_steps();
    for (auto _ : state) simulation->advance(simulation->time() + 1);
    const auto seconds = static_cast<double>(state.iterations());
    state.counters["steps"] = static_cast<double>(simulation->steps() - steps) / seconds;
    state.counters["block_steps"] =
        static_cast<double>(simulation->awake_block_steps() - block_steps) / seconds;
    state.counters["wires"] = static_cast<double>(simulation->wires.size());
}

#define EFFECT(name, ...) \
    BENCHMARK_CAPTURE(a_second, name, std::vector<std::string>{__VA_ARGS__})->Unit(benchmark::kMillisecond)

EFFECT(all_awake, "effects.sleeping=off");
EFFECT(without_fluid_force, "effects.sleeping=off", "effects.fluid_force=off");
EFFECT(without_tangential_history, "effects.sleeping=off", "effects.tangential_history=off");
EFFECT(with_wires, "effects.sleeping=off", links);
EFFECT(with_wires_off, "effects.sleeping=off", links, "effects.wires=off");
EFFECT(with_wires_that_never_break, "effects.sleeping=off", links, "effects.wire_breaking=off");
EFFECT(sleeping_without_still_windows, "effects.sleeping=on", "effects.still_windows=off");
EFFECT(sleeping_with_still_windows, "effects.sleeping=on");

}  // namespace
