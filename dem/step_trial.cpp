#include "dem/step_trial.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "common/errors.hpp"
#include "dem/build_simulation.hpp"

namespace dem {

namespace {

/// Advances to `end` and returns the most that the limit was after `begin`: a hit lowers it for an instant
/// only. Infinite where nothing touched at some look. Ends early, with the limit of then, when the step
/// stayed past it for some looks or blocks came apart.
StepLimit most_limit(Simulation& simulation, double begin, double end, double look_interval) {
    // In whole steps: what is on trial is this step, not a shorter one.
    const double interval = std::max(look_interval, 10 * simulation.rules().time_step);
    StepLimit most{.time_step = 0};
    int past = 0;
    try {
        while (simulation.time() < end - 0.5 * interval) {
            simulation.advance(simulation.time() + interval);
            const StepLimit limit = simulation.step_limit(true);
            if (simulation.time() > begin && limit.time_step > most.time_step) most = limit;
            past = simulation.rules().time_step > time_step_margin * limit.time_step ? past + 1 : 0;
            if (past >= 4) return limit;
        }
    } catch (const common::RunError&) {
        // Too long a step, or too hard a hit for any: the limit of that moment tells, and of a hit the run
        // does.
        return simulation.step_limit(true);
    }
    return most;
}

StepLimit lesser(const StepLimit& a, const StepLimit& b) {
    return b.time_step < a.time_step ? b : a;
}

}  // namespace

StepLimit stable_step_after_landing(const Scene& scene) {
    // The paper's blocks are placed a tenth of an element above the mound: in water they are down after 0.016
    // s.
    const double landed = 0.03 * scene.time_scale, end = 2 * landed, look_interval = landed / 6;
    constexpr double most_steps = 10000;
    Scene trial = scene;
    trial.step.time_step = std::clamp(scene.step.time_step, scene.usual_time_step / 8, scene.usual_time_step);
    if (end > most_steps * trial.step.time_step) return {};
    const auto simulation = trial.packing.settle ? build_packing(trial) : build_simulation(trial, true);
    simulation->start(0);
    StepLimit limit = most_limit(*simulation, landed, end, look_interval);
    if (scene.effects.wires) {
        mount_layout(*simulation, scene, nullptr);
        limit = lesser(limit, simulation->step_limit(true));
    }
    const double step = scene.step.time_step;
    const bool is_usual = step <= trial.step.time_step && step < 0.5 * limit.time_step;
    if (is_usual || step > time_step_margin * limit.time_step) return limit;
    // Long, or near the limit of contacts just landed: do they bear it in the time that follows?
    const auto further = build_simulation(scene, true);
    take_over(*further, poses_of(simulation->blocks), simulation->memory().pairs);
    further->start(end);
    return lesser(limit,
                  most_limit(*further, end, end + 20 * std::max(look_interval, 10 * step), look_interval));
}

StepLimit require_stable_step(const common::SceneFile& file, const Scene& scene) {
    const StepLimit limit = stable_step_after_landing(scene);
    if (scene.step.time_step > time_step_margin * limit.time_step)
        file.section("dem").problem(
            "time_step",
            fmt::format("{:.2g} s{} is past the limit of {:.2g} s that {} once the blocks are down",
                        scene.step.time_step, scene.time_step_is_chosen ? ", the program's choice," : "",
                        limit.time_step, limit.set_by));
    file.finish();
    return limit;
}

}  // namespace dem
