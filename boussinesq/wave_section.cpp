#include "boussinesq/wave_section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "boussinesq/csv_table.hpp"
#include "boussinesq/waves/permanent_wave.hpp"
#include "boussinesq/waves/solitary_wave.hpp"
#include "common/errors.hpp"

namespace boussinesq {
namespace {

using common::Range;
using common::Section;
constexpr double two_pi = 2.0 * std::numbers::pi;

const std::vector<std::string> velocity_names{"u", "velocity", "u_m_s"};

/// Reads a table whose rows are ordered by their first column; notes a problem and returns an empty table on
/// a mistake.
CsvTable read_ordered(const Section& section, const std::filesystem::path& path,
                      const std::vector<std::string>& first, const std::vector<std::string>& second) {
    CsvTable table;
    try {
        table = read_csv(path);
    } catch (const common::InputError& error) {
        section.problem("file", error.what());
        return {};
    }
    for (const auto* aliases : {&first, &second, &velocity_names}) {
        std::vector<std::string> named;
        for (const auto& name : table.names)
            if (std::find(aliases->begin(), aliases->end(), name) != aliases->end()) named.push_back(name);
        if (named.size() < 2) continue;
        section.problem("file", fmt::format("{}: columns '{}' and '{}' are both {}", path.string(), named[0],
                                            named[1], aliases->front()));
        return {};
    }
    const auto* order = table.column(first);
    if (order == nullptr || table.column(second) == nullptr) {
        section.problem("file", fmt::format("{}: expected columns '{}' and '{}'", path.string(),
                                            first.front(), second.front()));
        return {};
    }
    for (std::size_t i = 1; i < order->size(); ++i)
        if ((*order)[i] <= (*order)[i - 1]) {
            section.problem("file", fmt::format("{}:{}: {} = {} after {}; it must increase", path.string(),
                                                table.lines[i], first.front(), (*order)[i], (*order)[i - 1]));
            return {};
        }
    if (order->size() < 4) {
        section.problem("file", fmt::format("{}: expected at least 4 rows", path.string()));
        return {};
    }
    return table;
}

/// Says what no record of incident waves holds: a level of its own, samples that miss the waves, waves that
/// would have broken, water faster than its waves. `mean`: of the elevation; `crossings`: of it, upward.
void check_record(const Section& section, const std::filesystem::path& path, const CsvTable& table,
                  const WaveSection& waves, double interval, double mean, int crossings) {
    const auto& time = waves.record.time;
    const auto& elevation = waves.record.elevation;
    const double fastest = std::sqrt(gravity * waves.depth);
    for (std::size_t i = 0; i < waves.record.velocity.size(); ++i)
        if (std::abs(waves.record.velocity[i]) > fastest) {
            section.problem("file",
                            fmt::format("{}:{}: u = {} m/s, but water outruns no wave: expected |u| up to "
                                        "sqrt(g d) = {:.3g} m/s",
                                        path.string(), table.lines[i], waves.record.velocity[i], fastest));
            return;
        }
    constexpr double fewest_samples = 8.0;  // a crest between two of them is 8 % too low
    if (waves.period < fewest_samples * interval) {
        section.problem("file",
                        fmt::format("{}: a sample every {:.3g} s of waves of {:.3g} s on average; expected "
                                    "at least {} samples a wave",
                                    path.string(), interval, waves.period, fewest_samples));
        return;
    }
    if (crossings < 3) return;  // a pulse: it has a mean, and no waves to measure
    // The set-down of steep waves is 1 % of their height, and a part of a wave left over adds 1 / (2 pi) of a
    // height over the number of waves; what is more is the zero of a gauge, and would pour water in for ever.
    const double largest_mean = waves.height * (0.02 + 1.0 / (two_pi * crossings));
    if (std::abs(mean) > largest_mean) {
        section.problem(
            "file",
            fmt::format("{}: eta has a mean of {:.3g} m, which would fill or drain the flume; expected "
                        "at most {:.2g} m: take the mean off",
                        path.string(), mean, largest_mean));
        return;
    }
    // Higher waves only: ripples across the mean are short. A fifth more than a regular wave can be, since
    // neighbours in a sea lend each other height.
    double begun = time.front(), crest = 0, trough = 0;
    std::size_t line = 0;
    bool is_whole = false;
    for (std::size_t i = 1; i < time.size(); ++i) {
        const double before = elevation[i - 1] - mean, now = elevation[i] - mean;
        if (before < 0.0 && now >= 0.0) {
            const double height = crest - trough, period = time[i] - begun;
            const double k = airy_wave_number(two_pi / std::max(period, 1e-9), waves.depth);
            const double limit = 1.2 * largest_wave_height(two_pi / k, waves.depth);
            if (is_whole && height > 0.5 * waves.height && height > limit) {
                section.problem(
                    "file",
                    fmt::format("{}:{}: a wave of {:.3g} m and {:.3g} s in {} m of water is too steep: "
                                "expected at most {:.3g} m",
                                path.string(), table.lines[line], height, period, waves.depth, limit));
                return;
            }
            is_whole = true;
            begun = time[i];
            line = i;
            crest = trough = 0.0;
        }
        crest = std::max(crest, now);
        trough = std::min(trough, now);
    }
}

/// Highest solitary wave over depth (Longuet-Higgins and Fenton 1974): no wave is higher.
constexpr double highest_solitary = 0.83;

void read_series(const Section& section, const Scene& scene, const LinearDispersion& dispersion,
                 WaveSection& waves) {
    for (const char* key : {"height", "period"})
        if (section.has(key)) {
            section.problem(key, "is taken from the record in waves.file: leave it out");
            section.number(key, "m or s", "of the record", Range::any(), 0.0);  // known, so named once
        }
    const auto path =
        section.file("file", "record of the incident wave (CSV: t, eta and optionally u)", true);
    if (path.empty()) return;
    const CsvTable table =
        read_ordered(section, path, {"t", "time", "t_s"}, {"eta", "surface_elevation", "eta_m"});
    if (table.lines.empty()) return;
    waves.record.time = *table.column({"t", "time", "t_s"});
    waves.record.elevation = *table.column({"eta", "surface_elevation", "eta_m"});
    if (const auto* u = table.column(velocity_names)) waves.record.velocity = *u;
    std::vector<double> intervals;
    for (std::size_t i = 1; i < waves.record.time.size(); ++i)
        intervals.push_back(waves.record.time[i] - waves.record.time[i - 1]);
    std::vector<double> sorted = intervals;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2),
                     sorted.end());
    const double usual = sorted[sorted.size() / 2];
    for (std::size_t i = 0; i < intervals.size(); ++i)
        if (intervals[i] > 4.0 * usual) {
            section.problem("file", fmt::format("{}:{}: gap of {:.4g} s in a record of every {:.4g} s",
                                                path.string(), table.lines[i + 1], intervals[i], usual));
            return;
        }
    if (waves.record.time.front() > scene.time.end)
        section.problem("file", fmt::format("{}: begins at t = {} s, after the end of the run", path.string(),
                                            waves.record.time.front()));
    const auto [lowest, highest] =
        std::minmax_element(waves.record.elevation.begin(), waves.record.elevation.end());
    waves.height = *highest - *lowest;
    if (!(waves.height > 0.0)) {
        section.problem("file", fmt::format("{}: eta never changes: no waves", path.string()));
        return;
    }
    if (waves.height > highest_solitary * waves.depth || -*lowest > highest_solitary * waves.depth) {
        section.problem("file", fmt::format("{}: eta runs from {:.4g} to {:.4g} m, more than waves in {} m "
                                            "of water can: at most {:.3g} m; is it in metres?",
                                            path.string(), *lowest, *highest, waves.depth,
                                            highest_solitary * waves.depth));
        waves.height = 0.1 * waves.depth;  // so that reading goes on
    }
    double mean = 0;
    for (const double value : waves.record.elevation)
        mean += value / static_cast<double>(waves.record.elevation.size());
    // Waves of the record: rises through its mean, each after a trough of a twentieth of the height, so that
    // noise in quiet parts counts for nothing.
    int crossings = 0;
    bool was_low = false;
    for (const double value : waves.record.elevation) {
        was_low = was_low || value - mean < -0.05 * waves.height;
        if (was_low && value >= mean) ++crossings, was_low = false;
    }
    const RecordPeriod measured = record_period(waves.record, dispersion, waves.depth);
    waves.period = measured.period;
    waves.share_left_out = measured.share_left_out;
    waves.record_note = fmt::format("waves of {:.3g} s (energy mean) come in from t = {:.6g} to {:.6g} s",
                                    measured.period, waves.record.time.front(), waves.record.time.back());
    if (measured.share_left_out > 0.001)
        waves.record_note += fmt::format(
            "; {:.2g} % of the variance lies above kh = 5, which the equations do not carry, and is left out",
            100.0 * measured.share_left_out);
    if (measured.share_left_out > 0.5) {
        section.problem(
            "file",
            fmt::format("{}: {:.0f} % of its variance in {} m of water lies above kh = 5, up to which "
                        "the equations hold: waves of less than {:.3g} s",
                        path.string(), 100.0 * measured.share_left_out, waves.depth,
                        two_pi / dispersion.angular_frequency(5.0 / waves.depth, waves.depth)));
        waves.period = 0;
        return;
    }
    for (std::size_t i = 0; i < intervals.size(); ++i)
        if (intervals[i] > 1.5 * usual && intervals[i] > 0.25 * waves.period) {
            section.problem(
                "file", fmt::format("{}:{}: gap of {:.4g} s in waves of {:.3g} s on average", path.string(),
                                    table.lines[i + 1], intervals[i], waves.period));
            return;
        }
    check_record(section, path, table, waves, usual, mean, crossings);
    const double begin = scene.bed.front()[0], end = scene.bed.back()[0];
    if (waves.position < begin || waves.position > end)
        section.problem("position",
                        fmt::format("x = {} m is outside the flume, {} to {} m", waves.position, begin, end));
    else if (std::abs(scene.still_depth(waves.position) - waves.depth) > 0.05 * waves.depth)
        section.problem(
            "position",
            fmt::format("the record is carried to the offshore end over a level bed of {} m; at x = "
                        "{} m the depth is {:.3g} m",
                        waves.depth, waves.position, scene.still_depth(waves.position)));
}

