#include "cmps/effect_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cmps/scene_geometry.hpp"

namespace cmps {

void decide_effects(const common::SceneFile& file, Scene& scene) {
    using common::EffectWish;
    const bool is_wave_driven = scene.drive == Drive::waves;
    const auto decide = [&](const char* name, bool is_needed, const std::string& reason,
                            bool can_act = true) {
        const EffectWish wish = common::read_effect_wish(file, name);
        if (wish == EffectWish::automatic || !can_act)
            scene.effects.push_back({name, is_needed, reason});
        else
            scene.effects.push_back(
                {name, wish == EffectWish::on,
                 fmt::format("[effects] {} = \"{}\"", name, wish == EffectWish::on ? "on" : "off")});
    };
    decide("start_at_arrival", is_wave_driven && !scene.start,
           !is_wave_driven ? "not driven by waves"
           : scene.start   ? "cmps.start gives a time"
                           : "still water before the first wave is not simulated",
           is_wave_driven && !scene.start);
    const bool has_zone = is_wave_driven && scene.boundary != Boundary::paper;
    decide("relaxation_zone", has_zone,
           has_zone         ? "cmps.boundary asks for it"
           : is_wave_driven ? "cmps.boundary = \"paper\""
                            : "not driven by waves",
           is_wave_driven);

    decide("absorption", has_zone && scene.absorption > 0,
           !is_wave_driven        ? "not driven by waves"
           : !has_zone            ? "cmps.boundary = \"paper\""
           : scene.absorption > 0 ? "the wall takes in what comes back to it"
                                  : "cmps.absorption = 0",
           is_wave_driven);

    const bool has_overflow = is_wave_driven && scene.boundary != Boundary::relaxation;
    decide("wall_overflow", has_overflow,
           has_overflow     ? "cmps.boundary asks for it"
           : is_wave_driven ? "wall and relaxation zone take reflected waves"
                            : "not driven by waves",
           is_wave_driven);

    // boundary layer of a wave of about a second: sqrt(nu T)
    const double layer = std::sqrt(scene.viscosity * 1.0);
    const bool is_resolved = layer > 2.0 * scene.settings.spacing;
    decide("viscosity", (scene.viscosity_is_given && scene.viscosity > 0) || is_resolved,
           scene.viscosity_is_given
               ? "cmps.viscosity is given"
               : fmt::format("boundary layer of one second {:.2g} m, particle spacing {:.2g} m", layer,
                             scene.settings.spacing));

    const double height = scene.wave_height;
    // in front of a reflecting structure waves stand twice as high as they came
    const double steepness = (scene.structure.empty() ? 1.0 : 2.0) * height / scene.settings.depth;
    decide("turbulence", steepness > 0.8,
           height == 0 ? "no wave height is given: no breaking expected"
                       : fmt::format("largest H/h {:.2f} {} 0.8: {}breaking expected", steepness,
                                     steepness > 0.8 ? ">" : "<=", steepness > 0.8 ? "" : "no "));

    double crest = -1e300;
    if (scene.tank || !scene.bed.empty())  // else the scene is refused anyway
        for (const std::size_t k : barriers(scene, make_solid(scene)))
            for (const Point& p : scene.structure[k]) crest = std::max(crest, p[1]);
    const double reachable = 1.2 * scene.settings.depth;  // run-up of a breaking standing wave
    const bool blocks = crest > 0 && crest < reachable && scene.water.empty() && !scene.tank;
    decide("overtopping_basin", blocks,
           crest <= 0           ? "no structure keeps still water back"
           : crest >= reachable ? fmt::format("crest at {:.2f} m is out of reach", crest)
           : blocks             ? fmt::format("crest at {:.2f} m can be reached", crest)
                                : "cmps.water says where water stands");
}

}  // namespace cmps
