#include "dem/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dem {

using common::Range;
using common::SceneFile;
using common::Section;

namespace {

Vector read_vector(const Section& section, const char* key, const char* unit, const char* about,
                   const Vector& fallback) {
    const auto v = section.numbers(key, unit, about, 3, Range::any(),
                                   std::vector<double>{fallback.x(), fallback.y(), fallback.z()});
    return {v[0], v[1], v[2]};
}

void read_material(const common::SceneFile& file, const Section& dem, Scene& scene) {
    scene.element.diameter = dem.number("element_diameter", "m", "diameter d of a sphere element",
                                        common::Range::between(1e-6, 1e3), 0.008);
    scene.element.density_ratio = dem.number(
        "density_ratio", "-", "density s of an element over that of water", Range::positive(), 3.689);
    scene.water.density = common::read_water_density(file, {"dem", "water_density"}, {"cmps", "density"});
    scene.water.viscosity =
        dem.number("viscosity", "m2/s", "kinematic viscosity of water", Range::not_negative(), 1e-6);
    scene.water.added_mass_coefficient =
        dem.number("added_mass", "-", "added mass coefficient C_M", Range::not_negative(), 0.5);
    scene.water.drag_coefficient = dem.number(
        "drag_coefficient", "-", "C_D of eq. (12) at high Reynolds numbers", Range::not_negative(), 0.4);
    scene.material.young_modulus =
        dem.number("young_modulus", "Pa", "of the elements", Range::positive(), 1e7);
    scene.material.poisson_ratio =
        dem.number("poisson_ratio", "-", "of the elements",
                   Range{.lowest = 0, .highest = 0.5, .highest_is_open = true}, 0.3);
    scene.material.friction =
        dem.number("friction", "-", "Coulomb coefficient mu between elements", Range::not_negative(), 0.577);
    scene.material.damping_ratio =
        dem.number("damping_ratio", "-", "of contacts; 1 is critical damping of the two bodies",
                   Range::not_negative(), 1.0);
    scene.contact = dem.choice("contact", "contact law", {"hertz", "linear"}, "hertz") == "linear"
                        ? ContactLaw::linear
                        : ContactLaw::hertz;
    scene.reference_overlap =
        scene.element.diameter *
        dem.number("reference_overlap", "d",
                   "overlap where k_n of the linear law and of wires is taken from Hertz theory",
                   Range{.lowest = 0, .highest = 0.2, .lowest_is_open = true}, 0.01);
    scene.gravity = read_vector(dem, "gravity", "m/s2", "acceleration of gravity", Vector(0, 0, -9.81));
    const double gravity = scene.gravity.norm();
    if (gravity > 0) scene.time_scale = std::sqrt(scene.element.diameter / gravity / (0.008 / 9.81));
}

/// Defaults are shares of the time a Rayleigh wave takes over a sphere, so that they follow stiffness and
/// size.
double rayleigh_time(const Scene& scene) {
    const Material& m = scene.material;
    const double shear_modulus = m.young_modulus / (2 * (1 + m.poisson_ratio));
    return std::numbers::pi * 0.5 * scene.element.diameter *
           std::sqrt(scene.element.density_ratio * scene.water.density / shear_modulus) /
           (0.1631 * m.poisson_ratio + 0.8766);
}

void read_stepping(const SceneFile& file, const Section& dem, Scene& scene) {
    const double share = file.accuracy() == common::Accuracy::draft      ? 0.48
                         : file.accuracy() == common::Accuracy::standard ? 0.24
                                                                         : 0.12;
    const double flow = file.accuracy() == common::Accuracy::draft      ? 4e-3
                        : file.accuracy() == common::Accuracy::standard ? 2e-3
                                                                        : 1e-3;
    // Two digits are enough for a default, and read better in run.json.
    const auto step_of = [&](double part) {
        return std::strtod(fmt::format("{:.1e}", part * rayleigh_time(scene)).c_str(), nullptr);
    };
    const double chosen = step_of(share);
    scene.usual_time_step = step_of(0.24);
    scene.time_step_is_chosen = !dem.has("time_step");
    scene.step.time_step =
        dem.number("time_step", "s", "largest step; default from the accuracy and the stiffness",
                   Range::positive(), chosen);
    constexpr double most_steps = 1e12;  // a year of computing for a single sphere
    if (scene.time.end > most_steps * scene.step.time_step)
        dem.problem("time_step",
                    fmt::format("{} s would take {:.1g} steps to time.end = {} s; at most {:.0g}",
                                scene.step.time_step, scene.time.end / scene.step.time_step, scene.time.end,
                                most_steps));
    scene.step.flow_interval =
        dem.number("flow_interval", "s", "between samples of the water at every sphere",
                   common::Range::at_least(1e-6), flow);
    const double d = scene.element.diameter;
    scene.step.skin = d * dem.number("skin", "d", "of neighbour lists; no effect on results",
                                     Range{.lowest = 0, .highest = 2, .lowest_is_open = true}, 0.15);
    scene.step.overlap_noted =
        d * dem.number("overlap_noted", "d",
                       "deeper contacts are counted; of smaller spheres, their diameters", Range::positive(),
                       0.05);
    scene.step.overlap_limit =
        d * dem.number("overlap_limit", "d",
                       "deeper contacts stop the run; of smaller spheres, their diameters", Range::positive(),
                       0.5);
    if (scene.step.overlap_noted > scene.step.overlap_limit && dem.has("overlap_noted"))
        dem.problem("overlap_noted",
                    fmt::format("expected at most dem.overlap_limit, {} d", scene.step.overlap_limit / d));
    scene.output_interval =
        dem.number("output_interval", "s", "between recorded instants", common::Range::at_least(1e-6), 0.05);
}

/// What a single element would do under its own weight is the least that any contact has to bear.
void judge_stiffness(const Section& dem, const Scene& scene) {
    const double weight =
        scene.element.density_ratio * scene.water.density * scene.element.volume() * scene.gravity.norm();
    const double radius = scene.element.diameter / 4;  // R* of two elements
    const double sunk =
        scene.contact == ContactLaw::linear
            ? weight / scene.material.hertz_stiffness(radius, scene.reference_overlap)
            : std::pow(0.75 * weight / (scene.material.contact_modulus() * std::sqrt(radius)), 2.0 / 3);
    if (sunk > scene.step.overlap_limit)
        dem.problem("young_modulus",
                    fmt::format("too soft: an element sinks {:.2g} m into another under its own weight, past "
                                "dem.overlap_limit ({:.2g} m)",
                                sunk, scene.step.overlap_limit));
}

void read_water(const Section& dem, Scene& scene, bool& dry) {
    dry = dem.boolean("dry", "no water at all", false);
    scene.uniform_water.velocity =
        read_vector(dem, "current", "m/s", "uniform water velocity at t = 0, without a flow", Vector::Zero());
    scene.uniform_water.acceleration =
        read_vector(dem, "current_acceleration", "m/s2",
                    "of that water: it moves with current + current_acceleration t", Vector::Zero());
    const UniformWater& water = scene.uniform_water;
    for (const auto& [key, value] :
         {std::pair{"current", water.velocity}, {"current_acceleration", water.acceleration}})
        if (dry && !value.isZero(0)) dem.problem(key, "dem.dry is true: there is no water to flow");
    scene.uniform_water.element_diameter = scene.element.diameter;
    scene.still_outside =
        dem.choice("flow_outside", "water outside the flow grid", {"error", "still"}, "error") == "still";
}

void read_sleep(const Section& dem, Scene& scene) {
    const Section sleeping = dem.table("sleeping");
    scene.sleep.rest_time = sleeping.number("rest_time", "s", "a block must rest so long before it sleeps",
                                            Range::positive(), 0.1);
    scene.sleep.rest_displacement =
        scene.element.diameter *
        sleeping.number("rest_displacement", "d", "farthest point, over rest_time", Range::positive(), 1e-5);
    scene.sleep.wake_load =
        sleeping.number("wake_load", "-", "change of load that wakes, of what the block could still take",
                        {.lowest = 0, .highest = 0.5, .lowest_is_open = true}, 0.1);
}

/// Whether anything can stop blocks that go where gravity pulls: columns and spheres that do not move, or a
/// plane that faces them and is not steeper than friction holds.
bool may_come_to_rest(const Scene& scene) {
    const double gravity = scene.gravity.norm();
    const auto& surroundings = scene.surroundings;
    if (gravity == 0) return true;
    const bool has_mound = !scene.mound.empty();
    if (has_mound && scene.gravity.z() < 0) return true;
    std::size_t facing = 0;
    bool is_steep = false;
    for (const auto& plane : surroundings.planes) {
        const double against = -plane.normal.dot(scene.gravity);
        if (against <= 1e-9 * gravity) continue;
        ++facing;
        is_steep = std::sqrt(std::max(0.0, gravity * gravity - against * against)) >
                   (scene.material.friction + 1e-6) * against;  // rounding: level is not steep
    }
    // Two planes make a wedge, and fixed spheres and blocks obstacles.
    for (std::size_t i = 0; i < scene.placed.size(); ++i)
        if (scene.placed.is_fixed[i] || scene.placed.is_thrown(i)) return true;
    if (!has_mound && !surroundings.fixed_spheres.empty()) return true;
    return facing > 1 || (facing == 1 && !is_steep);
}

/// Blocks that nothing stops, or lighter than the water they push aside, would move for ever instead of
/// settling.
void judge_settling(const SceneFile& file, bool dry, const Scene& scene) {
    if (!scene.packing.settle || file.has_problems()) return;
    if (!may_come_to_rest(scene)) {
        const auto& g = scene.gravity;
        file.section("dem").problem(
            "gravity",
            fmt::format("[{}, {}, {}] m/s2: no mound, plane or fixed sphere can stop the blocks there, "
                        "they never settle; dem.packing.method = \"none\" lets them go",
                        g.x(), g.y(), g.z()));
        return;
    }
    if (dry || scene.gravity.z() >= 0) return;
    for (std::size_t i = 0; i < scene.placed.size(); ++i) {
        const Shape& shape = scene.placed.shape_of(i);
        const double lifted = scene.water.density * shape.displaced_volume;
        if (scene.placed.is_fixed[i] || scene.placed.is_thrown(i) || shape.mass > lifted) continue;
        const std::string message = fmt::format(
            "block {} weighs {:.3g} kg and displaces {:.3g} kg of water: it floats and never settles", i + 1,
            shape.mass, lifted);
        const Section armour = file.section("dem.blocks");
        if (scene.placed.shape[i] == scene.placed.shape[0] && armour.has("displaced_volume"))
            armour.problem("displaced_volume", message);
        else
            file.section("dem").problem("density_ratio", message);
        return;
    }
}

}  // namespace

Scene read_scene(const SceneFile& file, const SceneFile* layout) {
    Scene scene;
    bool dry = false;
    scene.time = common::read_time(file);
    scene.perturbation = file.perturbation();
    const Section dem = file.section("dem");
    read_material(file, dem, scene);
    read_stepping(file, dem, scene);
    judge_stiffness(dem, scene);
    read_water(dem, scene, dry);
    read_sleep(dem, scene);
    const Section restart = dem.table("restart");
    if (restart.has("time"))
        scene.restart_time =
            restart.number("time", "s", "instant of the earlier run to start from (with --from a window)",
                           Range::any(), 0.0);
    if (restart.has("clock"))
        scene.restart_clock = restart.number(
            "clock", "s", "time at which the new run starts; default: the same instant", Range::any(), 0.0);
    if (restart.has("calm"))
        scene.restart_calm = restart.boolean(
            "calm", "blocks settle in still water before the new run starts; always where some are put back",
            false);
    read_blocks(file, scene);
    judge_settling(file, dry, scene);
    read_wires(file, layout, scene);
    choose_effects(file, dry, scene);
    return scene;
}

}  // namespace dem
