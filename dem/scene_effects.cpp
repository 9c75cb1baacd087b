/// Which effects a scene calls for, and why.
#include <fmt/format.h>

#include "dem/scene.hpp"

namespace dem {

using common::EffectWish;
using common::SceneFile;

namespace {

void choose(const SceneFile& file, const char* name, bool automatic, const std::string& reason, bool possible,
            const std::string& needs, bool& is_on, Effects& effects) {
    const EffectWish wish = common::read_effect_wish(file, name);
    if (wish == EffectWish::on && !possible) file.section("effects").problem(name, "cannot be on: " + needs);
    is_on = wish == EffectWish::automatic ? automatic : wish == EffectWish::on;
    effects.records.push_back({name, is_on, wish == EffectWish::automatic ? reason : "the scene says so"});
}

}  // namespace

void choose_effects(const SceneFile& file, bool dry, Scene& scene) {
    Effects& effects = scene.effects;
    const bool has_links = !scene.wires.links.empty(), has_friction = scene.material.friction > 0;
    choose(file, "fluid_force", !dry, dry ? "dem.dry: no water" : "there is water where blocks are", !dry,
           "dem.dry is true", effects.fluid_force, effects);
    choose(file, "wires", has_links,
           has_links ? fmt::format("{} links in the layout", scene.wires.links.size())
                     : "no links in the layout",
           has_links, "no links in the layout", effects.wires, effects);
    choose(file, "wire_breaking", effects.wires,
           effects.wires ? fmt::format("psi = {} is finite", scene.wires.psi) : "no wires", effects.wires,
           "no wires", effects.wire_breaking, effects);
    choose(file, "tangential_history", has_friction,
           has_friction ? fmt::format("friction {} > 0", scene.material.friction) : "friction is 0",
           has_friction, "friction is 0", effects.tangential_history, effects);
    // A block sleeps by what friction under its weight can still hold (effects/reserve.cpp).
    const bool has_weight = scene.gravity.norm() > 0, may_rest = effects.tangential_history && has_weight;
    choose(file, "sleeping", may_rest,
           may_rest     ? "weight and friction can hold blocks at rest"
           : has_weight ? "without friction nothing holds a block that is pushed: none would sleep"
                        : "no gravity: nothing holds a block that is pushed, none would sleep",
           true, "", effects.sleeping, effects);
    choose(file, "still_windows", effects.sleeping, effects.sleeping ? "with sleeping" : "sleeping is off",
           effects.sleeping, "sleeping is off", effects.still_windows, effects);
    if (!effects.tangential_history) scene.material.friction = 0;
    scene.step.cross_still = effects.still_windows;
}

}  // namespace dem
