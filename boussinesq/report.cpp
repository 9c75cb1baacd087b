#include "boussinesq/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "boussinesq/effects/breaking.hpp"
#include "boussinesq/effects/relaxation_zone.hpp"
#include "boussinesq/wave_statistics.hpp"

namespace boussinesq {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;
/// Waves at the end of a run that the envelope and the statistics of regular waves cover.
constexpr double last_waves = 10.0;

/// First time at which the envelope is taken, s: the last waves, or all of a run without a period.
double envelope_begin(const Scene& scene) {
    return scene.waves.period > 0 ? std::max(scene.time.end - last_waves * scene.waves.period, 0.0) : 0.0;
}

/// When the waves at x are in full swing: travel at group speed, then the ramp.
double settled_time(const Scene& scene, double x) {
    if (scene.waves.period <= 0) return 0.0;
    const double w = two_pi / scene.waves.period;
    double time = scene.waves.ramp;
    constexpr int pieces = 200;
    const double begin = scene.bed.front()[0], piece = (x - begin) / pieces;
    for (int i = 0; i < pieces; ++i) {
        const double depth = std::max(scene.still_depth(begin + (i + 0.5) * piece), 0.02 * scene.waves.depth);
        time += piece / airy_group_speed(airy_wave_number(w, depth), depth);
    }
    return time + 2.0 * scene.waves.period;
}

/// More than this much energy over the flume came from nowhere, m4/s2 (over the density): what was there at
/// the start, and a third for the vertical motion of waves of kh = 3, which is counted as in the classical
/// equations; and incident waves that are reflected whole, g H^2 / 4 over every metre, four times as high
/// for what shoaling, groups and basins that resonate gather.
double largest_energy_expected(const Scene& scene, double at_start) {
    const double length = scene.grid.shoreward_end() - scene.grid.offshore_end;
    const bool comes_in = scene.waves.kind != WaveKind::none && scene.waves.kind != WaveKind::solitary;
    return 4.0 / 3.0 * at_start +
           (comes_in ? 4.0 * gravity * scene.waves.height * scene.waves.height * length : 0.0) +
           1e-12 * gravity * scene.waves.depth * scene.waves.depth * length;  // rounding of still water
}

}  // namespace

std::vector<GaugeRecord> gauges_of(const Scene& scene) {
    std::vector<GaugeRecord> records;
    for (const auto& gauge : scene.gauges) {
        if (gauge.kind != common::Gauge::Kind::surface) continue;
        GaugeRecord record{.name = gauge.name,
                           .x = gauge.x,
                           .interval = gauge.interval,
                           .array = {gauge.x, gauge.x},
                           .time = {},
                           .elevation = {},
                           .velocity = {},
                           .second_elevation = {},
                           .third_elevation = {}};
        const double depth = scene.still_depth(gauge.x);
        if (scene.waves.period > 0 && depth > 0) {
            const double length = two_pi / airy_wave_number(two_pi / scene.waves.period, depth);
            for (const double way : {1.0, -1.0}) {
                const double second = gauge.x + way * 0.1 * length, third = gauge.x + way * 0.25 * length;
                const bool inside = std::min(third, gauge.x) > scene.bed.front()[0] &&
                                    std::max(third, gauge.x) < scene.bed.back()[0];
                const bool level = std::abs(scene.still_depth(third) - depth) < 0.05 * depth &&
                                   std::abs(scene.still_depth(second) - depth) < 0.05 * depth;
                if (inside && level && !record.has_array()) record.array = {second, third};
            }
        }
        records.push_back(std::move(record));
    }
    return records;
}

common::DataFile geometry_of(const Scene& scene, const Simulation& simulation) {
    const Grid& grid = simulation.grid();
    std::vector<double> x(grid.cells), bed(grid.cells);
    for (std::size_t i = 0; i < grid.cells; ++i) {
        x[i] = grid.centre(i);
        bed[i] = simulation.bed().level(i + ghost_cells);
    }
    std::vector<double> polyline;
    for (const auto& point : scene.bed) polyline.insert(polyline.end(), point.begin(), point.end());
    common::DataFile file;
    file.datasets["/x"] = common::real64("m", {grid.cells}, std::move(x));
    file.datasets["/bed_level"] = common::real64("m", {grid.cells}, std::move(bed));
    file.datasets["/bed_polyline"] = common::real64("m", {scene.bed.size(), 2}, std::move(polyline));
    return file;
}

