#include "cmps/effect_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cmps/linear_waves.hpp"
#include "cmps/scene_geometry.hpp"

namespace cmps {
namespace {

constexpr double breaking = 0.8;  // H/h: McCowan's (1894) limit of a wave over level ground is 0.78

struct Verdict {
    bool is_needed;
    std::string reason;
};

/// Still water between the wall and what holds it back: depths, m, at places x, m. What hangs above the
/// ground is no depth.
struct DepthProfile {
    std::vector<double> x, depth;
};

DepthProfile still_depths(const Scene& scene) {
    const Solid solid = make_solid(scene);
    const double from = scene.wall_at_start(), to = end_of_water(scene, solid);
    constexpr int pieces = 400;
    DepthProfile profile;
    for (int i = 0; i < pieces; ++i) profile.x.push_back(from + (i + 0.5) / pieces * (to - from));
    std::vector<Point> corners = scene.bed;
    for (const Polygon& polygon : scene.structure)
        corners.insert(corners.end(), polygon.begin(), polygon.end());
    const double beside = 0.01 * scene.settings.spacing;
    for (const Point& corner : corners)  // where the ground is nearest to the surface; on a face, beside it
        for (const double x : {corner[0] - beside, corner[0] + beside})
            if (x > from && x < to) profile.x.push_back(x);
    std::sort(profile.x.begin(), profile.x.end());
    for (const double x : profile.x) {
        double low = 0;
        for (const auto& [z0, z1] : solid.free_intervals(x, lowest_bottom(scene) - scene.settings.spacing, 0))
            if (z1 > -1e-9) low = z0;
        profile.depth.push_back(-low);
    }
    return profile;
}

/// Waves that meet ground rising out of the water from `depth` on over `length` surge up it whole where it is
/// steep: above a surf similarity of 3.3 (Battjes 1974), a solitary wave above S0 = 0.37 (Grilli et al.
/// 1997).
Verdict breaks_on_slope(const Scene& scene, double depth, double length, double height) {
    const double slope = depth / length, period = scene.wave_period;
    const double similarity = period > 0
                                  ? slope / std::sqrt(height / (9.81 * period * period / 6.283185307179586))
                                  : 1.521 * slope / std::sqrt(height / scene.settings.depth);
    const double limit = period > 0 ? 3.3 : 0.37;
    const bool breaks = similarity < limit;
    return {breaks, fmt::format("the ground rises out of the water at 1:{:.3g}, {} {:.2f} {} {:.2f}: {}",
                                1 / slope, period > 0 ? "surf similarity" : "S0 of a solitary wave",
                                similarity, breaks ? "<" : ">=", limit,
                                breaks ? "breaking expected" : "waves surge, no breaking expected")};
}

Verdict needs_turbulence(const Scene& scene) {
    if (scene.drive == Drive::none) return {false, "neither waves nor a piston make waves"};
    if (scene.wave_height == 0) return {false, "no wave height is given: no breaking expected"};
    const double offshore = scene.bed.empty() ? scene.settings.depth : -scene.bed.front()[1];
    // in front of a reflecting structure waves stand twice as high as they came
    const double reflected = scene.structure.empty() ? 1.0 : 2.0;
    const auto height_at = [&](double depth) {
        return scene.wave_height * (offshore > 0 ? shoaling(scene.wave_period, offshore, depth) : 1.0);
    };
    const DepthProfile ground = still_depths(scene);
    const double thin = 1e-3 * scene.settings.depth;
    double largest = 0, where = 0;
    std::size_t begin = ground.x.size();  // of the last stretch in which waves are too high for the depth
    for (std::size_t i = 0; i < ground.x.size(); ++i) {
        const double depth = std::max(ground.depth[i], thin), ratio = reflected * height_at(depth) / depth;
        if (ratio <= breaking) begin = ground.x.size();
        if (ratio > breaking && begin == ground.x.size()) begin = i;
        if (ratio > largest) largest = ratio, where = ground.x[i];
    }
    const bool runs_dry = begin + 1 < ground.x.size() && ground.depth.back() < 0.05 * scene.settings.depth;
    double elsewhere = 0;  // where the ground does not run dry, height over depth decides alone
    for (std::size_t i = 0; i < (runs_dry ? begin : 0); ++i) {
        const double depth = std::max(ground.depth[i], thin);
        elsewhere = std::max(elsewhere, reflected * height_at(depth) / depth);
    }
    if (runs_dry && elsewhere <= breaking && begin > 0) {
        const double depth = ground.depth[begin];
        return breaks_on_slope(scene, depth, ground.x.back() - ground.x[begin], height_at(depth));
    }
    const bool breaks = largest > breaking;
    return {breaks, fmt::format("largest H/h {:.2f} {} {:g} at x = {:.4g} m: {}breaking expected", largest,
                                breaks ? ">" : "<=", breaking, where, breaks ? "" : "no ")};
}

}  // namespace

void decide_effects(const common::SceneFile& file, Scene& scene) {
    using common::EffectWish;
    const bool is_wave_driven = scene.drive == Drive::waves;
    // else the scene is refused anyway
    const bool is_readable = (scene.tank || !scene.bed.empty()) && scene.onshore > scene.offshore &&
                             scene.settings.spacing > 1e-4 * scene.settings.depth &&
                             scene.onshore - scene.offshore < 1e6 * scene.settings.spacing;
    // true: the user leaves it to the rule
    const auto decide = [&](const char* name, bool is_needed, const std::string& reason,
                            bool can_act = true) {
        const EffectWish wish = common::read_effect_wish(file, name);
        if (wish == EffectWish::automatic || !can_act)
            scene.effects.push_back({name, is_needed, reason});
        else
            scene.effects.push_back(
                {name, wish == EffectWish::on,
                 fmt::format("[effects] {} = \"{}\"", name, wish == EffectWish::on ? "on" : "off")});
        return wish == EffectWish::automatic;
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

    const Verdict turbulence = is_readable ? needs_turbulence(scene) : Verdict{false, "the scene is refused"};
    scene.turbulence_is_automatic = decide("turbulence", turbulence.is_needed, turbulence.reason);

    double crest = -1e300;
    if (is_readable)
        for (const std::size_t k : barriers(scene, make_solid(scene)))
            for (const Point& p : scene.structure[k]) crest = std::max(crest, p[1]);
    const double reachable = 1.2 * scene.settings.depth;  // run-up of a breaking standing wave
    const bool blocks = crest > 0 && crest < reachable && scene.water.empty() && !scene.tank;
    const bool basin_is_automatic =
        decide("overtopping_basin", blocks,
               crest <= 0           ? "no structure keeps still water back"
               : crest >= reachable ? fmt::format("crest at {:.2f} m is out of reach", crest)
               : blocks             ? fmt::format("crest at {:.2f} m can be reached", crest)
                                    : "cmps.water says where water stands",
               crest > 0);
    scene.crest_is_out_of_reach =
        basin_is_automatic && crest >= reachable && scene.water.empty() && !scene.tank;
}

}  // namespace cmps
