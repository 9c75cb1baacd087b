#include "cmps/wave_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "common/errors.hpp"

namespace cmps {
namespace {

constexpr double gravity = 9.81;              // m/s2, of boussinesq
constexpr double most_elevation_ratio = 5.0;  // of the largest depth, or height of dry ground
constexpr double most_speed_ratio = 5.0;      // of sqrt(g times it)
constexpr double most_depth = 12e3;           // m: no sea is deeper
constexpr double time_slack = 1e-9;           // s: rounding of window ends
constexpr std::size_t history = 4;            // samples at or before the present: it and three for its slope

/// First and second derivative at the nodes of a smooth field on an even or uneven grid (three-point
/// formulas).
void differentiate(const std::vector<double>& x, const std::vector<double>& f, std::vector<double>& first,
                   std::vector<double>& second) {
    const std::size_t n = x.size();
    first.assign(n, 0.0), second.assign(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double left = x[i] - x[i - 1], right = x[i + 1] - x[i];
        const double down = (f[i] - f[i - 1]) / left, up = (f[i + 1] - f[i]) / right;
        first[i] = (down * right + up * left) / (left + right);
        second[i] = 2.0 * (up - down) / (left + right);
    }
    if (n > 2) {
        first[0] = first[1], second[0] = second[1];
        first[n - 1] = first[n - 2], second[n - 1] = second[n - 2];
    }
}

double longest_interval(const std::vector<double>& time) {
    double longest = 0;
    for (std::size_t k = 1; k < time.size(); ++k) longest = std::max(longest, time[k] - time[k - 1]);
    return longest;
}

}  // namespace

WaveField::WaveField(common::WindowReader& reader, double x0, double x1, double end)
    : reader_(reader), end_(end) {
    const common::Window& window = reader_.first();
    const auto x = window.at("/x").as_double(), depth = window.at("/still_water_depth").as_double();
    if (std::adjacent_find(x.begin(), x.end(), std::greater_equal<>()) != x.end())
        throw common::InputError(
            fmt::format("{}: dataset /x does not increase", reader_.path_of(0).string()));
    if (x.size() < 4 || x.front() > x0 || x.back() < x1)
        throw common::InputError(fmt::format(
            "the wave windows cover x = {:g} to {:g} m; the moving wall and its zone need {:g} to {:g} m "
            "(cmps.offshore, cmps.relaxation_length)",
            x.front(), x.back(), x0, x1));
    for (const double value : depth) deepest_ = std::max(deepest_, std::abs(value));
    if (!(deepest_ <= most_depth))
        throw common::InputError(
            fmt::format("{}: dataset /still_water_depth is {:g} m somewhere: no sea is "
                        "deeper than {:g} m",
                        reader_.path_of(0).string(), deepest_, most_depth));
    const auto above = [&](double at) {
        return static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin());
    };
    const std::size_t from = above(x0) > 3 ? above(x0) - 3 : 0, to = std::min(above(x1) + 3, x.size());
    first_node_ = from;
    x_.assign(x.begin() + static_cast<std::ptrdiff_t>(from), x.begin() + static_cast<std::ptrdiff_t>(to));
    depth_.assign(depth.begin() + static_cast<std::ptrdiff_t>(from),
                  depth.begin() + static_cast<std::ptrdiff_t>(to));
    std::vector<double> bed(depth_.size());
    for (std::size_t i = 0; i < bed.size(); ++i) bed[i] = -depth_[i];
    differentiate(x_, bed, bed_x_, bed_xx_);
    eta_.resize(x_.size()), u_.resize(x_.size());
    last_time_ = window.t_begin;
    sample_interval_ = longest_interval(window.at("/time").as_double());
}

void WaveField::check_depth(const std::function<double(double)>& depth) const {
    for (std::size_t i = 0; i < x_.size(); ++i) {
        const double wanted = depth(x_[i]);
        constexpr double share = 0.02;  // cells round off kinks of the bed
        if (std::abs(depth_[i] - wanted) > share * std::max(std::abs(wanted), std::abs(depth_[i])))
            throw common::InputError(
                fmt::format("{}: /still_water_depth is {:.4g} m at x = {:.4g} m, where flume.bed of the "
                            "scene leaves {:.4g} "
                            "m: these are the waves of another scene",
                            reader_.path_of(0).string(), depth_[i], x_[i], wanted));
    }
}

