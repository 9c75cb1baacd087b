#include "cmps/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cmps/linear_waves.hpp"
#include "cmps/scene_checks.hpp"
#include "cmps/scene_geometry.hpp"
#include "cmps/time_table.hpp"
#include "cmps/wave_sampling.hpp"
#include "common/errors.hpp"

namespace cmps {
namespace {

using common::EffectWish;
using common::Range;
using common::Section;

constexpr double most_gravity = 1e4;        // m/s2: a thousand g
constexpr double most_speed = 1e4;          // m/s
constexpr double most_particles = 2e7;      // at about 1.5 kB each
constexpr double most_gauge_samples = 1e6;  // of one gauge in one window
constexpr double most_window_values = 5e8;  // of one dataset in one window, 2 GB

template <class Value>
Value chosen(const Section& section, const char* key, const char* about,
             const std::vector<std::pair<std::string, Value>>& options, const std::string& fallback) {
    std::vector<std::string> words;
    for (const auto& [word, value] : options) words.push_back(word);
    const std::string word = section.choice(key, about, words, fallback);
    for (const auto& [name, value] : options)
        if (name == word) return value;
    return options.front().second;
}

/// True where all polygons enclose something; points given twice in a row are taken once.
bool check_polygons(const Section& section, const char* key, std::vector<Polygon>& polygons) {
    bool are_sound = true;
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        Polygon& polygon = polygons[i];
        const auto is_wrong = [&](const std::string& what) {
            section.problem(key, fmt::format("polygon {} {}", i + 1, what));
            are_sound = false;
        };
        polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
        if (polygon.size() > 1 && polygon.front() == polygon.back()) polygon.pop_back();
        std::array<std::size_t, 2> where{};
        std::size_t point = 0;
        if (polygon.size() < 3)
            is_wrong(fmt::format("has {} points; a closed polygon needs at least 3", polygon.size()));
        else if (crosses_itself(polygon, where))
            is_wrong(fmt::format("crosses itself: edges {} and {}", where[0], where[1]));
        else if (folds_back(polygon, point))
            is_wrong(fmt::format("folds back on itself at its point {}, ({:g}, {:g})", point,
                                 polygon[point - 1][0], polygon[point - 1][1]));
    }
    return are_sound;
}

/// What an accuracy level stands for. Points of the front of error over time
/// (workflows/studies/cost_cmps.py): standard is the cheapest that keeps 95 % of a wave over three lengths
/// with a margin; a looser pressure solve saves a tenth and costs less than lattices differ, which suits a
/// draft; a wider kernel gives what a third more particles over the depth give, at two thirds of their time.
struct Level {
    int over_depth;  ///< particles over the depth of still water at the wall
    double tolerance, kernel_radius;
};

Level level_of(common::Accuracy accuracy) {
    switch (accuracy) {
        case common::Accuracy::draft:
            return {.over_depth = 16, .tolerance = 1e-2, .kernel_radius = 2.6};
        case common::Accuracy::fine:
            return {.over_depth = 30, .tolerance = 1e-3, .kernel_radius = 3.1};
        case common::Accuracy::standard:
            break;
    }
    return {.over_depth = 24, .tolerance = 1e-3, .kernel_radius = 2.6};
}

void read_water_velocity(const Section& section, Scene& scene) {
    scene.water_velocity = section.points("water_velocity", "m/s",
                                          "u, w at the start, of each polygon of cmps.water; none: at rest",
                                          std::vector<Point>{});
    if (!scene.water_velocity.empty() && scene.water_velocity.size() != scene.water.size())
        section.problem("water_velocity",
                        fmt::format("{} velocities for {} polygons of cmps.water: one [u, w] for each",
                                    scene.water_velocity.size(), scene.water.size()));
    for (const Point& velocity : scene.water_velocity)
        if (!(std::hypot(velocity[0], velocity[1]) <= most_speed))
            section.problem("water_velocity", fmt::format("[{:g}, {:g}] m/s; at most {:g}", velocity[0],
                                                          velocity[1], most_speed));
}

/// True where the geometry is complete and can be judged further.
bool read_geometry(const common::SceneFile& file, const Section& section, Scene& scene) {
    if (section.has("tank")) {
        const auto box =
            section.numbers("tank", "m", "closed box x0, x1, z0, z1 instead of a flume bed", 4, Range::any());
        if (box[1] <= box[0] || box[3] <= box[2])
            section.problem("tank", "expected x0 < x1 and z0 < z1");
        else
            scene.tank = {box[0], box[1], box[2], box[3]};
    } else {
        scene.bed = common::read_bed(file, true);
    }
    const double x0 = scene.tank ? (*scene.tank)[0] : scene.bed.empty() ? 0.0 : scene.bed.front()[0];
    const double x1 = scene.tank ? (*scene.tank)[1] : scene.bed.empty() ? 1.0 : scene.bed.back()[0];
    scene.offshore = section.number("offshore", "m", "x of the moving wall", Range::any(), x0);
    scene.onshore = section.number("onshore", "m", "x of the shoreward end", Range::any(), x1);
    scene.structure =
        section.polygons("structure", "m", "closed polygons of the structure", std::vector<Polygon>{});
    bool is_sound = check_polygons(section, "structure", scene.structure);
    scene.water = section.polygons(
        "water", "m",
        "closed polygons filled with water at the start; none: below z = 0 between wall and structure",
        std::vector<Polygon>{});
    is_sound &= check_polygons(section, "water", scene.water);
    read_water_velocity(section, scene);
    if (scene.onshore <= scene.offshore)
        section.problem("onshore", fmt::format("must lie shoreward of cmps.offshore = {:g}", scene.offshore));
    if (!scene.tank && !scene.bed.empty() && (scene.offshore < x0 || scene.onshore > x1))
        section.problem(scene.offshore < x0 ? "offshore" : "onshore",
                        fmt::format("lies outside the flume's bed, x = {:g} to {:g} m", x0, x1));
    return is_sound && scene.onshore > scene.offshore && (scene.tank || !scene.bed.empty());
}

/// Particles of water, about: the structure is not taken off.
double about_particles(const Scene& scene) {
    double area = 0;
    for (const Polygon& polygon : scene.water) area += std::abs(signed_area(polygon));
    if (scene.water.empty()) area = scene.settings.depth * (scene.onshore - scene.offshore);
    return area / (scene.settings.spacing * scene.settings.spacing);
}

void read_numerics(const common::SceneFile& file, const Section& section, Scene& scene, double depth) {
    Settings& settings = scene.settings;
    const Level level = level_of(file.accuracy());
    settings.spacing = section.number("particle_spacing", "m",
                                      "l0; default: a whole number of particles over the depth at the wall "
                                      "(draft 16, standard 24, fine 30)",
                                      Range::positive(), depth / level.over_depth);
    const auto is_drop = [&](const Polygon& polygon) {  // a few particles, side by side too
        const auto [x0, x1, z0, z1] = bounding_box(polygon);
        return x1 - x0 < 3 * settings.spacing && z1 - z0 < 3 * settings.spacing;
    };
    if (settings.spacing > 0.34 * depth &&
        (scene.water.empty() || !std::all_of(scene.water.begin(), scene.water.end(), is_drop)))
        section.problem(
            "particle_spacing",
            fmt::format(
                "{:g} m is too coarse: the water is {:g} m deep, at least three particles must stand in it",
                settings.spacing, depth));
    settings.depth = depth;
    const double particles = about_particles(scene);
    if (!scene.water.empty() && particles < 0.5)
        section.problem("water", fmt::format("holds {:.2g} particles of {:g} m: no water at all", particles,
                                             settings.spacing));
    if (particles > most_particles)
        section.problem("particle_spacing", fmt::format("{:g} m makes about {:.1e} particles; at most {:.0e} "
                                                        "fit into the memory of a machine",
                                                        settings.spacing, particles, most_particles));
    settings.fall = scene.tank
                        ? std::hypot((*scene.tank)[1] - (*scene.tank)[0], (*scene.tank)[3] - (*scene.tank)[2])
                        : depth;
    settings.kernel = chosen<KernelKind>(
        section, "kernel", "weight function",
        {{"wendland", KernelKind::wendland}, {"rational", KernelKind::rational}}, "wendland");
    settings.kernel_radius_ratio =
        section.number("kernel_radius", "-", "radius of the kernel over l0; default: 2.6, with fine 3.1",
                       Range::between(1.6, 5.0), level.kernel_radius);
    settings.time_stepping = chosen<TimeStepping>(
        section, "time_stepping",
        "order of drift and pressure: midpoint (second order) or predicted (the paper's)",
        {{"midpoint", TimeStepping::midpoint}, {"predicted", TimeStepping::predicted}}, "midpoint");
    settings.gradient = chosen<Gradient>(
        section, "gradient",
        "pressure gradient: eq. (1), (4), (5) with local or global minima or corrected, or corrected",
        {{"standard", Gradient::standard},
         {"modified", Gradient::modified},
         {"antisymmetric_local", Gradient::antisymmetric_local},
         {"antisymmetric", Gradient::antisymmetric_global},
         {"antisymmetric_corrected", Gradient::antisymmetric_corrected},
         {"corrected", Gradient::corrected}},
        "corrected");
    settings.pressure.source = chosen<Source>(section, "source", "source of the pressure equation",
                                              {{"density", Source::density},
                                               {"higher_order", Source::higher_order},
                                               {"corrected", Source::corrected},
                                               {"error_compensating", Source::error_compensating}},
                                              "higher_order");
    settings.pressure.laplacian = chosen<Laplacian>(
        section, "laplacian", "Laplacian of the pressure equation",
        {{"standard", Laplacian::standard}, {"higher_order", Laplacian::higher_order}}, "standard");
    settings.pressure.surface = chosen<SurfaceCondition>(
        section, "surface", "p = 0 at detected surface particles, or smoothly at the surface itself",
        {{"smooth", SurfaceCondition::smooth}, {"detected", SurfaceCondition::detected}}, "smooth");
    settings.pressure.density_weight =
        section.number("density_weight", "-", "gamma, weight of the density term in the source",
                       Range::between(0, 1), settings.pressure.density_weight);
    settings.pressure.density =
        common::read_water_density(file, {"cmps", "density"}, {"dem", "water_density"});
    settings.negative_pressure = section.boolean("negative_pressure", "keep pressures below zero", false);
    settings.tolerance = section.number(
        "tolerance", "-",
        "of the pressure solve, relative to its right-hand side; default: 1e-3, with draft 1e-2",
        Range::between(1e-12, 0.1), level.tolerance);
    settings.multigrid_from = static_cast<std::size_t>(
        section.integer("multigrid_from", "unknowns from which the pressure is preconditioned by multigrid",
                        Range::not_negative(), static_cast<std::int64_t>(settings.multigrid_from)));
    settings.shifting = section.number("shifting", "-", "coefficient of particle shifting, 0: none",
                                       Range::between(0, 1), settings.shifting);
    settings.velocity_filter =
        section.number("velocity_filter", "-", "strength of the filter of particle-scale velocities, 0: none",
                       Range::between(0, 0.5), settings.velocity_filter);
    settings.stabilisation =
        section.number("stabilisation", "-", "pairs nearer than this many l0 are pushed apart, 0: none",
                       Range::between(0, 0.98), settings.stabilisation);
    settings.courant =
        section.number("courant", "-", "largest u dt / l0", Range::between(0.001, 0.5), settings.courant);
    settings.time_step_factor =
        section.number("time_step_factor", "-", "on the largest step by speed, celerity and acceleration",
                       Range::between(0.01, 4), settings.time_step_factor);
    if (const double way = settings.courant * settings.time_step_factor; way >= 1)
        section.problem("time_step_factor",
                        fmt::format("{:g} times cmps.courant = {:g}: water would move by {:g} l0 in a step, "
                                    "past its neighbours; less than 1",
                                    settings.time_step_factor, settings.courant, way));
    const auto gravity =
        section.numbers("gravity", "m/s2", "x and z component", 2,
                        Range::between(-most_gravity, most_gravity), std::vector<double>{0.0, -9.81});
    settings.gravity_x = gravity[0], settings.gravity_z = gravity[1];
    if (section.has("gravity") && section.has("gravity_file"))
        section.problem("gravity", "cmps.gravity_file says it too: give one of them");
}

/// A table that cannot be read is found before anything runs.
std::optional<TimeTable> read_table(const Section& section, const char* key,
                                    const std::filesystem::path& path, int columns) {
    if (path.empty()) return {};
    try {
        return TimeTable(path, columns);
    } catch (const common::InputError& error) {
        section.problem(key, error.what());
        return {};
    }
}

/// What [waves] says of the waves that arrive in windows: rules and the boundary need their height and
/// period.
void read_wave_kind(const common::SceneFile& file, Scene& scene, double depth) {
    scene.celerity = std::sqrt(9.81 * depth);
    if (scene.drive != Drive::waves || !file.has_section("waves")) return;
    const Section waves = file.foreign_section("waves");
    const std::string kind =
        waves.choice("kind", "what comes in from offshore",
                     {"regular", "solitary", "jonswap", "bretschneider", "series", "none"},
                     file.has_section("initial") ? std::optional<std::string>("none") : std::nullopt);
    if (kind == "series" || kind == "none") return;
    scene.wave_height = waves.number("height", "m", "wave height", Range::positive());
    if (kind == "solitary") return;
    scene.wave_period = waves.number("period", "s", "wave period", Range::positive());
    scene.celerity = phase_speed(scene.wave_period, depth);
    // the common value; that of waves.peak_enhancement changes little of what samples lose
    scene.sea_enhancement = kind == "jonswap" ? 3.3 : kind == "bretschneider" ? 1.0 : 0.0;
}

/// Waves lower than the particles can tell, and a threshold that none of them reaches.
void judge_waves(const common::SceneFile& file, const Section& section, Scene& scene, double depth) {
    const double height = scene.wave_height, l0 = scene.settings.spacing;
    scene.arrival_threshold =
        section.number("arrival_threshold", "m",
                       "surface elevation at the wall that counts as arrival; default: 0.005 depths, at most "
                       "0.1 wave heights",
                       Range::positive(), height > 0 ? std::min(0.005 * depth, 0.1 * height) : 0.005 * depth);
    if (height == 0 || file.has_problems()) return;  // stand-ins of other mistakes are not judged
    if (scene.arrival_threshold > height)
        section.problem("arrival_threshold",
                        fmt::format("{:g} m is more than waves.height = {:g} m: the waves would never arrive",
                                    scene.arrival_threshold, height));
    constexpr double least = 0.5, few = 3.0;  // particles over the height of a wave
    if (height < least * l0)
        file.foreign_section("waves").problem(
            "height", fmt::format("{:g} m is {:.2g} particles of cmps.particle_spacing = {:g} m: the near "
                                  "field cannot tell waves lower than {:g}; a particle_spacing of {:.2g} m "
                                  "would show them roughly, one of {:.2g} m well",
                                  height, height / l0, l0, least, height / few, 0.1 * height));
    else if (height < few * l0)
        scene.remarks.push_back(
            {"low_waves", fmt::format("waves.height = {:g} m is {:.2g} particles of {:g} m: heights in the "
                                      "near field are rough below {:g}",
                                      height, height / l0, l0, few)});
}

/// What [waves] says of the waves that arrive.
void read_waves(const common::SceneFile& file, const Section& section, Scene& scene, double depth) {
    read_wave_kind(file, scene, depth);
    judge_waves(file, section, scene, depth);
}

void read_drive(const Section& section, Scene& scene, double depth) {
    scene.drive = chosen<Drive>(
        section, "drive", "what moves the offshore wall: windows of boussinesq, a piston's path, nothing",
        {{"waves", Drive::waves}, {"piston", Drive::piston}, {"none", Drive::none}},
        scene.tank ? "none" : "waves");
    scene.piston_file = section.file("piston_file", "CSV: t, displacement of the wall from cmps.offshore",
                                     scene.drive == Drive::piston);
    scene.gravity_file = section.file("gravity_file", "CSV: t, gx, gz", false);
    constexpr double wave_gravity = 9.81;  // of boussinesq
    const Settings& settings = scene.settings;
    if (scene.drive == Drive::waves &&
        std::hypot(settings.gravity_x, settings.gravity_z + wave_gravity) > 0.01 * wave_gravity)
        section.problem("gravity", fmt::format("[{:g}, {:g}] is not that of the waves that come in, [0, "
                                               "-9.81]: only tanks and pistons may have another",
                                               settings.gravity_x, settings.gravity_z));
    if (scene.drive != Drive::waves && !scene.tank && settings.gravity_z > 0)
        section.problem("gravity", "z is up: water would fall out of the flume; [0, -9.81] points down");
    const auto piston = read_table(section, "piston_file", scene.piston_file, 2);
    if (const auto gravity = read_table(section, "gravity_file", scene.gravity_file, 3))
        for (const std::size_t component : {1, 2})
            for (const double value : gravity->range(component))
                if (std::abs(value) > most_gravity)
                    section.problem("gravity_file", fmt::format("{}: {:g} m/s2 in column {}; at most {:g}",
                                                                scene.gravity_file.string(), value,
                                                                component + 1, most_gravity));
    if (!scene.piston_file.empty() && scene.drive != Drive::piston)
        section.problem("piston_file", "nothing moves by it: cmps.drive is not \"piston\"");
    scene.boundary = chosen<Boundary>(
        section, "boundary", "offshore: relaxation zone, the paper's overflowing wall, or both",
        {{"relaxation", Boundary::relaxation}, {"paper", Boundary::paper}, {"both", Boundary::both}},
        "relaxation");
    scene.crest_lowering = section.number(
        "crest_lowering", "m", "h_of of eq. (7): how far the wall's crest stays below the waves' surface",
        Range::not_negative(), 0.19 * depth);
    if (scene.crest_lowering >= depth)
        section.problem("crest_lowering",
                        fmt::format("{:g} m leaves nothing of the wall in water {:g} m deep: less than that",
                                    scene.crest_lowering, depth));
    scene.relaxation_length = section.number("relaxation_length", "m", "of the zone behind the wall",
                                             Range::positive(), 3.0 * depth);
    scene.relaxation_strength =
        section.number("relaxation_strength", "1/s",
                       "at the wall; default: 2 in 0.4 m of water, as Froude's law says elsewhere",
                       Range::positive(), 2.0 / scene.froude_time());
    scene.absorption = section.number("absorption", "-", "share of what comes back that the wall takes in",
                                      Range::between(0, 1), 1.0);
    scene.return_time =
        section.number("return_time", "s",
                       "in which the wall comes back to its place; default: 10 in 0.4 m of water, as "
                       "Froude's law says elsewhere",
                       Range::positive(), 10.0 * scene.froude_time());
    if (section.has("start") && !section.is_text("start"))
        scene.start = section.number("start", "s", "time at which the near field starts, or \"arrival\"",
                                     Range::not_negative());
    else
        section.choice("start", "time at which the near field starts, or \"arrival\"", {"arrival"},
                       "arrival");
    scene.viscosity_is_given = section.has("viscosity");
    if (piston && scene.drive == Drive::piston) {
        const auto [least, most] = piston->range(1);
        const double fastest = piston->fastest(1), length = scene.onshore - scene.offshore;
        constexpr double most_speed_ratio = 10.0;  // of sqrt(g d): the jet up its face is 50 depths high
        if (const double limit = most_speed_ratio * std::sqrt(9.81 * depth); fastest > limit)
            section.problem(
                "piston_file",
                fmt::format("{}: the wall moves at {:g} m/s between two rows; at most {:.3g}, ten "
                            "times the celerity of long waves",
                            scene.piston_file.string(), fastest, limit));
        else if (length > 0 && least < -10.0 * length)
            section.problem("piston_file",
                            fmt::format("{}: the wall goes back by {:g} m, more than ten times "
                                        "the near field's length of {:g} m",
                                        scene.piston_file.string(), -least, length));
        else
            scene.piston = {.start = piston->value(1, scene.start.value_or(0.0)),
                            .least = least,
                            .most = most,
                            .fastest = fastest,
                            .period = piston->period(1)};
    }
    scene.viscosity = section.number("viscosity", "m2/s", "kinematic; used by the effect viscosity",
                                     Range::between(0, 1e3), 1e-6);
    scene.smagorinsky = section.number("smagorinsky", "-", "constant of the sub-particle turbulence",
                                       Range::between(0, 10), 0.15);
}

void read_output(const common::SceneFile& file, const Section& section, Scene& scene) {
    scene.particles_interval = section.number("particles_interval", "s", "between stored particle pictures",
                                              common::Range::at_least(1e-6), 0.1);
    const double pictures = std::min(scene.time.window, scene.time.end) / scene.particles_interval + 1;
    const double particles = about_particles(scene);
    if (particles <= most_particles && 2 * particles * pictures > most_window_values)
        section.problem("particles_interval",
                        fmt::format("{:g} s: some {:.0f} particles and {:.2g} pictures in a window; at most "
                                    "{:.1g} values fit into one",
                                    scene.particles_interval, particles, pictures, most_window_values));
    // A particle takes as long to arrive as water takes to cross it. At the celerity that is 2.5 of the
    // longest steps; what is shorter tells of particles, not of water.
    const Settings& settings = scene.settings;
    const double celerity = std::sqrt(std::hypot(settings.gravity_x, settings.gravity_z) *
                                      std::max(settings.depth, settings.spacing));
    scene.pressure_average = section.number(
        "pressure_average", "s", "time over which pressures and forces on faces are averaged, 0: one step",
        Range::not_negative(), celerity > 0 ? settings.spacing / celerity : 0.0);
    if (!section.has("flow")) return;
    const Section flow = file.section("cmps.flow");
    scene.has_flow = true;
    const auto x = flow.numbers("x", "m", "range of the grid", 2, Range::any());
    const auto z = flow.numbers("z", "m", "range of the grid", 2, Range::any());
    const double spacing =
        flow.number("spacing", "m", "of the grid", Range::positive(), scene.settings.spacing);
    const double interval = flow.number("interval", "s",
                                        "between samples; default: 80 a wave, more where the accuracy asks "
                                        "for them, 0.02 where no wave period is known",
                                        common::Range::at_least(1e-6), default_flow_interval(scene));
    if (x[1] <= x[0]) flow.problem("x", "expected [x0, x1] with x0 < x1");
    if (z[1] <= z[0]) flow.problem("z", "expected [z0, z1] with z0 < z1");
    if (scene.offshore < scene.onshore && (x[0] < scene.offshore || x[1] > scene.onshore))
        flow.problem("x", fmt::format("the grid leaves the near field, x = {:g} to {:g} m", scene.offshore,
                                      scene.onshore));
    // a spacing that follows from a mistaken particle spacing is not judged again
    const double judged = flow.has("spacing") ? spacing : std::max(spacing, 1e-3 * scene.settings.depth);
    const double nodes = ((x[1] - x[0]) / judged + 1) * ((z[1] - z[0]) / judged + 1);
    const double samples = std::min(scene.time.window, scene.time.end) / interval + 1;
    if (2 * nodes * samples > most_window_values)
        flow.problem("spacing", fmt::format("the grid has {:.2g} points and {:.2g} samples in a window; at "
                                            "most {:.1g} values fit into one",
                                            nodes, samples, most_window_values));
    if (interval > scene.time.window * (1 + 1e-9))
        flow.problem("interval", fmt::format("{:g} s is longer than time.window = {:g} s: a window holds its "
                                             "two ends at least",
                                             interval, scene.time.window));
    SamplingVerdict sampling;  // else of what was not meant
    if (!file.has_problems()) sampling = judge_sampling(scene, common::Interpolation::linear, interval);
    if (sampling.is_refused)
        flow.problem("interval", sampling.text);
    else if (!sampling.text.empty())
        scene.remarks.push_back({"flow.interval", "cmps.flow.interval of " + sampling.text});
    scene.flow = {.x0 = x[0], .x1 = x[1], .z0 = z[0], .z1 = z[1], .spacing = spacing, .interval = interval};
    scene.flow_smoothing =
        flow.number("acceleration_smoothing", "s",
                    "time over which velocity and Du/Dt are averaged along the path; lag removed",
                    Range::not_negative(), interval);
}

}  // namespace

