/// `dem check`: effects with reasons, and a forecast of steps, memory and time from a short calibration.
#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "common/check_report.hpp"
#include "dem/build_simulation.hpp"
#include "dem/run.hpp"

namespace dem {

namespace {

double seconds_of(const auto& work) {
    const auto begun = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

/// Time of one step of the scene's own blocks, once they have come down: a tenth of a second of packing, then
/// a timed stretch.
double seconds_per_step(const Scene& scene) {
    const auto simulation = build_simulation(scene, true);
    simulation->start(0);
    // Blocks are placed a tenth of an element above the mound; they are down after sqrt(2 h / g) = 0.02 s.
    simulation->advance(0.05);
    const auto before = simulation->steps();
    const double begun = simulation->time();
    double spent = 0;
    while (spent < 0.2 && simulation->time() < begun + 2)
        spent += seconds_of([&] { simulation->advance(simulation->time() + 0.01); });
    return spent / static_cast<double>(simulation->steps() - before);
}

}  // namespace

void check(const common::StageCommand& command, const common::SceneFile& file, const Scene& scene) {
    if (command.all) {
        fmt::print("{}", file.reference());
        return;
    }
    std::size_t spheres = 0, moving = 0;
    for (std::size_t i = 0; i < scene.placed.size(); ++i) {
        spheres += scene.placed.shape_of(i).spheres.size();
        moving += !scene.placed.is_fixed[i];
    }
    const double steps = std::ceil(scene.time.end / scene.step.time_step);
    const double each = seconds_per_step(scene);
    common::print_check_report(
        scene.effects.records,
        {{"blocks", fmt::format("{}, {} free to move; {} spheres", scene.placed.size(), moving, spheres)},
         {"fixed", fmt::format("{} spheres, {} planes", scene.surroundings.fixed_spheres.size(),
                               scene.surroundings.planes.size())},
         {"links", fmt::format("{}", scene.wires.links.size())},
         {"steps", fmt::format("at most {:.0f} of {:.3g} s ({}); the flow may start later", steps,
                               scene.step.time_step, scene.time_step_is_chosen ? "chosen" : "given")},
         {"run time", fmt::format("at most about {} on this machine ({:.3g} ms a step with all blocks awake; "
                                  "sleeping saves more)",
                                  common::run_time_text(each * steps), 1e3 * each)},
         {"error",
          fmt::format("energy balance about {:.1g} of what contacts dissipate (first order in the step)",
                      0.01 * scene.step.time_step / 1e-4 * std::sqrt(scene.material.young_modulus / 1e7))}});
}

}  // namespace dem
