#include "boussinesq/window_output.hpp"

#include <algorithm>

namespace boussinesq {

WindowOutput::WindowOutput(const Simulation& simulation, const common::WindowClock& clock,
                           double output_interval, std::vector<GaugeRecord> gauges)
    : simulation_(simulation), clock_(clock), interval_(output_interval), gauges_(std::move(gauges)) {}

void WindowOutput::begin(std::int64_t index) {
    index_ = index;
    times_ = clock_.samples_in(index, interval_);
    next_ = 0;
    for (auto* values : {&elevation_, &velocity_}) {
        values->clear();
        values->reserve(times_.size() * simulation_.grid().cells);
    }
    gauge_times_.clear();
    for (const GaugeRecord& gauge : gauges_) {
        auto times = clock_.samples_in(index, gauge.interval);
        if (!gauge.time.empty()) times.erase(times.begin());  // the window before ended with it
        gauge_times_.push_back(std::move(times));
    }
    gauge_next_.assign(gauges_.size(), 0);
}

void WindowOutput::collect() {
    const double now = simulation_.time();
    for (; next_ < times_.size() && times_[next_] <= now; ++next_) {
        simulation_.sample(times_[next_], sample_);
        for (const double value : sample_.elevation) elevation_.push_back(static_cast<float>(value));
        for (const double value : sample_.velocity) velocity_.push_back(static_cast<float>(value));
    }
    for (std::size_t g = 0; g < gauges_.size(); ++g)
        for (; gauge_next_[g] < gauge_times_[g].size() && gauge_times_[g][gauge_next_[g]] <= now;
             ++gauge_next_[g]) {
            GaugeRecord& gauge = gauges_[g];
            const double t = gauge_times_[g][gauge_next_[g]];
            const auto [elevation, velocity] = simulation_.sample_at(t, gauge.x);
            gauge.time.push_back(t);
            gauge.elevation.push_back(elevation);
            gauge.velocity.push_back(velocity);
            if (!gauge.has_array()) continue;
            gauge.second_elevation.push_back(simulation_.sample_at(t, gauge.array[0]).elevation);
            gauge.third_elevation.push_back(simulation_.sample_at(t, gauge.array[1]).elevation);
        }
}

common::Window WindowOutput::take() {
    const Grid& grid = simulation_.grid();
    const std::size_t nx = grid.cells, nt = times_.size();
    common::Window window;
    window.index = index_;
    window.t_begin = clock_.begin_of(index_);
    window.t_end = clock_.end_of(index_);
    std::vector<double> x(nx), still(nx);
    for (std::size_t i = 0; i < nx; ++i) {
        x[i] = grid.centre(i);
        still[i] = -simulation_.bed().level(i + ghost_cells);
    }
    window.datasets["/time"] = common::real64("s", {nt}, times_);
    window.datasets["/x"] = common::real64("m", {nx}, std::move(x));
    window.datasets["/still_water_depth"] = common::real32("m", {nx}, std::span<const double>(still));
    window.datasets["/surface_elevation"] = common::real32("m", {nt, nx}, std::move(elevation_));
    window.datasets["/velocity"] = common::real32("m/s", {nt, nx}, std::move(velocity_));
    add_gauges(window, gauges_);
    return window;
}

}  // namespace boussinesq