Report::Report(const std::filesystem::path& folder, const common::SceneFile& file, const Scene& scene,
               const Simulation& simulation)
    : scene_(scene),
      simulation_(simulation),
      folder_(folder),
      record_(folder, "boussinesq"),
      envelope_(scene.grid, envelope_begin(scene)),
      waterline_(scene.grid, 2e-3 * scene.waves.depth),
      water_at_start_(simulation.water()),
      energy_at_start_(simulation.energy()),
      largest_energy_(energy_at_start_) {
    std::filesystem::remove(folder / "envelope.h5");
    record_.describe_scene(file);
    record_.set_digests(file.digest(), "");
    record_.set_effects(scene.effects);
    if (scene.waves.length > 0 && scene.waves.period > 0) {
        record_.set_figure("waves.length", scene.waves.length);
        if (scene.waves.kind == WaveKind::regular)
            record_.set_note("waves.form",
                             ursell_number(scene.waves.height, scene.waves.length, scene.waves.depth) < 26.0
                                 ? "permanent form of the equations solved, in the range of Stokes waves "
                                   "(Ursell number below 26)"
                                 : "permanent form of the equations solved, in the range of cnoidal waves "
                                   "(Ursell number above 26)");
        if (!scene.waves.bound_waves_reason.empty())
            record_.set_note("waves.bound", scene.waves.bound_waves_reason);
        record_.set_figure("waves.ursell",
                           ursell_number(scene.waves.height, scene.waves.length, scene.waves.depth));
    }
    if (!scene.waves.record_note.empty()) record_.set_note("waves.record", scene.waves.record_note);
    if (!scene.sponge_note.empty()) record_.set_note("shoreward_sponge", scene.sponge_note);
    if (!scene.sampling_note.empty()) record_.set_note("output_interval", scene.sampling_note);
    record_.write_running();
}

void Report::look() {
    envelope_.look(simulation_);
    if (simulation_.flow().terms().shoreline) waterline_.look(simulation_);
}

void Report::note(const EffectChange& change) {
    notes_.push_back(change.message);
    if (!change.effect.empty()) switched_on_ += (switched_on_.empty() ? "" : " ") + change.effect;
    record_changes();
}

void Report::record_changes() {
    for (std::size_t i = 0; i < notes_.size(); ++i)
        record_.set_note(fmt::format("effect_watch.{}", i), notes_[i]);
    std::vector<common::EffectRecord> effects = scene_.effects;
    for (auto& effect : effects)
        if (switched_on_.find(effect.name) != std::string::npos) {
            effect.is_on = true;
            effect.reason += "; switched on while running (notes.effect_watch)";
        }
    record_.set_effects(effects);
}

void Report::fill_figures() {
    const double cells = static_cast<double>(simulation_.grid().cells);
    const double here = static_cast<double>(simulation_.steps() - first_step_);
    record_.set_figure("cells", cells);
    record_.set_figure("spacing", simulation_.grid().spacing);
    record_.set_figure("steps", static_cast<double>(simulation_.steps()));
    double seconds = simulation_.times().flow;
    for (const double effect : simulation_.times().effects) seconds += effect;
    if (here > 0) {
        record_.set_figure("nanoseconds_per_cell_step", 1e9 * seconds / (cells * here));
        record_.set_figure("compute_seconds", seconds);
    }
    for (const auto& effect : simulation_.effects()) {
        const BreakingRecord* breaking = nullptr;
        if (const auto* viscosity = dynamic_cast<const EddyViscosity*>(effect.get()))
            breaking = &viscosity->record();
        if (const auto* bores = dynamic_cast<const HydrostaticBores*>(effect.get()))
            breaking = &bores->record();
        if (breaking == nullptr || breaking->first_time < 0) continue;
        record_.set_figure("breaking.first_time", breaking->first_time);
        record_.set_figure("breaking.first_place", breaking->first_place);
        record_.set_figure("breaking.most_offshore", breaking->most_offshore);
    }
    if (waterline_.has_beach()) {
        record_.set_figure("run_up.level", waterline_.run_up);
        record_.set_figure("run_up.time", waterline_.run_up_time);
        record_.set_figure("run_up.x", waterline_.farthest);
        record_.set_figure("run_down.level", waterline_.run_down);
        record_.set_figure("run_down.time", waterline_.run_down_time);
    }
}

