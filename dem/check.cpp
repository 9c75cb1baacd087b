/// `dem check`: effects with reasons, and a forecast of steps, memory and time from a short calibration.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "common/check_report.hpp"
#include "common/errors.hpp"
#include "common/run_record.hpp"
#include "dem/build_simulation.hpp"
#include "dem/run.hpp"
#include "dem/step_trial.hpp"

namespace dem {

namespace {

/// What one step of the scene has to do, and how long it takes here.
struct StepWork {
    std::size_t contacts = 0, wires = 0;
    double seconds = 0;      ///< 0: nothing could be timed
    std::string stopped_by;  ///< why the calibration ended early; empty: it did not
};

/// The scene's own blocks once they have come down, with its wires: a short stretch of packing or, without
/// one, of the run itself, then a timed stretch. Never longer than the run. `is_fresh`: the run takes up no
/// earlier one, and mounts wires where these blocks stand.
StepWork work_of_a_step(const Scene& scene, bool is_fresh) {
    const bool packs = scene.packing.settle;
    Scene awake = scene;
    awake.effects.sleeping = false;
    const auto simulation = packs ? build_packing(awake) : build_simulation(awake, true);
    const double longest = packs ? scene.packing.longest : scene.time.end;
    simulation->start(0);
    StepWork work;
    std::uint64_t before = 0;
    double spent = 0;
    // In pieces, so that steps of any length leave no one waiting.
    const double piece = std::min(0.01, 50 * scene.step.time_step);
    const auto advance_until = [&](double end, double most_seconds) {
        spent = 0;
        while (spent < most_seconds && simulation->time() < end) {
            common::PhaseTimer timer(spent);
            simulation->advance(std::min(simulation->time() + piece, end));
        }
    };
    try {
        // The paper's blocks are placed a tenth of an element above the mound, and are down after 0.016 s.
        advance_until(std::min(0.05 * scene.time_scale, 0.5 * longest), 2);
        if (packs && is_fresh)  // they settle by less than a tenth of an element from here
            require_holding_wires(simulation->blocks, scene, nullptr, 0.1 * scene.element.diameter);
        mount_layout(*simulation, scene, nullptr);
        before = simulation->steps();
        advance_until(std::min(simulation->time() + 2 * scene.time_scale, longest), 0.2);
    } catch (const common::RunError& error) {
        work.stopped_by = error.what();  // where the run would stop as well, the forecast says so
    }
    work.wires = simulation->wires.size();
    work.contacts = simulation->pair_list().contact_count();
    if (spent > 0) work.seconds = spent / std::max(1.0, static_cast<double>(simulation->steps() - before));
    return work;
}

/// What comes before the first step of the run.
struct PackingWork {
    std::string text;
    double seconds = 0;
};

/// The scene's own packing, as far as it comes in a second of computing.
PackingWork work_of_packing(const Scene& scene, const StepWork& step) {
    constexpr double patience = 1;  // s
    struct OutOfPatience {};
    if (!scene.packing.settle) return {"none", 0};
    const auto simulation = build_packing(scene);
    double spent = 0;
    const auto begun = std::chrono::steady_clock::now();
    try {
        settle(*simulation, scene.packing, "packing", [&](double) {
            spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
            if (spent > patience) throw OutOfPatience{};
        });
    } catch (const OutOfPatience&) {
        const double steps = std::ceil(scene.packing.longest / scene.step.time_step);
        return {fmt::format("at most {:.3g} s, {:.0f} steps", scene.packing.longest, steps),
                step.seconds * steps};
    } catch (const common::RunError& error) {
        return {fmt::format("fails: {}", error.what()), spent};
    }
    return {fmt::format("blocks settle in {:.2f} s, {} steps", simulation->time(), simulation->steps()),
            spent};
}

/// Mass and submerged weight of a block of each shape.
std::string weights_of(const Scene& scene) {
    std::string text;
    for (const Shape& shape : scene.placed.shapes) {
        const double lifted = scene.effects.fluid_force ? scene.water.density * shape.displaced_volume : 0;
        text += fmt::format("{}{}: {:.4g} kg, {:.4g} N {}", text.empty() ? "" : "; ", shape.name, shape.mass,
                            (shape.mass - lifted) * scene.gravity.norm(),
                            scene.effects.fluid_force ? "under water" : "dry");
    }
    return text;
}

std::string run_time_line(const StepWork& work, double seconds) {
    const std::string stopped =
        work.stopped_by.empty() ? "" : "; the calibration stopped: " + work.stopped_by;
    if (work.seconds == 0) return "unknown, no step could be timed" + stopped;
    return fmt::format(
        "at most about {} on this machine, with packing ({:.3g} ms a step with all blocks awake; "
        "sleeping saves more){}",
        common::run_time_text(seconds), 1e3 * work.seconds, stopped);
}

}  // namespace

void check(const common::StageCommand& command, const common::SceneFile& file, const Scene& scene) {
    if (command.all) {
        fmt::print("{}", file.reference());
        return;
    }
    const double begin = require_input(command, file, scene);
    std::size_t spheres = 0, moving = 0;
    for (std::size_t i = 0; i < scene.placed.size(); ++i) {
        spheres += scene.placed.shape_of(i).spheres.size();
        moving += !scene.placed.is_fixed[i];
    }
    const double steps = std::ceil((scene.time.end - begin) / scene.step.time_step);
    const StepLimit limit = require_stable_step(file, scene);
    const StepWork work = work_of_a_step(scene, command.from.empty());
    const PackingWork packing =
        command.from.empty() ? work_of_packing(scene, work) : PackingWork{"stored (--from)", 0};
    common::print_check_report(
        scene.effects.records,
        {{"blocks", fmt::format("{}, {} free to move; {} spheres", scene.placed.size(), moving, spheres)},
         {"a block", weights_of(scene)},
         {"fixed", fmt::format("{} spheres, {} planes", scene.surroundings.fixed_spheres.size(),
                               scene.surroundings.planes.size())},
         {"links", fmt::format("{}", scene.wires.links.size())},
         {"a step", fmt::format("{} contacts, {} wires", work.contacts, work.wires)},
         {"steps", fmt::format("at most {:.0f} of {:.3g} s ({}; {}){}", steps, scene.step.time_step,
                               scene.time_step_is_chosen ? "chosen" : "given",
                               std::isfinite(limit.time_step) ? fmt::format("{} a limit of {:.2g} s at first",
                                                                            limit.set_by, limit.time_step)
                                                              : std::string("nothing touches at first"),
                               command.upstream.empty() ? "; a flow may start later" : "")},
         {"packing", packing.text},
         {"run time", run_time_line(work, work.seconds * steps + packing.seconds)},
         {"error",
          fmt::format("energy balance about {:.1g} of what contacts dissipate (first order in the step)",
                      0.01 * scene.step.time_step / scene.usual_time_step)}});
}

}  // namespace dem
