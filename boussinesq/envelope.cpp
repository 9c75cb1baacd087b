#include "boussinesq/envelope.hpp"

#include <algorithm>

namespace boussinesq {

void Envelope::look(const Simulation& simulation) {
    if (simulation.time() < begin_) return;
    const double step = simulation.time() - simulation.begun();
    const double* h = simulation.state().depth.data() + ghost_cells;
    const double* b = simulation.bed().face_level.data() + ghost_cells;
    const bool first = duration_ == 0.0;
    duration_ += step;
    const std::size_t cells = sum_.size();
    for (std::size_t i = 0; i < cells; ++i) {
        const double e = h[i] + 0.5 * (b[i] + b[i + 1]);
        highest_[i] = first ? e : std::max(highest_[i], e);
        lowest_[i] = first ? e : std::min(lowest_[i], e);
        sum_[i] += step * e;
    }
}

common::DataFile Envelope::file(const Simulation& simulation) const {
    const std::size_t n = sum_.size();
    std::vector<double> x(n), mean(n), height(n);
    for (std::size_t i = 0; i < n; ++i) {
        x[i] = simulation.grid().centre(i);
        mean[i] = sum_[i] / duration_;
        height[i] = highest_[i] - lowest_[i];
    }
    common::DataFile file;
    file.attributes["schema"] = std::string("tsunagi.boussinesq.envelope/1");
    file.attributes["t_begin"] = simulation.time() - duration_;
    file.attributes["t_end"] = simulation.time();
    file.datasets["/x"] = common::real64("m", {n}, std::move(x));
    file.datasets["/highest_surface"] = common::real64("m", {n}, highest_);
    file.datasets["/lowest_surface"] = common::real64("m", {n}, lowest_);
    file.datasets["/mean_surface"] = common::real64("m", {n}, std::move(mean));
    file.datasets["/wave_height"] = common::real64("m", {n}, std::move(height));
    return file;
}

void Envelope::save(common::DataFile& state) const {
    if (is_empty()) return;
    const std::size_t n = sum_.size();
    state.attributes["envelope_duration"] = duration_;
    state.datasets["/envelope/highest"] = common::real64("m", {n}, highest_);
    state.datasets["/envelope/lowest"] = common::real64("m", {n}, lowest_);
    state.datasets["/envelope/sum"] = common::real64("m s", {n}, sum_);
}

void Envelope::restore(const common::DataFile& state) {
    if (!state.has("/envelope/sum")) return;
    duration_ = state.number("envelope_duration");
    highest_ = state.at("/envelope/highest").doubles();
    lowest_ = state.at("/envelope/lowest").doubles();
    sum_ = state.at("/envelope/sum").doubles();
}

void Waterline::look(const Simulation& simulation) {
    const double* h = simulation.state().depth.data() + ghost_cells;
    const std::size_t last = simulation.grid().cells - 1;
    while (last_wet_ > 0 && h[last_wet_] <= film_) --last_wet_;
    while (last_wet_ < last && h[last_wet_ + 1] > film_) ++last_wet_;
    if (last_wet_ == last && !has_beach_) return;
    has_beach_ = true;
    const double level = h[last_wet_] + simulation.bed().level(last_wet_ + ghost_cells);
    if (level > run_up) {
        run_up = level;
        run_up_time = simulation.time();
        farthest = simulation.grid().centre(last_wet_);
    }
    if (level < run_down) {
        run_down = level;
        run_down_time = simulation.time();
    }
}

void Waterline::save(common::DataFile& state) const {
    state.datasets["/waterline"] = common::real64("1", {7},
                                                  {has_beach_ ? 1.0 : 0.0, static_cast<double>(last_wet_),
                                                   run_up, run_up_time, run_down, run_down_time, farthest});
}

void Waterline::restore(const common::DataFile& state) {
    const auto& v = state.at("/waterline").doubles();
    has_beach_ = v.at(0) != 0.0;
    last_wet_ = static_cast<std::size_t>(v.at(1));
    run_up = v.at(2);
    run_up_time = v.at(3);
    run_down = v.at(4);
    run_down_time = v.at(5);
    farthest = v.at(6);
}

}  // namespace boussinesq