void Report::fill_invariants() {
    double added = 0;
    for (const auto& effect : simulation_.effects())
        if (const auto* zone = dynamic_cast<const GenerationZone*>(effect.get()))
            added += zone->water_added();
    const double made = simulation_.flow().water_made(),
                 through_ends = simulation_.flow().water_through_ends();
    record_.set_figure("water.added_by_generation", added);
    record_.set_figure("water.through_ends", through_ends);
    // Sums of 1e3 to 1e6 cells over 1e4 steps round at 1e-12; a lost flux would show at 1e-6.
    record_.set_invariant(
        {.name = "water balance",
         .value = (simulation_.water() - water_at_start_ - added - made - through_ends) / water_at_start_,
         .unit = "-",
         .bound = 1e-9});
    record_.set_invariant(
        {.name = "water made by rounding", .value = made / water_at_start_, .unit = "-", .bound = 1e-9});
    record_.set_invariant({.name = "largest Courant number",
                           .value = simulation_.largest_courant(),
                           .unit = "-",
                           .bound = 1.0 + 1e-9});
    const double energy = simulation_.energy();
    record_.set_figure("energy.at_start", energy_at_start_);
    record_.set_figure("energy.largest", largest_energy_);
    record_.set_figure("energy.at_end", energy);
    record_.set_invariant({.name = "energy over what may come in",
                           .value = largest_energy_ / largest_energy_expected(scene_, energy_at_start_),
                           .unit = "-",
                           .bound = 1.0});
}

void Report::fill_statistics(const std::vector<GaugeRecord>& gauges) {
    const LinearDispersion dispersion{.alpha = scene_.flow.alpha, .is_dispersive = scene_.terms.dispersion};
    const double period = scene_.waves.period;
    for (const GaugeRecord& gauge : gauges) {
        if (gauge.time.size() < 8) continue;
        const std::string key = fmt::format("gauges.\"{}\".", gauge.name);
        constexpr double least_samples = 10.0;  // a wave; fewer miss its crest by more than 5 % of its height
        if (period > 0 && period < least_samples * gauge.interval) {
            record_.set_note(key + "statistics",
                             fmt::format("none: {:.3g} samples a wave, expected at least {:.0f}; set the "
                                         "gauge's interval to {:.3g} s or less",
                                         period / gauge.interval, least_samples, period / least_samples));
            continue;
        }
        double begin = settled_time(scene_, gauge.x);
        double end = gauge.time.back();
        if (scene_.waves.kind == WaveKind::regular && end > begin) {
            // Whole periods, so that mean and spectrum are clean.
            const double whole = std::min(std::floor((end - begin) / period), last_waves);
            begin = end - std::max(whole, 1.0) * period;
        }
        if (end - begin < 2.0 * period || begin < gauge.time.front()) begin = gauge.time.front();
        const auto from = static_cast<std::size_t>(
            std::lower_bound(gauge.time.begin(), gauge.time.end(), begin - 1e-9) - gauge.time.begin());
        const std::size_t count = gauge.time.size() - from;
        const auto part = [&](const std::vector<double>& values) {
            return std::span<const double>(values).subspan(from, count);
        };
        const WaveStatistics statistics = wave_statistics(part(gauge.time), part(gauge.elevation));
        record_.set_figure(key + "begin", gauge.time[from]);
        record_.set_figure(key + "waves", static_cast<double>(statistics.waves));
        record_.set_figure(key + "significant_height", statistics.significant_height);
        record_.set_figure(key + "largest_height", statistics.largest_height);
        record_.set_figure(key + "mean_height", statistics.mean_height);
        record_.set_figure(key + "significant_period", statistics.significant_period);
        record_.set_figure(key + "mean_period", statistics.mean_period);
        const WetLevel wet = level_while_wet(part(gauge.time), part(gauge.elevation),
                                             -scene_.still_depth(gauge.x) + 10.0 * scene_.flow.dry_depth);
        record_.set_figure(key + "wet_share", wet.share);
        if (wet.share > 0) record_.set_figure(key + "set_up", wet.mean);
        record_.set_figure(key + "spectral_height", 4.0 * statistics.root_mean_square);
        record_.set_figure(key + "highest", statistics.highest);
        record_.set_figure(key + "lowest", statistics.lowest);
        if (!gauge.has_array() || statistics.waves < 2) continue;
        const double length = gauge.time.back() - gauge.time[from], step = two_pi / length;
        std::vector<double> frequencies;
        if (scene_.waves.kind == WaveKind::regular) {
            frequencies = {two_pi / period};
        } else {
            const double low = 0.5 * two_pi / period, high = 2.0 * two_pi / period;
            const double stride =
                std::max(1.0, std::round((high - low) / step / 128.0)) * step;  // at most 128 lines
            for (double w = std::ceil(low / step) * step; w <= high; w += stride) frequencies.push_back(w);
        }
        const Reflection reflection = reflection_of(
            part(gauge.time),
            {part(gauge.elevation), part(gauge.second_elevation), part(gauge.third_elevation)},
            {gauge.x, gauge.array[0], gauge.array[1]}, scene_.still_depth(gauge.x), dispersion, frequencies);
        double incident = reflection.incident_height, reflected = reflection.reflected_height;
        if (scene_.waves.kind != WaveKind::regular) {
            // Goda and Suzuki (1976): the lines tell the shares of the two, the variance of the records (mean
            // of the three gauges) their sum, so that heights do not depend on which lines were taken.
            const double other =
                             wave_statistics(part(gauge.time), part(gauge.second_elevation)).root_mean_square,
                         third =
                             wave_statistics(part(gauge.time), part(gauge.third_elevation)).root_mean_square,
                         own = statistics.root_mean_square;
            const double variance = (own * own + other * other + third * third) / 3.0;
            incident = 4.0 * std::sqrt(variance / (1.0 + reflection.coefficient * reflection.coefficient));
            reflected = reflection.coefficient * incident;
        }
        record_.set_figure(key + "incident_height", incident);
        record_.set_figure(key + "reflected_height", reflected);
        record_.set_figure(key + "reflection_coefficient", reflection.coefficient);
    }
}

