#include "boussinesq/waves/solitary_wave.hpp"

#include <fmt/format.h>

#include <cmath>

#include "boussinesq/grid.hpp"
#include "common/errors.hpp"

namespace boussinesq {
namespace {

/// p = h'^2 at rest for a wave of the given speed, started with p = 0 at the crest; depth and gravity are 1.
double slope_at_rest(double alpha, double height, double speed) {
    const double m2 = speed * speed, constant = m2 + 0.5;
    const auto change = [&](double h, double p) {
        const double carry = m2 - (1.0 - 1.0 / alpha) * h * h * h;
        return -6.0 / (alpha * carry) * (m2 / h + 0.5 * h * h - constant + (2.0 / 3.0 - alpha) * m2 / h * p);
    };
    constexpr int steps = 400;  // fourth order: 1e-11 of the slope
    const double dh = -height / steps;
    double p = 0;
    for (int i = 0; i < steps; ++i) {
        const double h = 1.0 + height + i * dh;
        const double k1 = change(h, p), k2 = change(h + 0.5 * dh, p + 0.5 * dh * k1);
        const double k3 = change(h + 0.5 * dh, p + 0.5 * dh * k2), k4 = change(h + dh, p + dh * k3);
        p += dh / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    return p;
}

}  // namespace

double solitary_speed(double alpha, double height, double depth) {
    const double scaled = height / depth;
    double low = std::sqrt(1.0 + 0.25 * scaled), high = std::sqrt(1.0 + 2.0 * scaled);
    const bool rises = slope_at_rest(alpha, scaled, high) > slope_at_rest(alpha, scaled, low);
    if (slope_at_rest(alpha, scaled, low) * slope_at_rest(alpha, scaled, high) > 0.0)
        throw common::InputError(fmt::format(
            "the equations carry no solitary wave of height {} m in {} m of water", height, depth));
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        ((slope_at_rest(alpha, scaled, middle) > 0.0) == rises ? high : low) = middle;
    }
    return 0.5 * (low + high) * std::sqrt(gravity * depth);
}

SolitaryWave::SolitaryWave(double alpha, double height, double depth, double position)
    : height_(height), depth_(depth), position_(position), speed_(solitary_speed(alpha, height, depth)) {
    const double m2 = speed_ * speed_ / (gravity * depth), constant = m2 + 0.5;
    const double share = 1.0 - 1.0 / alpha;
    // linear tail: (alpha/3)(m^2 - share) kappa^2 = m^2 - 1
    decay_ = std::sqrt(3.0 * (m2 - 1.0) / (alpha * (m2 - share))) / depth;
    step_ = 0.01 / decay_;
    const auto bend = [&](double h, double slope) {
        return (constant - m2 / h - 0.5 * h * h - (2.0 / 3.0 - alpha) * m2 / h * slope * slope) * 3.0 /
               (alpha * (m2 - share * h * h * h));
    };
    // Outward from the crest; rounding grows as the wave decays, so the tail below 1e-5 H is the linear one.
    double h = 1.0 + height / depth, slope = 0;
    const double dx = step_ / depth;
    while (h - 1.0 > 1e-5 * height / depth && table_.size() < 100000) {
        table_.push_back((h - 1.0) * depth);
        const double k1 = slope, l1 = bend(h, slope);
        const double k2 = slope + 0.5 * dx * l1, l2 = bend(h + 0.5 * dx * k1, k2);
        const double k3 = slope + 0.5 * dx * l2, l3 = bend(h + 0.5 * dx * k2, k3);
        const double k4 = slope + dx * l3, l4 = bend(h + dx * k3, k4);
        h += dx / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        slope += dx / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
    }
}

double SolitaryWave::elevation(double distance_from_crest) const {
    const double place = std::abs(distance_from_crest) / step_;
    const auto entry = static_cast<std::size_t>(place);
    if (entry + 2 >= table_.size()) {
        const double last = static_cast<double>(table_.size() - 2);
        return table_[table_.size() - 2] * std::exp(-decay_ * step_ * (place - last));
    }
    const double s = place - static_cast<double>(entry);
    const double before = table_[entry == 0 ? 1 : entry - 1];  // even about the crest
    const double a = table_[entry], b = table_[entry + 1], after = table_[entry + 2];
    return a + 0.5 * s *
                   (b - before +
                    s * (2.0 * before - 5.0 * a + 4.0 * b - after + s * (3.0 * (a - b) + after - before)));
}

double SolitaryWave::reach(double share) const {
    double distance = 0;
    while (elevation(distance) > share * height_) distance += step_;
    return distance;
}

void SolitaryWave::at(double t, std::span<const double> x, std::span<double> elevation_out,
                      std::span<double> velocity) const {
    for (std::size_t i = 0; i < x.size(); ++i) {
        elevation_out[i] = elevation(x[i] - position_ - speed_ * t);
        velocity[i] = speed_ * elevation_out[i] / (depth_ + elevation_out[i]);
    }
}

}  // namespace boussinesq
