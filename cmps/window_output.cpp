#include "cmps/window_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cmps/gauges.hpp"
#include "cmps/scene_geometry.hpp"

namespace cmps {
namespace {

constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

std::size_t water_beyond(const Particles& particles, double x) {
    std::size_t count = 0;
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i) count += particles.x[i] > x;
    return count;
}

/// Gauges of the scene within the near field.
std::vector<common::Gauge> gauges_in(const Scene& scene) {
    std::vector<common::Gauge> gauges;
    for (const common::Gauge& gauge : scene.gauges)
        if (gauge.x >= scene.offshore && gauge.x <= scene.onshore) gauges.push_back(gauge);
    return gauges;
}

bool reads_pressure(const common::Gauge& gauge) {
    return gauge.kind == common::Gauge::Kind::pressure;
}

common::Dataset times(const Series& series) {
    return common::real64("s", {series.next}, series.times());
}

}  // namespace

WindowOutput::WindowOutput(const Scene& scene, const Solid& solid, const Particles& particles)
    : scene_(scene),
      solid_(solid),
      initial_fluid_(particles.fluid),
      gauges_(gauges_in(scene)),
      sensors_(gauges_.size()),
      pressures_(scene.pressure_average, gauges_.size() + 2 * scene.structure.size()) {
    if (scene_.has_flow) flow_.emplace(scene_.flow, solid_, scene_.settings.spacing);
    for (const common::Gauge& gauge : gauges_) beyond_at_start_.push_back(water_beyond(particles, gauge.x));
    gauge_series_.resize(gauges_.size());
    if (scene_.structure.empty() && std::none_of(gauges_.begin(), gauges_.end(), reads_pressure)) return;
    faces_.emplace(particles, solid_, scene_.settings);
    for (std::size_t g = 0; g < gauges_.size(); ++g)
        if (reads_pressure(gauges_[g]))
            sensors_[g] = faces_->sensor_at(gauges_[g].x, gauges_[g].z, gauges_[g].diameter);
}

/// Calls visit(series, interval) for everything that is recorded.
template <class Visit>
void WindowOutput::for_each_series(const Visit& visit) {
    if (flow_) visit(flow_series_, scene_.flow.interval);
    visit(particle_series_, scene_.particles_interval);
    if (!scene_.structure.empty()) visit(force_series_, force_interval);
    for (std::size_t g = 0; g < gauges_.size(); ++g) visit(gauge_series_[g], gauges_[g].interval);
}

void WindowOutput::begin(const common::WindowClock& clock, std::int64_t index) {
    window_ = {};
    positions_.clear();
    window_.index = index, window_.t_begin = clock.begin_of(index), window_.t_end = clock.end_of(index);
    for_each_series([&](Series& series, double interval) {
        series.due = clock.samples_in(index, interval), series.next = 0;
        for (auto& values : series.values) values.clear();
        if (series.after.is_made) take_samples(series);
    });
}

bool WindowOutput::is_complete() const {
    return particle_series_.is_complete();  // all end with the window
}

void WindowOutput::before_step(double time, double next, const NearField& field, std::size_t overtopped) {
    if (pressures_.is_empty()) add_step(0.0, field);  // at the start: of the water at rest
    for_each_series([&](Series& series, double) {
        if (!series.is_passed_by(next)) return;
        if (series.after.is_made && series.after.time == time)
            std::swap(series.before, series.after);  // the step before was read at its end
        else
            read(series, field, overtopped, time, series.before);
    });
}

void WindowOutput::add_step(double step, const NearField& field) {
    if (!faces_) return;
    const std::span<double> values = pressures_.add_step(step);
    for (std::size_t g = 0; g < gauges_.size(); ++g) {
        const common::Gauge& gauge = gauges_[g];
        if (!reads_pressure(gauge)) continue;
        values[g] = sensors_[g].pieces.empty() ? pressure_in_water(field.particles, scene_.settings.spacing,
                                                                   gauge.x, gauge.z, gauge.diameter)
                                               : faces_->read(field.face_pressure, sensors_[g]);
    }
    for (std::size_t k = 0; k < scene_.structure.size(); ++k) {
        const auto force = faces_->force_on(field.face_pressure, static_cast<std::int32_t>(k));
        std::copy(force.begin(), force.end(),
                  values.begin() + static_cast<std::ptrdiff_t>(gauges_.size() + 2 * k));
    }
}

void WindowOutput::after_step(double time, const NearField& field, std::size_t overtopped) {
    for_each_series([&](Series& series, double) {
        if (!series.is_passed_by(time)) return;
        read(series, field, overtopped, time, series.after);
        take_samples(series);
    });
}