void Report::window_done(std::int64_t windows) {
    record_.set_windows(windows);
    fill_figures();
    fill_invariants();
    record_.write_running();
}

void Report::end(const std::string& status, const std::string& message,
                 const std::vector<GaugeRecord>& gauges) {
    fill_figures();
    if (status != "failed") fill_invariants();
    fill_statistics(gauges);
    if (!envelope_.is_empty() && status == "done")
        common::write_data_file(folder_ / "envelope.h5", envelope_.file(simulation_));
    record_.add_phase_time("flow", simulation_.times().flow);
    for (std::size_t e = 0; e < simulation_.effects().size(); ++e)
        record_.add_phase_time(simulation_.effects()[e]->name(), simulation_.times().effects[e]);
    record_.write_ended(status, message);
}

std::string Report::summary() const {
    return fmt::format("{} cells, {} steps", simulation_.grid().cells, simulation_.steps());
}

void Report::save(common::DataFile& state) {
    largest_energy_ = std::max(largest_energy_, simulation_.energy());
    for (std::size_t i = 0; i < notes_.size(); ++i) state.attributes[fmt::format("note_{}", i)] = notes_[i];
    state.attributes["notes"] = static_cast<std::int64_t>(notes_.size());
    state.attributes["effects_switched_on"] = switched_on_;
    state.attributes["water_at_start"] = water_at_start_;
    state.attributes["energy_at_start"] = energy_at_start_;
    state.attributes["largest_energy"] = largest_energy_;
    envelope_.save(state);
    waterline_.save(state);
}

void Report::restore(const common::DataFile& state) {
    water_at_start_ = state.number("water_at_start");
    energy_at_start_ = state.number("energy_at_start");
    largest_energy_ = state.number("largest_energy");
    first_step_ = simulation_.steps();
    for (std::int64_t i = 0; i < state.integer("notes"); ++i)
        notes_.push_back(state.text(fmt::format("note_{}", i)));
    switched_on_ = state.text("effects_switched_on");
    record_changes();
    envelope_.restore(state);
    waterline_.restore(state);
}

}  // namespace boussinesq