void read_initial(const common::SceneFile& file, const Scene& scene, WaveSection& waves) {
    const Section section = file.section("initial");
    const auto path = section.file("file", "state at t = 0 (CSV: x, eta and optionally u)", true);
    if (path.empty()) return;
    const CsvTable table = read_ordered(section, path, {"x", "x_m"}, {"eta", "surface_elevation", "eta_m"});
    if (table.lines.empty()) return;
    waves.initial_x = *table.column({"x", "x_m"});
    waves.initial_elevation = *table.column({"eta", "surface_elevation", "eta_m"});
    if (const auto* u = table.column(velocity_names)) waves.initial_velocity = *u;
    if (waves.initial_x.front() > scene.bed.front()[0] + 1e-9 ||
        waves.initial_x.back() < scene.bed.back()[0] - 1e-9)
        section.problem("file", fmt::format("{}: covers x = {} to {} m, the flume runs from {} to {} m",
                                            path.string(), waves.initial_x.front(), waves.initial_x.back(),
                                            scene.bed.front()[0], scene.bed.back()[0]));
    const auto [lowest, highest] =
        std::minmax_element(waves.initial_elevation.begin(), waves.initial_elevation.end());
    waves.height = std::max(*highest, 0.0) - std::min(*lowest, 0.0);
    double deepest = 0;
    for (const auto& point : scene.bed) deepest = std::max(deepest, -point[1]);
    bool has_water = false;
    const double fastest = 10.0 * std::sqrt(gravity * deepest);
    for (std::size_t i = 0; i < waves.initial_x.size(); ++i) {
        has_water = has_water || waves.initial_elevation[i] > -scene.still_depth(waves.initial_x[i]);
        const double u = waves.initial_velocity.empty() ? 0.0 : waves.initial_velocity[i];
        if (waves.initial_elevation[i] <= 10.0 * deepest && std::abs(u) <= fastest) continue;
        section.problem(
            "file",
            fmt::format("{}:{}: eta = {} m, u = {} m/s in a flume at most {} m deep; expected eta up to "
                        "{:.3g} m and |u| up to {:.3g} m/s",
                        path.string(), table.lines[i], waves.initial_elevation[i], u, deepest, 10.0 * deepest,
                        fastest));
        return;
    }
    if (!has_water)
        section.problem("file",
                        fmt::format("{}: eta lies below the bed everywhere: no water", path.string()));
}

