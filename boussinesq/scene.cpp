#include "boussinesq/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "boussinesq/output_sampling.hpp"
#include "boussinesq/wave_section.hpp"
#include "boussinesq/waves/bound_waves.hpp"
#include "boussinesq/waves/wave_theory.hpp"
#include "common/errors.hpp"

namespace boussinesq {
namespace {

using common::Range;
using common::Section;
constexpr double two_pi = 2.0 * std::numbers::pi;

EndKind read_end(const Section& section, const std::string& key, const std::string& about,
                 const std::string& fallback) {
    const std::string word = section.choice(key, about, {"absorbing", "wall", "open"}, fallback);
    return word == "absorbing" ? EndKind::absorbing : word == "wall" ? EndKind::wall : EndKind::open;
}

void read_grid_and_ends(const common::SceneFile& file, common::Accuracy accuracy, Scene& scene) {
    const Section section = file.section("boussinesq");
    const Section flume = file.section("flume");
    const double begin = scene.bed.front()[0], length = scene.bed.back()[0] - begin;
    const WaveSection& waves = scene.waves;

    // Cells per wave length where the wave is made, from the measured cost curve (README).
    const double cells_per_length = accuracy == common::Accuracy::draft      ? 40
                                    : accuracy == common::Accuracy::standard ? 75
                                                                             : 150;
    double scale = waves.length > 0 ? waves.length : 5.0 * std::max(waves.depth, 0.01 * length);
    // Crests of long waves are those of solitary ones: twice their width, 2 / K, counts as the length.
    if (waves.kind == WaveKind::regular && waves.length > 0)
        scale = std::min(scale, 4.0 * std::sqrt(4.0 * waves.depth * waves.depth *
                                                (waves.depth + waves.height) / (3.0 * waves.height)));
    const double proposed = std::min(scale / cells_per_length, length / 20.0);
    const double wish = section.number("spacing", "m", "cell size (rounded so that cells fill the flume)",
                                       Range::positive(), proposed);
    const double cells = std::round(length / wish);
    if (cells < 8 || cells > 5e7)
        section.problem("spacing",
                        fmt::format("gives {:.3g} cells over {} m; expected 8 to 5e7", cells, length));
    scene.grid = {.offshore_end = begin,
                  .spacing = length / std::clamp(cells, 8.0, 5e7),
                  .cells = static_cast<std::size_t>(std::clamp(cells, 8.0, 5e7))};
    // Sixty samples a (peak) wave are thirty at twice its frequency; a crest counts as a wave.
    constexpr double samples_a_wave = 60.0;
    const double shortest_known = waves.period > 0       ? waves.period
                                  : waves.crest_rate > 0 ? two_pi / waves.crest_rate
                                                         : 0.0;
    scene.output_interval = section.number(
        "output_interval", "s", "between samples in a window; default: 60 a wave", Range::at_least(1e-6),
        shortest_known > 0 ? shortest_known / samples_a_wave : std::min(0.05, scene.time.window));
    // A window is built in memory: 16 bytes a value.
    const double samples = std::min(scene.time.window, scene.time.end) / scene.output_interval;
    constexpr double largest_window = 4e9;
    if (cells <= 5e7 && 16.0 * samples * cells > largest_window)
        section.problem(
            "output_interval",
            fmt::format("of {} s gives {:.3g} samples of {:.3g} cells in a window of {} s, {:.3g} GB; "
                        "expected at most {:.3g} GB a window",
                        scene.output_interval, samples, cells, scene.time.window, 16e-9 * samples * cells,
                        1e-9 * largest_window));
    constexpr double largest_run = 1e12;  // bytes on disk, 8 a value pair before compression
    const double all_samples = scene.time.end / scene.output_interval;
    if (cells <= 5e7 && 8.0 * all_samples * cells > largest_run)
        section.problem(
            "output_interval",
            fmt::format("of {} s gives {:.3g} samples of {:.3g} cells in a run of {} s, {:.3g} GB "
                        "on disk; expected at most {:.3g} GB, an interval of {:.2g} s and more",
                        scene.output_interval, all_samples, cells, scene.time.end, 8e-9 * all_samples * cells,
                        1e-9 * largest_run, 1.05 * 8.0 * scene.time.end * cells / largest_run));
    constexpr double most_windows = 1e6;
    if (scene.time.end / scene.time.window > most_windows)
        file.section("time").problem(
            "window",
            fmt::format("of {} s makes {:.3g} windows of a run of {} s; expected at most {:.0e}",
                        scene.time.window, scene.time.end / scene.time.window, scene.time.end, most_windows));

    const bool periodic = waves.kind == WaveKind::regular || waves.kind == WaveKind::irregular ||
                          waves.kind == WaveKind::series;
    const bool beach = scene.bed.back()[1] >= 0.0;
    scene.offshore = read_end(section, "offshore", "what the offshore end does with waves that reach it",
                              periodic ? "absorbing" : "open");
    scene.shoreward = read_end(section, "shoreward", "what the shoreward end does with waves that reach it",
                               beach      ? "wall"
                               : periodic ? "absorbing"
                                          : "open");
    if (beach && scene.shoreward != EndKind::wall) {
        section.problem("shoreward",
                        "the bed ends above still water: the waves end on the beach, expected \"wall\"");
    }
    scene.flow.offshore = scene.offshore == EndKind::open ? End::open : End::wall;
    scene.flow.shoreward = scene.shoreward == EndKind::open ? End::open : End::wall;

    const double local = waves.period > 0 && !beach
                             ? two_pi / airy_wave_number(two_pi / waves.period, -scene.bed.back()[1])
                             : waves.length;
    if (periodic) {
        if (scene.offshore != EndKind::absorbing)
            section.problem("offshore", "waves are made at the offshore end: expected \"absorbing\"");
        scene.generation_length = section.number(
            "generation_length", "m", "zone at the offshore end that makes waves and takes them in",
            Range::positive(), std::min(2.0 * waves.length, 0.4 * length));
        const double end = begin + scene.generation_length;
        double lowest = scene.bed.front()[1], highest = lowest;
        for (const auto& point : scene.bed)
            if (point[0] <= end) lowest = std::min(lowest, point[1]), highest = std::max(highest, point[1]);
        highest = std::max(highest, common::bed_level(scene.bed, end));
        lowest = std::min(lowest, common::bed_level(scene.bed, end));
        if (scene.generation_length < waves.length && !section.has("generation_length"))
            flume.problem("bed",
                          fmt::format("is too short: {:.4g} m of flume leave {:.3g} m to make waves of "
                                      "{:.3g} m length in; expected at least {:.3g} m of flume",
                                      length, scene.generation_length, waves.length, 2.5 * waves.length));
        else if (scene.generation_length < 0.5 * waves.length)
            section.problem("generation_length",
                            fmt::format("{} m is too short to make waves of {:.3g} m length in; expected at "
                                        "least half a length",
                                        scene.generation_length, waves.length));
        else if (highest - lowest > 0.05 * waves.depth)
            flume.problem(
                "bed", fmt::format("must be level where waves are made, x = {:.4g} to {:.4g} m: it varies by "
                                   "{:.3g} m; lengthen the offshore end or set boussinesq.generation_length",
                                   begin, end, highest - lowest));
    } else if (scene.offshore == EndKind::absorbing) {
        scene.offshore_sponge =
            section.number("offshore_sponge", "m", "length of the absorbing zone", Range::positive(),
                           std::min(waves.length > 0 ? waves.length : 0.1 * length, 0.25 * length));
    }
    if (scene.shoreward == EndKind::absorbing)
        scene.shoreward_sponge =
            section.number("shoreward_sponge", "m", "length of the absorbing zone", Range::positive(),
                           std::min(local > 0 ? 2.5 * local : 0.1 * length, 0.3 * length));
    if (scene.shoreward_sponge > 0 && local > 0 && scene.shoreward_sponge < 2.49 * local)
        scene.sponge_note = fmt::format(
            "the shoreward sponge is {:.3g} m, {:.2g} wave lengths, and sends part of the waves back: it "
            "should have "
            "2.5 lengths, {:.3g} m{}",
            scene.shoreward_sponge, scene.shoreward_sponge / local, 2.5 * local,
            section.has("shoreward_sponge") ? "" : "; it is cut to three tenths of the flume");
    if (scene.generation_length + scene.offshore_sponge + scene.shoreward_sponge > 0.95 * length)
        flume.problem(
            "bed",
            fmt::format("{:.4g} m of flume is too short for the zones that make and absorb waves ({:.4g} m)",
                        length, scene.generation_length + scene.offshore_sponge + scene.shoreward_sponge));
}

/// What [effects] says of each; read once, so that a mistake is reported once.
struct EffectWishes {
    common::EffectWish dispersion, breaking, shoreline, friction;
};
EffectWishes read_wishes(const common::SceneFile& file) {
    return {.dispersion = common::read_effect_wish(file, "dispersion"),
            .breaking = common::read_effect_wish(file, "breaking"),
            .shoreline = common::read_effect_wish(file, "shoreline"),
            .friction = common::read_effect_wish(file, "friction")};
}

/// Second order holds where a wave of the significant height has a second harmonic well below its first.
void decide_bound_waves(Scene& scene) {
    WaveSection& waves = scene.waves;
    if (waves.kind != WaveKind::irregular || waves.length <= 0) return;
    if (!waves.has_bound_waves) {
        waves.bound_waves_reason = "left out: waves.bound_waves is \"none\"";
    } else if (!scene.terms.dispersion) {
        waves.has_bound_waves = false;
        waves.bound_waves_reason = "left out: without dispersion all waves are free";
    } else {
        constexpr double largest = 0.3;
        const double k = two_pi / waves.length;
        const double ratio =
            0.5 * waves.height * bound_pair({.alpha = scene.flow.alpha}, waves.depth, k, k, 1).elevation;
        waves.has_bound_waves = ratio < largest;
        waves.bound_waves_reason =
            fmt::format("second harmonic of a significant wave {:.2g} of its first, {} {}: {}", ratio,
                        waves.has_bound_waves ? "<" : ">=", largest,
                        waves.has_bound_waves ? "second order" : "left out, second order does not hold");
    }
}

void decide_effects(const common::SceneFile& file, const EffectWishes& wishes, common::Accuracy accuracy,
                    Scene& scene) {
    const WaveSection& waves = scene.waves;
    Expectation& expected = scene.expectation;
    expected.bed = scene.bed;
    expected.height = waves.kind == WaveKind::irregular ? 1.8 * waves.height : waves.height;
    expected.period =
        waves.kind == WaveKind::regular || waves.kind == WaveKind::irregular ? waves.period : 0.0;
    expected.shortest_period = waves.kind == WaveKind::irregular ? 0.5 * waves.period : expected.period;
    expected.generator_depth = waves.depth;
    expected.reflects = scene.shoreward == EndKind::wall && scene.bed.back()[1] < 0.0;
    expected.phase_tolerance = accuracy == common::Accuracy::draft      ? 0.05
                               : accuracy == common::Accuracy::standard ? 0.02
                                                                        : 0.01;
    expected.friction = scene.friction;
    const auto decide = [&](const std::string& name, common::EffectWish wish, const Verdict& verdict) {
        const bool on =
            wish == common::EffectWish::automatic ? verdict.is_on : wish == common::EffectWish::on;
        scene.effects.push_back({.name = name,
                                 .is_on = on,
                                 .reason = wish == common::EffectWish::automatic
                                               ? verdict.reason
                                               : fmt::format("asked for in [effects] (auto: {}, {})",
                                                             verdict.is_on ? "on" : "off", verdict.reason)});
        return on;
    };
    scene.terms.dispersion = decide("dispersion", wishes.dispersion, needs_dispersion(expected));
    expected.is_dispersive = scene.terms.dispersion;
    decide_bound_waves(scene);
    scene.has_breaking = decide("breaking", wishes.breaking, needs_breaking(expected));
    scene.terms.shoreline = decide("shoreline", wishes.shoreline, needs_shoreline(expected));
    scene.shoreline_is_automatic = wishes.shoreline == common::EffectWish::automatic;
    scene.breaking_is_automatic = wishes.breaking == common::EffectWish::automatic;
    for (const auto& point : scene.bed)
        if (!scene.terms.shoreline && !scene.shoreline_is_automatic && point[1] >= 0.0) {
            file.section("effects").problem(
                "shoreline",
                fmt::format("is \"off\", but the bed reaches still water at x = {} m", point[0]));
            break;
        }
    scene.has_friction = decide("friction", wishes.friction, needs_friction(expected));
    if (scene.has_friction && scene.friction <= 0)
        file.section("effects").problem("friction", "is on, but boussinesq.friction gives no coefficient");
}

}  // namespace

Scene read_scene(const common::SceneFile& file) {
    Scene scene{};
    file.root().text("title", "of the scene", "");
    scene.time = common::read_time(file);
    scene.perturbation = file.perturbation();
    scene.bed = common::read_bed(file, true);
    if (scene.bed.size() < 2 || scene.bed.back()[0] <= scene.bed.front()[0]) {
        file.finish();
        throw common::InputError("flume.bed: expected at least two points");
    }
    const common::Accuracy accuracy = file.accuracy();  // read once: a mistake is said once
    const Section section = file.section("boussinesq");
    scene.flow.alpha = section.number("alpha", "-", "dispersion constant; 1: classical Serre-Green-Naghdi",
                                      Range::between(1, 1.5), 1.153);
    scene.friction =
        section.number("friction", "- or s/m^(1/3)", "bed friction coefficient", Range::between(0, 10), 0.0);
    scene.friction_is_manning = section.choice("friction_law", "what boussinesq.friction is",
                                               {"quadratic", "manning"}, "quadratic") == "manning";
    const std::string breaking =
        section.choice("breaking", "how a breaking front loses energy",
                       {"viscous_bore", "eddy_viscosity", "hydrostatic"}, "viscous_bore");
    scene.breaks_as_bores = breaking == "hydrostatic";
    scene.breaking.becomes_bore = breaking == "viscous_bore";
    if (scene.breaks_as_bores)
        for (const char* key : {"breaking_start", "breaking_end", "breaking_mixing"})
            if (section.has(key)) section.problem(key, "has no effect with breaking = \"hydrostatic\"");
    scene.breaking.start =
        section.number("breaking_start", "-", "eta_t / sqrt(g h) at which a front begins to break",
                       Range::between(0.1, 2), scene.breaking.start);
    scene.breaking.end =
        section.number("breaking_end", "-", "eta_t / sqrt(g h) below which an old front stops breaking",
                       Range::between(0.01, 1), scene.breaking.end);
    if (scene.breaking.end > scene.breaking.start)
        section.problem(
            "breaking_end",
            fmt::format("{} is above breaking_start, {}: a front would stop breaking before it begins",
                        scene.breaking.end, scene.breaking.start));
    scene.breaking.mixing =
        section.number("breaking_mixing", "-", "mixing length of a breaking front over depth",
                       Range::between(0.1, 10), scene.breaking.mixing);
    const EffectWishes wishes = read_wishes(file);
    const LinearDispersion dispersion{.alpha = scene.flow.alpha,
                                      .is_dispersive = wishes.dispersion != common::EffectWish::off};
    read_waves(file, scene, dispersion);
    read_grid_and_ends(file, accuracy, scene);
    scene.gauges = common::read_gauges(file, scene.output_interval);
    for (const auto& gauge : scene.gauges) {
        if (gauge.kind == common::Gauge::Kind::surface &&
            (gauge.x < scene.bed.front()[0] || gauge.x > scene.bed.back()[0]))
            file.section("gauges").problem(gauge.name,
                                           fmt::format("x = {} m is outside the flume, {} to {} m", gauge.x,
                                                       scene.bed.front()[0], scene.bed.back()[0]));
        constexpr double most_samples = 1e7;  // kept in memory: 40 bytes each
        if (gauge.kind == common::Gauge::Kind::surface && scene.time.end / gauge.interval > most_samples &&
            !(gauge.interval == scene.output_interval && file.has_problems()))
            file.section("gauges").problem(
                gauge.name,
                fmt::format("interval of {} s gives {:.3g} samples in {} s; expected at most {:.0e}",
                            gauge.interval, scene.time.end / gauge.interval, scene.time.end, most_samples));
    }
    decide_effects(file, wishes, accuracy, scene);
    if (!file.has_problems()) check_output_sampling(file, accuracy, scene);
    scene.flow.spacing = scene.grid.spacing;
    // The cost study finds no more error at 0.8 than at 0.5; beside dry cells half a cell a step keeps depths
    // positive.
    scene.courant = section.number("courant", "-", "step over the time a long wave takes through a cell",
                                   Range{.lowest = 0, .highest = 1, .lowest_is_open = true},
                                   scene.terms.shoreline ? 0.5 : 0.8);
    const double depth = std::max(1e-3, scene.waves.depth);
    scene.flow.dry_depth =
        section.number("dry_depth", "m", "water thinner than this counts as dry",
                       Range{.lowest = 0, .highest = 0.01 * depth, .lowest_is_open = true}, 1e-4 * depth);
    scene.flow.elevation_scale = 1e-2 * depth;
    scene.flow.discharge_scale = 1e-2 * depth * std::sqrt(gravity * depth);
    file.finish();
    return scene;
}

}  // namespace boussinesq