bool WaveField::receive_next() {
    const auto window = reader_.receive(next_index_);
    if (!window) return false;
    const auto time = window->at("/time").as_double();
    const auto eta = window->at("/surface_elevation").as_double(), u = window->at("/velocity").as_double();
    check_range(*window, "/surface_elevation", eta, most_elevation_ratio * deepest_);
    check_range(*window, "/velocity", u, most_speed_ratio * std::sqrt(gravity * deepest_));
    if (time.empty() || time.front() > window->t_begin + time_slack ||
        time.back() < window->t_end - time_slack)
        throw common::InputError(
            fmt::format("{}: dataset /time does not reach from t_begin = {:g} s to t_end = {:g} s",
                        reader_.path_of(next_index_).string(), window->t_begin, window->t_end));
    if (const double longest = longest_interval(time); longest > 1.001 * sample_interval_)
        throw common::InputError(fmt::format(
            "{}: dataset /time leaves {:.4g} s between two samples, the first window at most {:.4g} s",
            reader_.path_of(next_index_).string(), longest, sample_interval_));
    const std::size_t width = window->at("/x").size(), nodes = x_.size();
    for (std::size_t k = 0; k < time.size(); ++k) {
        if (!samples_.empty() && time[k] <= samples_.back().time + time_slack) continue;  // shared by windows
        const auto from = static_cast<std::ptrdiff_t>(k * width + first_node_);
        const auto to = from + static_cast<std::ptrdiff_t>(nodes);
        samples_.push_back({.time = time[k],
                            .elevation = {eta.begin() + from, eta.begin() + to},
                            .velocity = {u.begin() + from, u.begin() + to}});
    }
    last_time_ = window->t_end;
    ++next_index_;
    return true;
}

/// No waves in water, nor ground beside it, are that high or fast: a value damaged where no checksum sees it.
void WaveField::check_range(const common::Window& window, const std::string& name,
                            const std::vector<double>& values, double most) const {
    const auto bad =
        std::find_if(values.begin(), values.end(), [&](double value) { return !(std::abs(value) <= most); });
    if (bad == values.end()) return;
    throw common::InputError(
        fmt::format("{}: dataset {} is {:g} {} at element {}: no waves in water {:g} m deep exceed {:.3g}",
                    reader_.path_of(window.index).string(), name, *bad, window.at(name).unit,
                    bad - values.begin(), deepest_, most));
}

/// How many samples lie at or before `time`.
std::size_t WaveField::samples_until(double time) const {
    const auto after = std::upper_bound(samples_.begin(), samples_.end(), time + time_slack,
                                        [](double t, const Sample& sample) { return t < sample.time; });
    return static_cast<std::size_t>(after - samples_.begin());
}

void WaveField::cover(double t0, double t1) {
    t1 = std::min(t1, end_);
    if (samples_.empty()) {
        const auto index = reader_.index_at(t0);
        // slopes look three samples back: windows before t0 until they are there
        for (std::int64_t first = index.value_or(0); first >= 0; --first) {
            next_index_ = first;
            samples_.clear();
            while (next_index_ <= index.value_or(0) && receive_next()) {
            }
            if (samples_until(t0) >= history) break;
        }
    }
    while (samples_.empty() || last_time_ < t1 - time_slack)
        if (!receive_next())
            throw common::InputError(
                fmt::format("the wave windows end at t = {:g} s, but t = {:g} s is needed", last_time_, t1));
    // at the beginning of the waves slopes need what follows
    while (samples_.size() < history && receive_next()) {
    }
    const std::size_t past = samples_until(t0);
    if (past > history)
        samples_.erase(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(past - history));
}

double WaveField::arrival(double x, double threshold, double from) {
    const std::size_t nodes = x_.size();
    std::size_t node = 0;
    while (node + 1 < nodes && x_[node + 1] <= x) ++node;
    double found = -1;
    while (found < 0 && receive_next()) {
        for (const Sample& sample : samples_)
            if (sample.time >= from && std::abs(sample.elevation[node]) >= threshold) {
                found = sample.time;
                break;
            }
        samples_.clear();
    }
    next_index_ = 0;
    return found;
}

