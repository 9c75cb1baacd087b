#include "cmps/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cmps/effects/gravity_history.hpp"
#include "cmps/effects/relaxation_zone.hpp"
#include "cmps/effects/turbulence.hpp"
#include "cmps/effects/viscosity.hpp"
#include "cmps/gauges.hpp"
#include "cmps/initial_state.hpp"
#include "common/errors.hpp"

namespace cmps {
namespace {

constexpr double time_slack = 1e-9;  // s: sample times are computed in several ways

/// x (m) behind which water counts as overtopped: the rear of whatever stands above still water.
double rear_of_structure(const Scene& scene) {
    double rear = scene.onshore;
    for (const Polygon& polygon : scene.structure) {
        double x1 = -1e300, z1 = -1e300;
        for (const Point& p : polygon) x1 = std::max(x1, p[0]), z1 = std::max(z1, p[1]);
        if (z1 > 0) rear = x1;
    }
    return rear;
}

/// Lowest level of the bed or the tank's floor, m.
double lowest_bottom(const Scene& scene) {
    if (scene.tank) return (*scene.tank)[2];
    double lowest = 0;
    for (const Point& p : scene.bed) lowest = std::min(lowest, p[1]);
    return lowest;
}

/// Four columns of wall that start on the bed, their face at x.
void add_moving_wall(const Scene& scene, std::vector<BoundaryParticle>& placed) {
    const double l0 = scene.settings.spacing;
    const double top = 0.75 * scene.settings.depth;  // above the highest crest before waves break
    for (int layer = 0; layer < 4; ++layer) {
        const double x = scene.offshore - (layer + 0.5) * l0;
        for (double z = bottom_level(scene, x) + 0.5 * l0; z < top; z += l0)
            placed.push_back(
                {.x = x, .z = z, .normal = {1, 0}, .body = body_moving_wall, .carries_pressure = layer == 0});
    }
}

}  // namespace

Particles initial_particles(const Scene& scene, const Solid& solid, WaveField* waves) {
    const double l0 = scene.settings.spacing, margin = 6 * l0;
    const double x0 = scene.offshore - (scene.drive == Drive::none ? margin : 1.0);
    double top = 1e3;
    if (!scene.tank) {  // walls no water can reach are not needed
        top = 2.0 * scene.settings.depth;
        for (const Polygon& polygon : scene.water)
            for (const Point& p : polygon) top = std::max(top, p[1] + 2.0 * scene.settings.depth);
    }
    const bool has_basin = scene.has_effect("overtopping_basin");
    const double x1 = has_basin ? rear_of_structure(scene) + margin : scene.onshore + margin;
    auto placed = place_boundary(solid, l0, x0, x1, top);
    if (scene.drive != Drive::none) add_moving_wall(scene, placed);
    Particles particles = make_boundary(placed);
    if (!scene.water.empty()) {
        fill_polygons(solid, l0, scene.water, particles);
        return particles;
    }
    fill_water(
        solid, l0, scene.offshore, end_of_water(scene, solid), lowest_bottom(scene) - l0,
        [&](double x) { return waves ? waves->surface_elevation(x) : 0.0; }, particles);
    if (waves)
        for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
            waves->velocity(particles.x[i], particles.z[i], particles.u[i], particles.w[i]);
    return particles;
}

Simulation::Simulation(const Scene& scene, WaveField* waves, double start)
    : scene_(scene), solid_(make_solid(scene)), waves_(waves), time_(start), start_(start) {
    const bool has_wave_start = waves_ && scene_.start;
    if (waves_) waves_->go_to(start);
    field_ = std::make_unique<NearField>(
        scene_.settings, initial_particles(scene_, solid_, has_wave_start ? waves_ : nullptr));
    field_->acceleration_smoothing = scene_.acceleration_smoothing;
    initial_fluid_ = field_->particles.fluid;
    double surface = 0;
    for (const Polygon& polygon : scene_.water)
        for (const Point& p : polygon) surface = std::max(surface, p[1]);
    constexpr int settling_sweeps = 100;  // the spread of n beside slopes has stopped falling
    field_->settle(settling_sweeps, surface);
    compose_effects(start);
    if (scene_.has_flow) flow_.emplace(scene_.flow, solid_, scene_.settings.spacing);
    const double x1 = basin_ ? rear_of_structure(scene_) : scene_.onshore;
    for (const common::Gauge& gauge : scene_.gauges)
        if (gauge.x >= scene_.offshore && gauge.x <= x1) gauges_.push_back(gauge);
    gauge_series_.resize(gauges_.size());
    initial_energy_ = energy();
    if (scene_.water.empty())
        initial_volume_ =
            volume_by_surface(field_->particles, solid_, scene_.settings.spacing, scene_.offshore,
                              end_of_water(scene_, solid_), lowest_bottom(scene_));
}

void Simulation::compose_effects(double) {
    auto& effects = field_->effects;
    auto containment = std::make_unique<Containment>(solid_);
    containment_ = containment.get();
    effects.push_back(std::move(containment));
    if (scene_.drive == Drive::waves) {
        auto wall = std::make_unique<MovingWall>(scene_.offshore, [this](double time, double step, double x) {
            waves_->go_to(time + 0.5 * step);
            return returning_wall_velocity(waves_->mean_velocity(x), x - scene_.offshore, scene_.return_time);
        });
        wall_ = wall.get();
        effects.push_back(std::move(wall));
        if (scene_.has_effect("wall_overflow")) {
            auto overflow = std::make_unique<WallOverflow>(*field_, *waves_, *wall_, scene_.crest_lowering,
                                                           bottom_level(scene_, scene_.offshore));
            overflow_ = overflow.get();
            effects.push_back(std::move(overflow));
        }
        if (scene_.has_effect("relaxation_zone"))
            effects.push_back(std::make_unique<RelaxationZone>(
                *waves_, *wall_, scene_.relaxation_length, scene_.relaxation_strength, scene_.return_time));
    }
    if (scene_.drive == Drive::piston) {
        const auto path = std::make_shared<TimeTable>(scene_.piston_file, 2);
        auto wall = std::make_unique<MovingWall>(scene_.offshore, [path](double time, double step, double) {
            return (path->value(1, time + step) - path->value(1, time)) / step;
        });
        wall_ = wall.get();
        effects.push_back(std::move(wall));
    }
    if (!scene_.gravity_file.empty())
        effects.push_back(std::make_unique<GravityHistory>(TimeTable(scene_.gravity_file, 3)));
    if (scene_.has_effect("viscosity")) effects.push_back(std::make_unique<Viscosity>(scene_.viscosity));
    if (scene_.has_effect("turbulence")) effects.push_back(std::make_unique<Turbulence>(scene_.smagorinsky));
    if (scene_.has_effect("overtopping_basin")) {
        auto basin = std::make_unique<OvertoppingBasin>(rear_of_structure(scene_));
        basin_ = basin.get();
        effects.push_back(std::move(basin));
    }
}

common::Window Simulation::advance_window(const common::WindowClock& clock, std::int64_t index,
                                          const std::function<void(double)>& on_step) {
    const double begin = clock.begin_of(index), end = clock.end_of(index);
    if (waves_) waves_->cover(begin, end);
    const auto arm = [&](Series& series, double interval) {
        series = Series{};
        series.due = clock.samples_in(index, interval);
    };
    if (flow_) arm(flow_series_, scene_.flow.interval);
    arm(particle_series_, scene_.particles_interval);
    arm(force_series_, 0.02);
    for (std::size_t g = 0; g < gauges_.size(); ++g) arm(gauge_series_[g], gauges_[g].interval);

    field_->invalidate_order();
    time_ = begin;
    record_due(time_);
    while (time_ < end - time_slack) {
        double target = end;
        const auto nearer = [&](const Series& series) {
            if (series.next < series.due.size()) target = std::min(target, series.due[series.next]);
        };
        if (flow_) nearer(flow_series_);
        nearer(particle_series_), nearer(force_series_);
        for (const Series& series : gauge_series_) nearer(series);
        const double step = common::landing_step(time_, target, field_->largest_step());
        field_->advance(time_, step);
        time_ = target - time_ <= step * (1 + 1e-9) ? target : time_ + step;
        record_due(time_);
        on_step(time_);
    }
    time_ = end;
    record_invariants();

    common::Window window;
    window.index = index, window.t_begin = begin, window.t_end = end;
    auto& data = window.datasets;
    if (flow_) {
        const std::size_t nt = flow_series_.time.size(), nx = flow_->x.size(), nz = flow_->z.size();
        data["/flow/time"] = common::real64("s", {nt}, flow_series_.time);
        data["/flow/x"] = common::real64("m", {nx}, flow_->x);
        data["/flow/z"] = common::real64("m", {nz}, flow_->z);
        data["/flow/velocity"] = common::real32("m/s", {nt, nz, nx, 2}, std::move(flow_series_.values));
        data["/flow/acceleration"] = common::real32("m/s2", {nt, nz, nx, 2}, std::move(flow_series_.more));
        data["/flow/wet"] = common::real32("-", {nt, nz, nx}, std::move(flow_series_.third));
    }
    const std::size_t ns = particle_series_.time.size();
    const std::size_t np = particle_series_.values.size() / 2 / std::max<std::size_t>(ns, 1);
    data["/particles/time"] = common::real64("s", {ns}, particle_series_.time);
    data["/particles/position"] = common::real32("m", {ns, np, 2}, std::move(particle_series_.values));
    data["/particles/velocity"] = common::real32("m/s", {ns, np, 2}, std::move(particle_series_.more));
    data["/particles/pressure"] = common::real32("Pa", {ns, np}, std::move(particle_series_.third));
    std::vector<std::int32_t> kind(np, 0);
    std::fill(kind.begin() + static_cast<std::ptrdiff_t>(initial_fluid_), kind.end(), 1);
    data["/particles/kind"] = common::integer32("-", {np}, std::move(kind));
    for (std::size_t g = 0; g < gauges_.size(); ++g) {
        Series& series = gauge_series_[g];
        const std::string group = "/gauges/" + gauges_[g].name;
        const std::size_t n = series.time.size();
        data[group + "/time"] = common::real64("s", {n}, series.time);
        switch (gauges_[g].kind) {
            case common::Gauge::Kind::surface:
                data[group + "/surface_elevation"] = common::real32("m", {n}, std::move(series.values));
                break;
            case common::Gauge::Kind::pressure:
                data[group + "/pressure"] = common::real32("Pa", {n}, std::move(series.values));
                break;
            case common::Gauge::Kind::velocity:
                data[group + "/velocity"] = common::real32("m/s", {n, 2}, std::move(series.values));
                break;
            case common::Gauge::Kind::overtopping:
                data[group + "/overtopped_volume"] = common::real32("m2", {n}, std::move(series.values));
                break;
        }
    }
    if (!scene_.structure.empty()) {
        const std::size_t n = force_series_.time.size();
        data["/structure/time"] = common::real64("s", {n}, force_series_.time);
        data["/structure/force"] =
            common::real32("N/m", {n, scene_.structure.size(), 2}, std::move(force_series_.values));
    }
    return window;
}

void Simulation::record_due(double time) {
    const auto is_due = [time](Series& series) {
        if (series.next >= series.due.size() || time < series.due[series.next] - time_slack) return false;
        series.time.push_back(series.due[series.next++]);
        return true;
    };
    if (flow_ && is_due(flow_series_)) record_flow(flow_series_);
    if (is_due(particle_series_)) record_particles(particle_series_);
    if (is_due(force_series_))
        for (std::size_t k = 0; k < scene_.structure.size(); ++k)
            for (const double component :
                 force_on(field_->particles, scene_.settings.spacing, static_cast<std::int32_t>(k)))
                force_series_.values.push_back(static_cast<float>(component));
    for (std::size_t g = 0; g < gauges_.size(); ++g)
        if (is_due(gauge_series_[g])) record_gauge(gauges_[g], gauge_series_[g]);
}

void Simulation::record_flow(Series& series) {
    flow_->evaluate(field_->particles);
    const auto append = [](std::vector<float>& to, const std::vector<float>& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    append(series.values, flow_->velocity), append(series.more, flow_->acceleration),
        append(series.third, flow_->wet);
}

/// Fluid by identity (those taken out stand at the end wall's foot, at rest), then walls.
void Simulation::record_particles(Series& series) {
    const Particles& particles = field_->particles;
    const std::size_t count = initial_fluid_ + particles.walls, from = series.third.size();
    series.values.resize(2 * (from + count)), series.more.resize(2 * (from + count)),
        series.third.resize(from + count);
    const double away_x = scene_.onshore, away_z = bottom_level(scene_, scene_.onshore);
    for (std::size_t k = 0; k < initial_fluid_; ++k) {
        series.values[2 * (from + k)] = static_cast<float>(away_x);
        series.values[2 * (from + k) + 1] = static_cast<float>(away_z);
    }
    for (std::size_t i = particles.first_wall(); i < particles.size(); ++i) {
        const std::size_t slot =
            from + (particles.is_fluid(i) ? static_cast<std::size_t>(particles.identity[i])
                                          : initial_fluid_ + i - particles.first_wall());
        series.values[2 * slot] = static_cast<float>(particles.x[i]),
                          series.values[2 * slot + 1] = static_cast<float>(particles.z[i]);
        series.more[2 * slot] = static_cast<float>(particles.u[i]),
                        series.more[2 * slot + 1] = static_cast<float>(particles.w[i]);
        series.third[slot] = static_cast<float>(particles.pressure[i]);
    }
}

void Simulation::record_gauge(const common::Gauge& gauge, Series& series) {
    const Particles& particles = field_->particles;
    const double l0 = scene_.settings.spacing;
    switch (gauge.kind) {
        case common::Gauge::Kind::surface:
            series.values.push_back(static_cast<float>(surface_elevation(particles, solid_, l0, gauge.x)));
            break;
        case common::Gauge::Kind::pressure:
            series.values.push_back(
                static_cast<float>(pressure_at(particles, l0, gauge.x, gauge.z, gauge.diameter)));
            break;
        case common::Gauge::Kind::velocity:
            for (const double component : velocity_at(particles, l0, gauge.x, gauge.z))
                series.values.push_back(static_cast<float>(component));
            break;
        case common::Gauge::Kind::overtopping: {
            std::size_t beyond = basin_ ? basin_->collected() : 0;
            for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
                beyond += particles.x[i] > gauge.x;
            series.values.push_back(static_cast<float>(static_cast<double>(beyond) * l0 * l0));
            break;
        }
    }
}

/// Kinetic and potential energy of the water, J per m of width.
double Simulation::energy() const {
    const Particles& particles = field_->particles;
    const Settings& settings = scene_.settings;
    double sum = 0;
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
        sum += 0.5 * (particles.u[i] * particles.u[i] + particles.w[i] * particles.w[i]) -
               settings.gravity_x * particles.x[i] - settings.gravity_z * particles.z[i];
    return settings.pressure.density * settings.spacing * settings.spacing * sum;
}

/// Energy, leaks, and volume by the surface profile against the particles that are in the water: what
/// compression or voids have cost.
void Simulation::record_invariants() {
    const Particles& particles = field_->particles;
    in_solid_ = 0;
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
        in_solid_ += solid_.contains(particles.x[i], particles.z[i]);
    // over the potential energy of the water standing at its depth
    const Settings& settings = scene_.settings;
    const double scale = 0.5 * settings.pressure.density * 9.81 * settings.depth * settings.spacing *
                         settings.spacing * static_cast<double>(initial_fluid_);
    energy_gain_ = (energy() - initial_energy_) / scale;
    largest_energy_gain_ = std::max(largest_energy_gain_, energy_gain_);
    if (initial_volume_ <= 0) return;
    const double l0 = scene_.settings.spacing, from = wall_ ? wall_->position() : scene_.offshore;
    const double volume = volume_by_surface(field_->particles, solid_, l0, from, end_of_water(scene_, solid_),
                                            lowest_bottom(scene_));
    const double expected =
        initial_volume_ * static_cast<double>(field_->particles.fluid) / static_cast<double>(initial_fluid_);
    volume_drift_ = volume / expected - 1.0;
    largest_volume_drift_ = std::max(largest_volume_drift_, std::abs(volume_drift_));
}

common::DataFile Simulation::state() const {
    common::DataFile state;
    const Particles& particles = field_->particles;
    auto& data = state.datasets;
    const std::size_t n = particles.size();
    data["/particles/count"] = common::integer32(
        "-", {3},
        {static_cast<std::int32_t>(particles.dummies), static_cast<std::int32_t>(particles.walls),
         static_cast<std::int32_t>(particles.fluid)});
    data["/particles/x"] = common::real64("m", {n}, particles.x);
    data["/particles/z"] = common::real64("m", {n}, particles.z);
    data["/particles/u"] = common::real64("m/s", {n}, particles.u);
    data["/particles/w"] = common::real64("m/s", {n}, particles.w);
    data["/particles/pressure"] = common::real64("Pa", {n}, particles.pressure);
    data["/particles/acceleration_x"] = common::real64("m/s2", {n}, particles.acceleration_x);
    data["/particles/acceleration_z"] = common::real64("m/s2", {n}, particles.acceleration_z);
    data["/particles/normal_x"] = common::real64("-", {n}, particles.normal_x);
    data["/particles/normal_z"] = common::real64("-", {n}, particles.normal_z);
    data["/particles/identity"] = common::integer32("-", {n}, particles.identity);
    data["/particles/body"] = common::integer32("-", {n}, particles.body);
    data["/step"] = common::real64("-", {2}, field_->step_state());
    data["/run"] = common::real64("-", {6},
                                  {start_, static_cast<double>(initial_fluid_), initial_volume_,
                                   largest_volume_drift_, initial_energy_, largest_energy_gain_});
    for (std::size_t e = 0; e < field_->effects.size(); ++e) {
        const auto values = field_->effects[e]->state();
        if (!values.empty())
            data[fmt::format("/effects/{}", e)] = common::real64("-", {values.size()}, values);
    }
    return state;
}

void Simulation::restore(const common::DataFile& state) {
    Particles& particles = field_->particles;
    const auto& count = state.at("/particles/count").integers();
    particles.dummies = static_cast<std::size_t>(count[0]),
    particles.walls = static_cast<std::size_t>(count[1]);
    particles.fluid = static_cast<std::size_t>(count[2]);
    particles.x = state.at("/particles/x").doubles(), particles.z = state.at("/particles/z").doubles();
    particles.u = state.at("/particles/u").doubles(), particles.w = state.at("/particles/w").doubles();
    particles.pressure = state.at("/particles/pressure").doubles();
    particles.acceleration_x = state.at("/particles/acceleration_x").doubles();
    particles.acceleration_z = state.at("/particles/acceleration_z").doubles();
    particles.normal_x = state.at("/particles/normal_x").doubles(),
    particles.normal_z = state.at("/particles/normal_z").doubles();
    particles.identity = state.at("/particles/identity").integers(),
    particles.body = state.at("/particles/body").integers();
    field_->restore_step_state(state.at("/step").doubles());
    const auto& run = state.at("/run").doubles();
    initial_fluid_ = static_cast<std::size_t>(run[1]), initial_volume_ = run[2],
    largest_volume_drift_ = run[3];
    initial_energy_ = run[4], largest_energy_gain_ = run[5];
    for (std::size_t e = 0; e < field_->effects.size(); ++e) {
        const std::string name = fmt::format("/effects/{}", e);
        if (state.has(name)) field_->effects[e]->restore(state.at(name).doubles());
    }
}

common::DataFile Simulation::geometry() const {
    common::DataFile geometry;
    for (std::size_t k = 0; k < scene_.structure.size(); ++k) {
        std::vector<double> points;
        for (const Point& p : scene_.structure[k]) points.insert(points.end(), p.begin(), p.end());
        geometry.datasets[fmt::format("/structure/{}", k)] =
            common::real64("m", {scene_.structure[k].size(), 2}, points);
    }
    std::vector<double> segments;
    for (const SurfaceSegment& s : solid_.surface())
        segments.insert(segments.end(), {s.from[0], s.from[1], s.to[0], s.to[1]});
    geometry.datasets["/surface"] = common::real64("m", {solid_.surface().size(), 4}, segments);
    return geometry;
}

void Simulation::describe(common::RunRecord& record) const {
    const double infinity = std::numeric_limits<double>::infinity();
    const NearField& field = *field_;
    const std::size_t collected = basin_ ? basin_->collected() : 0;
    const std::size_t waiting = overflow_ ? overflow_->waiting() : 0;
    const auto missing = static_cast<double>(initial_fluid_) -
                         static_cast<double>(field.particles.fluid + collected + waiting);
    record.set_invariant({"particle_ledger", missing, "particles", 0.5});
    if (initial_volume_ > 0) {
        record.set_invariant({"mass_drift", volume_drift_, "-", 0.02});
        record.set_invariant({"largest_mass_drift", largest_volume_drift_, "-", infinity});
    }
    // nothing does work on the water where no wall moves and gravity is constant
    const bool is_closed = scene_.drive == Drive::none && scene_.gravity_file.empty();
    record.set_invariant({"energy_gain", energy_gain_, "of rho g h / 2", is_closed ? 0.02 : infinity});
    record.set_invariant({"largest_energy_gain", largest_energy_gain_, "of rho g h / 2", infinity});
    record.set_invariant({"particles_in_solid", static_cast<double>(in_solid_), "particles", 0.5});
    record.set_invariant(
        {"unconverged_solves", static_cast<double>(field.counts.unconverged), "-", infinity});
    const double count = static_cast<double>(field.particles.size()),
                 steps = static_cast<double>(field.counts.steps);
    record.set_figure("particles.fluid", static_cast<double>(field.particles.fluid));
    record.set_figure("particles.all", count);
    if (overflow_) {
        record.set_figure("particles.waiting", static_cast<double>(waiting));
        record.set_figure("particles.passed_wall", static_cast<double>(overflow_->passed()));
    }
    record.set_figure("particles.returned_from_solid", static_cast<double>(containment_->returned()));
    record.set_figure("particles.overtopped", static_cast<double>(collected));
    record.set_figure("overtopped_volume",
                      static_cast<double>(collected) * scene_.settings.spacing * scene_.settings.spacing);
    record.set_figure("start_time", start_);
    record.set_figure("steps", steps);
    if (steps > 0) {
        record.set_figure("iterations_per_step", static_cast<double>(field.counts.iterations) / steps);
        const PhaseSeconds& s = field.seconds;
        const double total = s.neighbours + s.geometry + s.assembly + s.solve + s.gradient + s.motion;
        record.set_figure("nanoseconds_per_particle_step", total / steps / count * 1e9);
    }
}

}  // namespace cmps