bool WindowOutput::is_pressure(const Series& series) const {
    if (&series == &force_series_) return true;
    if (&series == &flow_series_ || &series == &particle_series_) return false;
    return gauges_[static_cast<std::size_t>(&series - gauge_series_.data())].kind ==
           common::Gauge::Kind::pressure;
}

void WindowOutput::take_samples(Series& series) {
    const double from = series.before.time, to = series.after.time;
    for (; series.is_passed_by(to); ++series.next) {
        double share = std::clamp((series.due[series.next] - from) / (to - from), 0.0, 1.0);
        if (!series.before.is_solved && is_pressure(series)) share = 1.0;
        if (&series == &particle_series_) {
            sample_particles(share);
            continue;
        }
        for (std::size_t f = 0; f < series.values.size(); ++f) {
            const auto &before = series.before.fields[f], &after = series.after.fields[f];
            for (std::size_t k = 0; k < after.size(); ++k)
                series.values[f].push_back(static_cast<float>(between(before[k], after[k], share)));
        }
    }
}

void WindowOutput::read(const Series& series, const NearField& field, std::size_t overtopped, double time,
                        Reading& reading) {
    reading.time = time, reading.is_made = true, reading.is_solved = field.counts.steps > 0;
    if (&series == &flow_series_) return read_flow(field, reading);
    if (&series == &particle_series_) return read_particles(field.particles, reading);
    for (auto& values : reading.fields) values.clear();
    if (&series == &force_series_) return read_forces(reading);
    read_gauge(static_cast<std::size_t>(&series - gauge_series_.data()), field, overtopped, reading);
}

void WindowOutput::read_flow(const NearField& field, Reading& reading) {
    field.path_average->evaluate(field.particles, field.last_step(), motion_);
    flow_->evaluate(field.particles, motion_);
    reading.fields[0].assign(flow_->velocity.begin(), flow_->velocity.end());
    reading.fields[1].assign(flow_->acceleration.begin(), flow_->acceleration.end());
    reading.fields[2].assign(flow_->wet.begin(), flow_->wet.end());
}

/// Position, velocity, pressure: fluid by identity (nowhere, where one has been taken out), then walls.
void WindowOutput::read_particles(const Particles& particles, Reading& reading) const {
    auto& [position, velocity, pressure] = reading.fields;
    const std::size_t count = initial_fluid_ + particles.walls;
    position.assign(2 * count, nowhere), velocity.assign(2 * count, 0.0), pressure.assign(count, 0.0);
    for (std::size_t i = particles.first_wall(); i < particles.size(); ++i) {
        const std::size_t slot = particles.is_fluid(i) ? static_cast<std::size_t>(particles.identity[i])
                                                       : initial_fluid_ + i - particles.first_wall();
        position[2 * slot] = particles.x[i], position[2 * slot + 1] = particles.z[i];
        velocity[2 * slot] = particles.u[i], velocity[2 * slot + 1] = particles.w[i];
        pressure[slot] = particles.pressure[i];
    }
}

/// Those taken out stand at the end wall's foot, at rest; one that the step took out, brought back or set
/// elsewhere is where the step has left it.
void WindowOutput::sample_particles(double share) {
    const auto& before = particle_series_.before.fields;
    const auto& after = particle_series_.after.fields;
    auto& values = particle_series_.values;
    const double away[2] = {scene_.onshore, bottom_level(scene_, scene_.onshore)};
    const double far = 2.0 * scene_.settings.spacing;  // steps move water by less than one
    for (std::size_t k = 0; k < after[2].size(); ++k) {
        const double dx = after[0][2 * k] - before[0][2 * k], dz = after[0][2 * k + 1] - before[0][2 * k + 1];
        const double part = dx * dx + dz * dz < far * far ? share : 1.0;  // nowhere is never near
        const auto value = [&](std::size_t f, std::size_t n) {
            return part < 1.0 ? between(before[f][n], after[f][n], part) : after[f][n];
        };
        const bool is_here = std::isfinite(after[0][2 * k]);
        for (std::size_t c = 0; c < 2; ++c) {
            positions_.push_back(is_here ? value(0, 2 * k + c) : away[c]);
            values[1].push_back(static_cast<float>(value(1, 2 * k + c)));
        }
        values[2].push_back(
            static_cast<float>(particle_series_.before.is_solved ? value(2, k) : after[2][k]));
    }
}

void WindowOutput::read_forces(Reading& reading) const {
    for (std::size_t k = 0; k < 2 * scene_.structure.size(); ++k)
        reading.fields[0].push_back(pressures_.mean(gauges_.size() + k));
}

