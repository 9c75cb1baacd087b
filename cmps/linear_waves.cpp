#include "cmps/linear_waves.hpp"

#include <cmath>

namespace cmps {
namespace {

constexpr double two_pi = 6.283185307179586;

double group_speed(double period, double depth) {
    const double c = phase_speed(period, depth), twice = 2 * two_pi / (period * c) * depth;  // 2 k h
    return 0.5 * c * (twice > 100 ? 1.0 : 1.0 + twice / std::sinh(twice));
}

}  // namespace

double phase_speed(double period, double depth, double gravity) {
    const double omega = two_pi / period;
    double k = omega / std::sqrt(gravity * depth) + omega * omega / gravity;  // above the root
    for (int i = 0; i < 50; ++i) {  // Newton's method on omega^2 = g k tanh(k h)
        const double t = std::tanh(k * depth), before = k;
        k -= (gravity * k * t - omega * omega) / (gravity * t + gravity * k * depth * (1 - t * t));
        if (k == before) break;
    }
    return omega / k;
}

double shoaling(double period, double from, double depth) {
    if (period == 0) return std::pow(from / depth, 0.25);
    return std::sqrt(group_speed(period, from) / group_speed(period, depth));
}

}  // namespace cmps
