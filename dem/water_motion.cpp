#include "dem/water_motion.hpp"

#include <fmt/format.h>

namespace dem {

namespace {

bool is_uniform(const std::vector<double>& axis) {
    const double spacing = (axis.back() - axis.front()) / static_cast<double>(axis.size() - 1);
    for (std::size_t i = 0; i < axis.size(); ++i)
        // Axes are stored as computed; a millionth of the spacing is far above their rounding.
        if (std::abs(axis[i] - axis.front() - static_cast<double>(i) * spacing) > 1e-4 * spacing)
            return false;
    return spacing > 0;
}

}  // namespace

void UniformWater::sample(const std::vector<double>& x, const std::vector<double>& z,
                          WaterSamples& samples) const {
    for (std::size_t k = 0; k < x.size(); ++k) samples.wet[k] = wet_at(z[k]);
    const Vector now = velocity + time * acceleration;
    const auto fill = [](Column& column, const Vector& value) {
        std::fill(column.x.begin(), column.x.end(), value.x());
        std::fill(column.y.begin(), column.y.end(), value.y());
        std::fill(column.z.begin(), column.z.end(), value.z());
    };
    fill(samples.velocity, now);
    fill(samples.acceleration, acceleration);
}

FlowGrid::FlowGrid(FlowHistory history, std::optional<UniformWater> still)
    : history_(std::move(history)), still_(still) {
    if (history_.x.size() < 2 || history_.z.size() < 2 || !is_uniform(history_.x) || !is_uniform(history_.z))
        throw std::invalid_argument("the axes of the flow grid must be uniform, with two points at least");
    count_x_ = history_.x.size();
    count_z_ = history_.z.size();
    origin_x_ = history_.x.front();
    origin_z_ = history_.z.front();
    per_spacing_x_ = static_cast<double>(count_x_ - 1) / (history_.x.back() - origin_x_);
    per_spacing_z_ = static_cast<double>(count_z_ - 1) / (history_.z.back() - origin_z_);
    values_ = count_x_ * count_z_ * fields;
    now_.resize(values_ + padded_fields - fields);
    set_time(history_.time.front());
}

void FlowGrid::set_time(double t) {
    const auto& time = history_.time;
    const auto right = std::upper_bound(time.begin() + 1, time.end() - (time.size() > 1 ? 1 : 0), t);
    const std::size_t k = time.size() > 1 ? static_cast<std::size_t>(right - time.begin()) - 1 : 0;
    const std::size_t next = std::min(k + 1, time.size() - 1);
    interval_ = k;
    const double share = next > k ? std::clamp((t - time[k]) / (time[next] - time[k]), 0.0, 1.0) : 0.0;
    const float *before = history_.values.data() + k * values_,
                *after = history_.values.data() + next * values_;
    for (std::size_t i = 0; i < values_; ++i)
        now_[i] = (1 - share) * static_cast<double>(before[i]) + share * static_cast<double>(after[i]);
}

inline void FlowGrid::interpolate(double x, double z, double (&value)[padded_fields]) const {
    const double across = (x - origin_x_) * per_spacing_x_, up = (z - origin_z_) * per_spacing_z_;
    if (!(across >= 0 && up >= 0 && across <= static_cast<double>(count_x_ - 1) &&
          up <= static_cast<double>(count_z_ - 1))) {
        if (!still_)
            throw std::out_of_range(fmt::format(
                "x = {:.4f} m, z = {:.4f} m is outside the flow grid (x {:.4f} to {:.4f} m, z "
                "{:.4f} to {:.4f} m)",
                x, z, history_.x.front(), history_.x.back(), history_.z.front(), history_.z.back()));
        std::fill(std::begin(value), std::end(value), 0.0);
        value[4] = still_->wet_at(z);
        return;
    }
    const std::size_t i = std::min(static_cast<std::size_t>(across), count_x_ - 2);
    const std::size_t j = std::min(static_cast<std::size_t>(up), count_z_ - 2);
    const double right = across - static_cast<double>(i), above = up - static_cast<double>(j);
    const double* low = now_.data() + (j * count_x_ + i) * fields;
    const double* high = low + count_x_ * fields;
    for (std::size_t f = 0; f < padded_fields; ++f)
        value[f] = (1 - above) * ((1 - right) * low[f] + right * low[f + fields]) +
                   above * ((1 - right) * high[f] + right * high[f + fields]);
}

void FlowGrid::sample(const std::vector<double>& x, const std::vector<double>& z,
                      WaterSamples& samples) const {
    auto& [velocity, acceleration, wet] = samples;
    std::fill(velocity.y.begin(), velocity.y.end(), 0.0);
    std::fill(acceleration.y.begin(), acceleration.y.end(), 0.0);
    for (std::size_t k = 0; k < x.size(); ++k) {
        double value[padded_fields];
        interpolate(x[k], z[k], value);
        velocity.x[k] = value[0];
        velocity.z[k] = value[1];
        acceleration.x[k] = value[2];
        acceleration.z[k] = value[3];
        wet[k] = value[4];
    }
}

std::optional<FlowGrid::Points> FlowGrid::points_around(double x_low, double x_high, double z_low,
                                                        double z_high) const {
    const double left = (x_low - origin_x_) * per_spacing_x_, right = (x_high - origin_x_) * per_spacing_x_;
    const double low = (z_low - origin_z_) * per_spacing_z_, high = (z_high - origin_z_) * per_spacing_z_;
    if (!(left >= 0 && low >= 0 && right <= static_cast<double>(count_x_ - 1) &&
          high <= static_cast<double>(count_z_ - 1)))
        return {};
    const auto after = [](double place, std::size_t count) {
        return std::min(static_cast<std::size_t>(place) + 2, count);
    };
    return Points{static_cast<std::size_t>(left), after(right, count_x_), static_cast<std::size_t>(low),
                  after(high, count_z_)};
}

std::vector<double> FlowGrid::values_at(const Points& points) const {
    std::vector<double> values;
    for (std::size_t j = points.j; j < points.end_j; ++j) {
        const double* row = now_.data() + j * count_x_ * fields;
        values.insert(values.end(), row + points.i * fields, row + points.end_i * fields);
    }
    return values;
}

FlowGrid::Change FlowGrid::largest_change(const Points& points, const std::vector<double>& earlier) const {
    // Linear in time: between now and the end of the interval nothing is farther from the earlier values than
    // at one of the two.
    const std::size_t next = std::min(interval_ + 1, history_.time.size() - 1);
    const float* then = history_.values.data() + next * values_;
    const auto squared = [](double a, double b) { return a * a + b * b; };
    double velocity = 0, acceleration = 0, speed = 0;
    bool wet = false;
    const double* old = earlier.data();
    for (std::size_t j = points.j; j < points.end_j; ++j)
        for (std::size_t i = points.i; i < points.end_i; ++i, old += fields) {
            const double* now = now_.data() + (j * count_x_ + i) * fields;
            const float* end = then + (j * count_x_ + i) * fields;
            double last[fields];
            for (std::size_t f = 0; f < fields; ++f) last[f] = static_cast<double>(end[f]);
            for (const double* value : {now, static_cast<const double*>(last)}) {
                velocity = std::max(velocity, squared(value[0] - old[0], value[1] - old[1]));
                acceleration = std::max(acceleration, squared(value[2] - old[2], value[3] - old[3]));
                speed = std::max(speed, squared(value[0], value[1]));
                wet = wet || value[4] != old[4];
            }
            speed = std::max(speed, squared(old[0], old[1]));
        }
    return {std::sqrt(velocity), std::sqrt(acceleration), std::sqrt(speed), wet};
}

}  // namespace dem