/// A solitary wave stands over a level bed, but for its tail.
void check_place(const Section& section, const Scene& scene, const SolitaryWave& wave) {
    const WaveSection& waves = scene.waves;
    const double begin = scene.bed.front()[0], end = scene.bed.back()[0];
    // A body cut off by an end starts with a wall of water there; the end of a beach is dry.
    constexpr double tail = 0.01;
    const double reach = wave.reach(tail), first = begin + reach,
                 last = scene.bed.back()[1] < 0.0 ? end - reach : end;
    if (first <= last && (waves.position < begin || waves.position > end)) {
        section.problem("position",
                        fmt::format("x = {} m is outside the flume, {} to {} m", waves.position, begin, end));
        return;
    }
    if (first > last || waves.position < first - 1e-9 || waves.position > last + 1e-9) {
        section.problem(
            "position",
            first > last
                ? fmt::format(
                      "a solitary wave of {} m reaches {:.4g} m to both sides: a flume of {:.4g} m cuts "
                      "it off; expected at least {:.4g} m of flume",
                      waves.height, reach, end - begin, 2.0 * reach)
                : fmt::format(
                      "an end of the flume cuts off a solitary wave with its crest at x = {:.4g} m, which "
                      "reaches {:.4g} m to both sides; expected {:.4g} to {:.4g} m",
                      waves.position, reach, first, last));
        return;
    }
    constexpr int pieces = 1000;
    for (int i = 0; i <= pieces; ++i) {
        const double x = begin + (end - begin) * i / pieces, depth = scene.still_depth(x);
        if (wave.elevation(x - waves.position) < 0.1 * waves.height ||
            std::abs(depth - waves.depth) < 0.05 * waves.depth)
            continue;
        section.problem(
            "position",
            fmt::format("a solitary wave at {:.4g} m stands over an uneven bed: the depth at x = {:.4g} m is "
                        "{:.3g} m, at the offshore end {} m",
                        waves.position, x, depth, waves.depth));
        return;
    }
}

}  // namespace

