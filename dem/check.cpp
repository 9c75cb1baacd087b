/// `dem check`: effects with reasons, and a forecast of steps, memory and time from a short calibration.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "common/check_report.hpp"
#include "dem/build_simulation.hpp"
#include "dem/run.hpp"
#include "dem/step_trial.hpp"

namespace dem {

namespace {

double seconds_of(const auto& work) {
    const auto begun = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

/// What one step of the scene has to do, and how long it takes here.
struct StepWork {
    std::size_t contacts = 0, wires = 0;
    double seconds = 0;
};

/// The scene's own blocks once they have come down, with its wires: a tenth of a second of packing, then a
/// timed stretch.
StepWork work_of_a_step(const Scene& scene) {
    const auto simulation = build_simulation(scene, true);
    simulation->start(0);
    // In pieces, so that steps of any length leave no one waiting.
    const double piece = std::min(0.01, 50 * scene.step.time_step);
    const auto advance_until = [&](double end, double most_seconds) {
        double spent = 0;
        while (spent < most_seconds && simulation->time() < end)
            spent += seconds_of([&] { simulation->advance(simulation->time() + piece); });
        return spent;
    };
    // Blocks are placed a tenth of an element above the mound; they are down after sqrt(2 h / g) = 0.02 s.
    advance_until(0.05, 2);
    mount_layout(*simulation, scene, nullptr);
    const auto before = simulation->steps();
    const double spent = advance_until(simulation->time() + 2, 0.2);
    StepWork work;
    work.wires = simulation->wires.size();
    work.contacts = simulation->pair_list().contact_count();
    // A scene whose blocks all fall asleep at once has no steps to time.
    work.seconds = spent / std::max(1.0, static_cast<double>(simulation->steps() - before));
    return work;
}

}  // namespace

void check(const common::StageCommand& command, const common::SceneFile& file, const Scene& scene) {
    if (command.all) {
        fmt::print("{}", file.reference());
        return;
    }
    require_input(command, scene);
    std::size_t spheres = 0, moving = 0;
    for (std::size_t i = 0; i < scene.placed.size(); ++i) {
        spheres += scene.placed.shape_of(i).spheres.size();
        moving += !scene.placed.is_fixed[i];
    }
    const double steps = std::ceil(scene.time.end / scene.step.time_step);
    const double limit = require_stable_step(file, scene);
    const StepWork work = work_of_a_step(scene);
    common::print_check_report(
        scene.effects.records,
        {{"blocks", fmt::format("{}, {} free to move; {} spheres", scene.placed.size(), moving, spheres)},
         {"fixed", fmt::format("{} spheres, {} planes", scene.surroundings.fixed_spheres.size(),
                               scene.surroundings.planes.size())},
         {"links", fmt::format("{}", scene.wires.links.size())},
         {"a step", fmt::format("{} contacts, {} wires", work.contacts, work.wires)},
         {"steps", fmt::format("at most {:.0f} of {:.3g} s ({}; {}); the flow may start later", steps,
                               scene.step.time_step, scene.time_step_is_chosen ? "chosen" : "given",
                               std::isfinite(limit) ? fmt::format("first contacts allow {:.2g} s", limit)
                                                    : std::string("nothing touches at first"))},
         {"run time", fmt::format("at most about {} on this machine ({:.3g} ms a step with all blocks awake; "
                                  "sleeping saves more)",
                                  common::run_time_text(work.seconds * steps), 1e3 * work.seconds)},
         {"error",
          fmt::format("energy balance about {:.1g} of what contacts dissipate (first order in the step)",
                      0.01 * scene.step.time_step / 1e-4 * std::sqrt(scene.material.young_modulus / 1e7))}});
}

}  // namespace dem
