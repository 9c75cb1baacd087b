#include "dem/step_trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "common/errors.hpp"
#include "dem/build_simulation.hpp"

namespace dem {

namespace {

constexpr double look_interval = 0.005;  // s

/// Advances to `end` and returns the most that the limit was after `begin`: a hit lowers it for an instant
/// only. Infinite where nothing touched at some look. Ends early, with the limit of then, when the step
/// stayed past it for some looks or blocks came apart.
double most_limit(Simulation& simulation, double begin, double end) {
    // In whole steps: what is on trial is this step, not a shorter one.
    const double interval = std::max(look_interval, 10 * simulation.rules().time_step);
    double most = 0;
    int past = 0;
    try {
        while (simulation.time() < end - 0.5 * interval) {
            simulation.advance(simulation.time() + interval);
            const double limit = simulation.stable_time_step(true);
            if (simulation.time() > begin) most = std::max(most, limit);
            past = simulation.rules().time_step > time_step_margin * limit ? past + 1 : 0;
            if (past >= 4) return limit;
        }
    } catch (const common::RunError&) {
        // Too long a step, or too hard a hit for any: the limit of that moment tells, and of a hit the run
        // does.
        return simulation.stable_time_step(true);
    }
    return most;
}

}  // namespace

double stable_step_after_landing(const Scene& scene) {
    // Blocks are placed a tenth of an element above the mound: in water they are down after 0.016 s.
    constexpr double landed = 0.03, end = 0.06, most_steps = 10000;
    Scene trial = scene;
    trial.step.time_step = std::clamp(scene.step.time_step, scene.usual_time_step / 8, scene.usual_time_step);
    if (end > most_steps * trial.step.time_step) return std::numeric_limits<double>::infinity();
    const auto simulation = trial.packing.settle ? build_packing(trial) : build_simulation(trial, true);
    simulation->start(0);
    double limit = most_limit(*simulation, landed, end);
    if (scene.effects.wires) {
        mount_layout(*simulation, scene, nullptr);
        limit = std::min(limit, simulation->stable_time_step(true));
    }
    const double step = scene.step.time_step;
    const bool is_usual = step <= trial.step.time_step && step < 0.5 * limit;
    if (is_usual || step > time_step_margin * limit) return limit;
    // Long, or near the limit of contacts just landed: do they bear it in the time that follows?
    const auto further = build_simulation(scene, true);
    take_over(*further, poses_of(simulation->blocks), simulation->memory().pairs);
    further->start(end);
    return std::min(limit, most_limit(*further, end, end + 20 * std::max(look_interval, 10 * step)));
}

double require_stable_step(const common::SceneFile& file, const Scene& scene) {
    const double limit = stable_step_after_landing(scene);
    if (scene.step.time_step > time_step_margin * limit)
        file.section("dem").problem(
            "time_step",
            fmt::format("{:.2g} s{} is past the limit of {:.2g} s that {} set once the blocks are down",
                        scene.step.time_step, scene.time_step_is_chosen ? ", the program's choice," : "",
                        limit, scene.effects.wires ? "contacts and wires" : "the contacts"));
    file.finish();
    return limit;
}

}  // namespace dem
