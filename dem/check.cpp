/// `dem check`: effects with reasons and a forecast.
#include <fmt/format.h>

#include <cmath>

#include "dem/build_simulation.hpp"
#include "dem/run.hpp"

namespace dem {

void check(const common::StageCommand& command, const common::SceneFile& file, const Scene& scene) {
    if (command.all) fmt::print("{}\n", file.reference());
    std::size_t spheres = 0, moving = 0;
    for (std::size_t i = 0; i < scene.placed.size(); ++i) {
        spheres += scene.placed.shape_of(i).spheres.size();
        moving += !scene.placed.is_fixed[i];
    }
    fmt::print("blocks: {} ({} free to move, {} spheres), fixed spheres: {}, planes: {}, links: {}\n", scene.placed.size(), moving, spheres,
               scene.surroundings.fixed_spheres.size(), scene.surroundings.planes.size(), scene.wires.links.size());
    for (const auto& effect : scene.effects.records)
        fmt::print("effect {}: {} ({})\n", effect.name, effect.is_on ? "on" : "off", effect.reason);
    fmt::print("time step: {} s ({}), steps: about {}\n", scene.step.time_step, scene.time_step_is_chosen ? "chosen" : "given",
               std::ceil(scene.time.end / scene.step.time_step));
}

}  // namespace dem