void WaveField::go_to(double time) {
    time = std::min(time, end_);
    const std::size_t count = samples_.size(), nodes = x_.size();
    if (count < 2) throw common::InputError("a wave window holds a single instant: nothing to interpolate");
    const std::size_t k = std::clamp<std::size_t>(samples_until(time), 1, count - 1) - 1;
    const double t0 = samples_[k].time, h = samples_[k + 1].time - t0;
    const double s = std::clamp((time - t0) / h, 0.0, 1.0);
    const double h00 = (1 + 2 * s) * (1 - s) * (1 - s), h10 = s * (1 - s) * (1 - s) * h;
    const double h01 = s * s * (3 - 2 * s), h11 = s * s * (s - 1) * h;
    const auto interpolate = [&](std::vector<double> Sample::*field, std::size_t i) {
        const auto at = [&](std::size_t m) { return (samples_[m].*field)[i]; };
        // of the cubic through sample m and the three before it, or the first four (divided differences)
        const auto slope = [&](std::size_t m) {
            const std::size_t points = std::min(count, history);
            std::size_t at_sample[history] = {m};
            const std::size_t highest = std::max(m, points - 1);
            for (std::size_t a = 1, n = highest; a < points; --n)
                if (n != m) at_sample[a++] = n;
            double difference[history], sum = 0, factor = 1;
            for (std::size_t a = 0; a < points; ++a) difference[a] = at(at_sample[a]);
            for (std::size_t order = 1; order < points; ++order) {
                for (std::size_t a = 0; a + order < points; ++a)
                    difference[a] = (difference[a] - difference[a + 1]) /
                                    (samples_[at_sample[a]].time - samples_[at_sample[a + order]].time);
                sum += factor * difference[0];
                factor *= samples_[m].time - samples_[at_sample[order]].time;
            }
            return sum;
        };
        return h00 * at(k) + h10 * slope(k) + h01 * at(k + 1) + h11 * slope(k + 1);
    };
    for (std::size_t i = 0; i < nodes; ++i) {
        eta_[i] = interpolate(&Sample::elevation, i);
        u_[i] = interpolate(&Sample::velocity, i);
    }
    differentiate(x_, u_, u_x_, u_xx_);
}

std::size_t WaveField::node_left_of(double x, double& share) const {
    std::size_t i = static_cast<std::size_t>(std::upper_bound(x_.begin(), x_.end(), x) - x_.begin());
    i = std::clamp<std::size_t>(i, 1, x_.size() - 1) - 1;
    share = (x - x_[i]) / (x_[i + 1] - x_[i]);
    return i;
}

double WaveField::surface_elevation(double x) const {
    double s;
    const std::size_t i = node_left_of(x, s);
    return (1 - s) * eta_[i] + s * eta_[i + 1];
}

double WaveField::mean_velocity(double x) const {  // eq. (6)
    double s;
    const std::size_t i = node_left_of(x, s);
    return (1 - s) * u_[i] + s * u_[i + 1];
}

double WaveField::still_water_depth(double x) const {
    double s;
    const std::size_t i = node_left_of(x, s);
    return (1 - s) * depth_[i] + s * depth_[i + 1];
}

void WaveField::velocity(double x, double z, double& u, double& w) const {
    double s;
    const std::size_t i = node_left_of(x, s);
    const auto at = [&](const std::vector<double>& f) { return (1 - s) * f[i] + s * f[i + 1]; };
    const double mean = at(u_), slope = at(u_x_), bed_slope = at(bed_x_);
    const double depth = at(depth_) + at(eta_), above_bed = z + at(depth_);
    u = mean - (0.5 * above_bed * above_bed - depth * depth / 6.0) * at(u_xx_) +
        (above_bed - 0.5 * depth) * (2.0 * bed_slope * slope + at(bed_xx_) * mean);
    w = -above_bed * slope + bed_slope * mean;
}

}  // namespace cmps