void read_waves(const common::SceneFile& file, Scene& scene, const LinearDispersion& dispersion) {
    WaveSection& waves = scene.waves;
    const Section section = file.section("waves");
    waves.depth = -scene.bed.front()[1];
    const double flume_length = scene.bed.back()[0] - scene.bed.front()[0];
    const bool has_initial = file.has_section("initial");
    const std::string kind =
        section.choice("kind", "what comes in from offshore",
                       {"regular", "solitary", "jonswap", "bretschneider", "series", "none"},
                       has_initial ? std::optional<std::string>("none") : std::optional<std::string>());
    if (!has_initial && !section.has("kind") && !section.has("height") && !section.has("period"))
        return;  // said once; what else is wanted depends on it
    if (has_initial && kind != "none")
        section.problem("kind", "give either [waves] or [initial] file, not both");
    if (waves.depth <= 0.0) {
        file.section("flume").problem("bed", "the offshore end must lie below still water");
        waves.depth = 1.0;  // so that reading goes on
    }
    const Range heights = Range::positive();
    if (kind == "regular" || kind == "jonswap" || kind == "bretschneider") {
        const bool regular = kind == "regular";
        waves.kind = regular ? WaveKind::regular : WaveKind::irregular;
        waves.height = section.number(
            "height", "m",
            regular ? "wave height H in the depth of the offshore end"
                    : "significant wave height H_s = H_m0 = 4 sqrt(m0) in the depth of the offshore end",
            heights);
        waves.period = section.number("period", "s",
                                      kind == "bretschneider" ? "significant wave period T_1/3"
                                      : regular               ? "wave period"
                                                              : "peak period",
                                      Range::positive());
        waves.ramp = section.number("ramp", "s", "time over which the amplitude rises", Range::not_negative(),
                                    2.0 * waves.period);
        waves.position = section.number("position", "m", "where the phase is counted from", Range::any(),
                                        scene.bed.front()[0]);
        if (!regular) {
            waves.sea.spectrum = kind == "jonswap" ? Spectrum::jonswap : Spectrum::bretschneider_mitsuyasu;
            if (kind == "jonswap")
                waves.sea.peak_enhancement = section.number(
                    "peak_enhancement", "-", "gamma of the JONSWAP spectrum", Range::between(1, 20), 3.3);
            if (kind == "bretschneider") waves.period *= 1.05;  // peak period from T_1/3 (Goda 2010)
            waves.sea.seed = static_cast<std::uint64_t>(
                section.integer("seed", "of frequencies and phases", Range::not_negative(), 1));
            waves.sea.components = static_cast<std::size_t>(
                section.integer("components", "of the sum of waves", Range::between(10, 5000), 200));
            waves.has_bound_waves =
                section.choice("bound_waves",
                               "long waves under groups and sharper crests that come with the sea",
                               {"second_order", "none"}, "second_order") == "second_order";
            waves.sea.significant_height = waves.height;
            waves.sea.peak_period = waves.period;
        }
        const double w = two_pi / waves.period;
        const double exact = airy_wave_number(w, waves.depth),
                     carried = dispersion.wave_number(w, waves.depth);
        waves.length = two_pi / (std::isfinite(carried) ? carried : exact);
        if (exact * waves.depth > 5.0 || !std::isfinite(carried))
            section.problem("period", fmt::format("{} s in {} m of water is kh = {:.2g}; the equations hold "
                                                  "up to about 5: expected a period of at least {:.3g} s",
                                                  waves.period, waves.depth, exact * waves.depth,
                                                  two_pi / std::sqrt(gravity * 5.0 / waves.depth)));
        const double limit = largest_wave_height(two_pi / exact, waves.depth);
        if (exact * waves.depth > 5.0 || !std::isfinite(carried)) {
            waves.length = waves.period = 0;  // so that nothing else follows from it
            return;
        }
        if (waves.height < 1e-6 * waves.depth)
            section.problem("height", fmt::format("{} m is less than a millionth of the depth, {:.3g} m",
                                                  waves.height, 1e-6 * waves.depth));
        else if (waves.height > (regular ? 1.0 : 0.5) * limit)
            section.problem(
                "height",
                fmt::format("{} m is higher than a {} of {} s can be in {} m of water: at most {:.3g} m",
                            waves.height, regular ? "wave" : "sea state", waves.period, waves.depth,
                            (regular ? 1.0 : 0.5) * limit));
        else if (regular && dispersion.is_dispersive && waves.length < 2.0 * flume_length)
            try {
                permanent_form(dispersion.alpha, waves.height, waves.period, waves.depth);
            } catch (const common::InputError& error) {
                section.problem("height", error.what());
            }
    } else if (kind == "solitary") {
        waves.kind = WaveKind::solitary;
        waves.height =
            section.number("height", "m", "height H of the solitary wave over still water", heights);
        if (waves.height > highest_solitary * waves.depth) {
            section.problem(
                "height",
                fmt::format("{} m is higher than a solitary wave can be in {} m of water: at most {:.3g} m",
                            waves.height, waves.depth, highest_solitary * waves.depth));
            waves.height = 0.5 * waves.depth;
        }
        const SolitaryWave wave(dispersion.is_dispersive ? dispersion.alpha : 1.0, waves.height, waves.depth,
                                0.0);
        waves.length = 2.0 * wave.reach(1e-3);
        waves.crest_rate = std::acosh(std::sqrt(2.0)) / wave.reach(0.5) * wave.speed();
        waves.position = section.number("position", "m", "of the crest at t = 0", Range::any(),
                                        scene.bed.front()[0] + wave.reach(1e-3));
        check_place(section, scene, wave);
    } else if (kind == "series") {
        waves.kind = WaveKind::series;
        waves.position =
            section.number("position", "m", "where the record was taken", Range::any(), scene.bed.front()[0]);
        waves.ramp =
            section.number("ramp", "s", "time over which the amplitude rises", Range::not_negative(), 0.0);
        read_series(section, scene, dispersion, waves);
        if (waves.period > 0)
            waves.length = two_pi / dispersion.wave_number(two_pi / waves.period, waves.depth);
    } else if (has_initial) {
        read_initial(file, scene, waves);
    }
}

}  // namespace boussinesq
