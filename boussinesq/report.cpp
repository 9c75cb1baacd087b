#include "boussinesq/report.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "boussinesq/effects/relaxation_zone.hpp"

namespace boussinesq {

std::vector<GaugeRecord> gauges_of(const Scene& scene) {
    std::vector<GaugeRecord> records;
    for (const auto& gauge : scene.gauges)
        if (gauge.kind == common::Gauge::Kind::surface)
            records.push_back({.name = gauge.name,
                               .x = gauge.x,
                               .interval = gauge.interval,
                               .time = {},
                               .elevation = {},
                               .velocity = {}});
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
    file.datasets["/x"] = common::real64("m", {grid.cells}, x);
    file.datasets["/bed_level"] = common::real64("m", {grid.cells}, bed);
    file.datasets["/bed_polyline"] = common::real64("m", {scene.bed.size(), 2}, polyline);
    return file;
}

void print_check(const common::SceneFile& file, const Scene& scene, bool all) {
    fmt::print("effects\n");
    for (const auto& effect : scene.effects)
        fmt::print("  {:<12} {:<4} {}\n", effect.name, effect.is_on ? "on" : "off", effect.reason);
    fmt::print("forecast\n  cells        {} of {:.4g} m\n", scene.grid.cells, scene.grid.spacing);
    if (all) fmt::print("\n{}", file.reference());
}

Report::Report(const std::filesystem::path& folder, const common::SceneFile& file, const Scene& scene,
               const Simulation& simulation)
    : scene_(scene),
      simulation_(simulation),
      record_(folder, "boussinesq"),
      water_at_start_(simulation.water()),
      energy_at_start_(simulation.energy()) {
    record_.describe_scene(file);
    record_.set_digests(file.digest(), "");
    record_.set_effects(scene.effects);
    record_.write_running();
}

void Report::look() {}

void Report::fill(const std::vector<GaugeRecord>&) {
    const double cells = static_cast<double>(simulation_.grid().cells);
    const double steps = static_cast<double>(simulation_.steps());
    record_.set_figure("cells", cells);
    record_.set_figure("spacing", simulation_.grid().spacing);
    record_.set_figure("steps", steps);
    const double here = static_cast<double>(simulation_.steps() - first_step_);
    double seconds = simulation_.times().flow;
    for (const double effect : simulation_.times().effects) seconds += effect;
    if (here > 0) record_.set_figure("nanoseconds_per_cell_step", 1e9 * seconds / (cells * here));
    double added = 0;
    for (const auto& effect : simulation_.effects())
        if (const auto* zone = dynamic_cast<const GenerationZone*>(effect.get()))
            added += zone->water_added();
    const double water = simulation_.water();
    record_.set_figure("water_added_by_generation", added);
    if (scene_.offshore != EndKind::open && scene_.shoreward != EndKind::open)
        record_.set_invariant(
            {.name = "water balance",
             .value = (water - water_at_start_ - added - simulation_.flow().water_made()) / water_at_start_,
             .unit = "-",
             .bound = 1e-10});
    record_.set_invariant({.name = "water made by rounding",
                           .value = simulation_.flow().water_made() / water_at_start_,
                           .unit = "-",
                           .bound = 1e-9});
    record_.set_invariant({.name = "energy",
                           .value = simulation_.energy(),
                           .unit = "m4/s2",
                           .bound = std::numeric_limits<double>::infinity()});
    record_.set_invariant({.name = "largest Courant number",
                           .value = simulation_.largest_courant(),
                           .unit = "-",
                           .bound = 1.0 + 1e-12});
}

void Report::window_done(std::int64_t windows, const std::vector<GaugeRecord>& gauges) {
    record_.set_windows(windows);
    fill(gauges);
    record_.write_running();
}

void Report::end(const std::string& status, const std::string& message,
                 const std::vector<GaugeRecord>& gauges) {
    fill(gauges);
    record_.add_phase_time("flow", simulation_.times().flow);
    for (std::size_t e = 0; e < simulation_.effects().size(); ++e)
        record_.add_phase_time(simulation_.effects()[e]->name(), simulation_.times().effects[e]);
    record_.write_ended(status, message);
}

std::string Report::summary() const {
    return fmt::format("{} cells, {} steps", simulation_.grid().cells, simulation_.steps());
}

common::DataFile Report::save(common::DataFile state) const {
    state.attributes["water_at_start"] = water_at_start_;
    return state;
}

void Report::restore(const common::DataFile& state) {
    water_at_start_ = state.number("water_at_start");
    first_step_ = simulation_.steps();
}

}  // namespace boussinesq
