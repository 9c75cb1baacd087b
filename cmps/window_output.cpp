#include "cmps/window_output.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cmps/gauges.hpp"
#include "cmps/scene_geometry.hpp"

namespace cmps {
namespace {

constexpr double time_slack = 1e-9;  // s: sample times are computed in several ways

bool is_due(Series& series, double time) {
    if (series.next >= series.due.size() || time < series.due[series.next] - time_slack) return false;
    series.time.push_back(series.due[series.next++]);
    return true;
}

common::Dataset times(const Series& series) {
    return common::real64("s", {series.time.size()}, series.time);
}

}  // namespace

WindowOutput::WindowOutput(const Scene& scene, const Solid& solid, const Particles& particles, double x1)
    : scene_(scene), solid_(solid), initial_fluid_(particles.fluid) {
    if (scene_.has_flow) flow_.emplace(scene_.flow, solid_, scene_.settings.spacing);
    for (const common::Gauge& gauge : scene_.gauges)
        if (gauge.x >= scene_.offshore && gauge.x <= x1) gauges_.push_back(gauge);
    gauge_series_.resize(gauges_.size());
    const bool reads_pressure = std::any_of(gauges_.begin(), gauges_.end(), [](const common::Gauge& gauge) {
        return gauge.kind == common::Gauge::Kind::pressure;
    });
    if (reads_pressure || !scene_.structure.empty()) faces_.emplace(particles, solid_, scene_.settings);
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
    window_.index = index, window_.t_begin = clock.begin_of(index), window_.t_end = clock.end_of(index);
    for_each_series([&](Series& series, double interval) {
        series = Series{};
        series.due = clock.samples_in(index, interval);
    });
}

double WindowOutput::next_due(double end) const {
    double next = end;
    const auto look_at = [&](const Series& series) {
        if (series.next < series.due.size()) next = std::min(next, series.due[series.next]);
    };
    look_at(flow_series_), look_at(particle_series_), look_at(force_series_);
    for (const Series& series : gauge_series_) look_at(series);
    return next;
}

void WindowOutput::record(double time, const NearField& field, std::size_t overtopped) {
    const Particles& particles = field.particles;
    if (is_due(flow_series_, time)) record_flow(field);
    if (is_due(particle_series_, time)) record_particles(particles);
    if (is_due(force_series_, time))
        for (std::size_t k = 0; k < scene_.structure.size(); ++k)
            for (const double component : faces_->force_on(field.face_pressure, static_cast<std::int32_t>(k)))
                force_series_.values.push_back(static_cast<float>(component));
    for (std::size_t g = 0; g < gauges_.size(); ++g)
        if (is_due(gauge_series_[g], time)) record_gauge(gauges_[g], field, overtopped, gauge_series_[g]);
}

void WindowOutput::record_flow(const NearField& field) {
    flow_->evaluate(field.particles);
    const auto append = [](std::vector<float>& to, const std::vector<float>& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    append(flow_series_.values, flow_->velocity), append(flow_series_.more, flow_->acceleration);
    append(flow_series_.third, flow_->wet);
}

/// Fluid by identity (those taken out stand at the end wall's foot, at rest), then walls.
void WindowOutput::record_particles(const Particles& particles) {
    Series& series = particle_series_;
    const std::size_t count = initial_fluid_ + particles.walls, from = series.third.size();
    series.values.resize(2 * (from + count)), series.more.resize(2 * (from + count));
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
        series.values[2 * slot] = static_cast<float>(particles.x[i]);
        series.values[2 * slot + 1] = static_cast<float>(particles.z[i]);
        series.more[2 * slot] = static_cast<float>(particles.u[i]);
        series.more[2 * slot + 1] = static_cast<float>(particles.w[i]);
        series.third[slot] = static_cast<float>(particles.pressure[i]);
    }
}

void WindowOutput::record_gauge(const common::Gauge& gauge, const NearField& field, std::size_t overtopped,
                                Series& series) {
    const Particles& particles = field.particles;
    const double l0 = scene_.settings.spacing;
    switch (gauge.kind) {
        case common::Gauge::Kind::surface:
            series.values.push_back(static_cast<float>(surface_elevation(particles, solid_, l0, gauge.x)));
            break;
        case common::Gauge::Kind::pressure:
            series.values.push_back(static_cast<float>(
                faces_->mean_around(field.face_pressure, gauge.x, gauge.z, gauge.diameter)
                    .value_or(pressure_in_water(particles, l0, gauge.x, gauge.z, gauge.diameter))));
            break;
        case common::Gauge::Kind::velocity:
            for (const double component : velocity_at(particles, l0, gauge.x, gauge.z))
                series.values.push_back(static_cast<float>(component));
            break;
        case common::Gauge::Kind::overtopping: {
            std::size_t beyond = overtopped;
            for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
                beyond += particles.x[i] > gauge.x;
            series.values.push_back(static_cast<float>(static_cast<double>(beyond) * l0 * l0));
            break;
        }
    }
}

common::Window WindowOutput::take() {
    auto& data = window_.datasets;
    if (flow_) {
        const std::size_t nt = flow_series_.time.size(), nx = flow_->x.size(), nz = flow_->z.size();
        data["/flow/time"] = times(flow_series_);
        data["/flow/x"] = common::real64("m", {nx}, flow_->x);
        data["/flow/z"] = common::real64("m", {nz}, flow_->z);
        data["/flow/velocity"] = common::real32("m/s", {nt, nz, nx, 2}, std::move(flow_series_.values));
        data["/flow/acceleration"] = common::real32("m/s2", {nt, nz, nx, 2}, std::move(flow_series_.more));
        data["/flow/wet"] = common::real32("-", {nt, nz, nx}, std::move(flow_series_.third));
    }
    const std::size_t ns = particle_series_.time.size();
    const std::size_t np = particle_series_.third.size() / std::max<std::size_t>(ns, 1);
    data["/particles/time"] = times(particle_series_);
    data["/particles/position"] = common::real32("m", {ns, np, 2}, std::move(particle_series_.values));
    data["/particles/velocity"] = common::real32("m/s", {ns, np, 2}, std::move(particle_series_.more));
    data["/particles/pressure"] = common::real32("Pa", {ns, np}, std::move(particle_series_.third));
    std::vector<std::int32_t> kind(np, 0);  // 0: fluid, 1: wall
    std::fill(kind.begin() + static_cast<std::ptrdiff_t>(initial_fluid_), kind.end(), 1);
    data["/particles/kind"] = common::integer32("-", {np}, std::move(kind));
    for (std::size_t g = 0; g < gauges_.size(); ++g) {
        Series& series = gauge_series_[g];
        const std::string group = "/gauges/" + gauges_[g].name;
        const std::size_t n = series.time.size();
        data[group + "/time"] = times(series);
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
        data["/structure/time"] = times(force_series_);
        data["/structure/force"] =
            common::real32("N/m", {n, scene_.structure.size(), 2}, std::move(force_series_.values));
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