bool Scene::has_effect(const std::string& name) const {
    return std::any_of(effects.begin(), effects.end(),
                       [&](const auto& effect) { return effect.name == name && effect.is_on; });
}

Scene read_scene(const common::SceneFile& file) {
    Scene scene;
    scene.time = common::read_time(file);
    scene.accuracy = file.accuracy();
    scene.perturbation = file.perturbation();
    const Section section = file.section("cmps");
    bool is_sound = read_geometry(file, section, scene);
    const bool is_readable = scene.tank || !scene.bed.empty();
    double depth = is_readable ? -bottom_level(scene, scene.offshore) : 1.0;
    if (!scene.water.empty()) {
        double low = 1e300, high = -1e300;
        for (const Polygon& polygon : scene.water)
            for (const Point& p : polygon) low = std::min(low, p[1]), high = std::max(high, p[1]);
        depth = high - low;
    }
    if (depth <= 0) {
        section.problem(scene.tank ? "water" : "offshore",
                        "there is no water: the bed lies above z = 0 and no cmps.water is given");
        depth = 1.0;
    }
    read_numerics(file, section, scene, depth);
    read_drive(section, scene, depth);
    read_waves(file, section, scene, depth);
    read_output(file, section, scene);
    scene.gauges = common::read_gauges(file, 0.02);
    check_reach_of_gauges(file, scene);
    for (const common::Gauge& gauge : scene.gauges)
        if (std::min(scene.time.window, scene.time.end) / gauge.interval > most_gauge_samples)
            file.section("gauges").problem(
                gauge.name, fmt::format("interval {:g} s: more than {:.0e} records in a window",
                                        gauge.interval, most_gauge_samples));
    if (scene.drive == Drive::waves && scene.offshore < scene.onshore &&
        scene.offshore + scene.relaxation_length > scene.onshore && scene.boundary != Boundary::paper)
        section.problem("relaxation_length", "the relaxation zone is longer than the near field");
    check_tank_ends(section, scene);
    is_sound &= scene.settings.spacing > 1e-4 * depth && scene.settings.spacing < depth;
    is_sound &= check_distance_from_origin(section, scene);
    if (!is_sound) return scene;
    check_geometry(file, section, scene);
    return scene;
}

}  // namespace cmps