void WindowOutput::read_gauge(std::size_t index, const NearField& field, std::size_t overtopped,
                              Reading& reading) const {
    const common::Gauge& gauge = gauges_[index];
    const Particles& particles = field.particles;
    const double l0 = scene_.settings.spacing;
    std::vector<double>& values = reading.fields[0];
    switch (gauge.kind) {
        case common::Gauge::Kind::surface:
            values.push_back(surface_elevation(particles, solid_, l0, gauge.x));
            break;
        case common::Gauge::Kind::pressure:
            values.push_back(pressures_.mean(index));
            break;
        case common::Gauge::Kind::velocity:
            for (const double component : velocity_at(particles, l0, gauge.x, gauge.z))
                values.push_back(component);
            break;
        case common::Gauge::Kind::overtopping: {
            // water that stood behind the gauge at the start has not passed it
            const auto passed = static_cast<double>(overtopped + water_beyond(particles, gauge.x)) -
                                static_cast<double>(beyond_at_start_[index]);
            values.push_back(passed * l0 * l0);
            break;
        }
    }
}

common::Window WindowOutput::take() {
    auto& data = window_.datasets;
    if (flow_) {
        const std::size_t nt = flow_series_.next, nx = flow_->x.size(), nz = flow_->z.size();
        data["/flow/time"] = times(flow_series_);
        data["/flow/x"] = common::real64("m", {nx}, flow_->x);
        data["/flow/z"] = common::real64("m", {nz}, flow_->z);
        data["/flow/velocity"] = common::real32("m/s", {nt, nz, nx, 2}, std::move(flow_series_.values[0]));
        data["/flow/acceleration"] =
            common::real32("m/s2", {nt, nz, nx, 2}, std::move(flow_series_.values[1]));
        data["/flow/wet"] = common::real32("-", {nt, nz, nx}, std::move(flow_series_.values[2]));
    }
    const std::size_t ns = particle_series_.next;
    const std::size_t np = particle_series_.values[2].size() / std::max<std::size_t>(ns, 1);
    data["/particles/time"] = times(particle_series_);
    data["/particles/position"] = common::real64("m", {ns, np, 2}, std::move(positions_));
    data["/particles/velocity"] = common::real32("m/s", {ns, np, 2}, std::move(particle_series_.values[1]));
    data["/particles/pressure"] = common::real32("Pa", {ns, np}, std::move(particle_series_.values[2]));
    std::vector<std::int32_t> kind(np, 0);  // 0: fluid, 1: wall
    std::fill(kind.begin() + static_cast<std::ptrdiff_t>(initial_fluid_), kind.end(), 1);
    data["/particles/kind"] = common::integer32("-", {np}, std::move(kind));
    for (std::size_t g = 0; g < gauges_.size(); ++g) {
        Series& series = gauge_series_[g];
        const std::string group = "/gauges/" + gauges_[g].name;
        const std::size_t n = series.next;
        data[group + "/time"] = times(series);
        switch (gauges_[g].kind) {
            case common::Gauge::Kind::surface:
                data[group + "/surface_elevation"] = common::real32("m", {n}, std::move(series.values[0]));
                break;
            case common::Gauge::Kind::pressure:
                data[group + "/pressure"] = common::real32("Pa", {n}, std::move(series.values[0]));
                data[group + "/averaged_over"] = common::real64("s", {1}, {scene_.pressure_average});
                break;
            case common::Gauge::Kind::velocity:
                data[group + "/velocity"] = common::real32("m/s", {n, 2}, std::move(series.values[0]));
                break;
            case common::Gauge::Kind::overtopping:
                data[group + "/overtopped_volume"] = common::real32("m2", {n}, std::move(series.values[0]));
                break;
        }
    }
    if (!scene_.structure.empty()) {
        const std::size_t n = force_series_.next;
        data["/structure/time"] = times(force_series_);
        data["/structure/force"] =
            common::real32("N/m", {n, scene_.structure.size(), 2}, std::move(force_series_.values[0]));
        data["/structure/averaged_over"] = common::real64("s", {1}, {scene_.pressure_average});
    }
    return std::move(window_);
}

common::DataFile geometry_file(const Scene& scene, const Solid& solid) {
    common::DataFile geometry;
    for (std::size_t k = 0; k < scene.structure.size(); ++k) {
        std::vector<double> points;
        for (const Point& p : scene.structure[k]) points.insert(points.end(), p.begin(), p.end());
        geometry.datasets[fmt::format("/structure/{}", k)] =
            common::real64("m", {scene.structure[k].size(), 2}, points);
    }
    std::vector<double> segments;
    for (const SurfaceSegment& s : solid.surface())
        segments.insert(segments.end(), {s.from[0], s.from[1], s.to[0], s.to[1]});
    geometry.datasets["/surface"] = common::real64("m", {solid.surface().size(), 4}, segments);
    return geometry;
}

}  // namespace cmps
