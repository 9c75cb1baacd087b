#include "boussinesq/waves/wave_theory.hpp"

#include <cmath>
#include <limits>

#include "boussinesq/grid.hpp"

namespace boussinesq {

double LinearDispersion::wave_number(double angular_frequency, double depth) const {
    const double w = angular_frequency * angular_frequency * depth / gravity;
    if (!is_dispersive) return std::sqrt(w) / depth;
    // ((alpha-1)/3) X^2 + (1 - alpha w / 3) X - w = 0 with X = (k d)^2, written so that alpha = 1 is no
    // special case
    const double b = 1.0 - alpha * w / 3.0;
    const double root = b + std::sqrt(b * b + 4.0 * (alpha - 1.0) / 3.0 * w);
    return root > 0 ? std::sqrt(2.0 * w / root) / depth : std::numeric_limits<double>::quiet_NaN();
}

double LinearDispersion::angular_frequency(double wave_number, double depth) const {
    const double x = wave_number * wave_number * depth * depth;
    const double ratio = is_dispersive ? (1.0 + (alpha - 1.0) * x / 3.0) / (1.0 + alpha * x / 3.0) : 1.0;
    return wave_number * std::sqrt(gravity * depth * ratio);
}

double LinearDispersion::group_speed(double wave_number, double depth) const {
    const double step = 1e-5 * wave_number;
    return (angular_frequency(wave_number + step, depth) - angular_frequency(wave_number - step, depth)) /
           (2.0 * step);
}

double airy_wave_number(double angular_frequency, double depth) {
    const double w = angular_frequency * angular_frequency * depth / gravity;
    double x = w / std::sqrt(std::tanh(w));  // Eckart 1952: within 5 %
    for (int i = 0; i < 20; ++i) {           // Newton doubles the digits each time
        const double t = std::tanh(x);
        const double change = (x * t - w) / (t + x * (1.0 - t * t));
        x -= change;
        if (std::abs(change) < 1e-15 * x) break;
    }
    return x / depth;
}

double airy_group_speed(double wave_number, double depth) {
    const double x = wave_number * depth;
    const double speed = std::sqrt(gravity / wave_number * std::tanh(x));
    return 0.5 * speed * (1.0 + 2.0 * x / std::sinh(2.0 * x));
}

double largest_wave_height(double length, double depth) {
    const double r = length / depth;
    return depth * (0.141063 * r + 0.0095721 * r * r + 0.0077829 * r * r * r) /
           (1.0 + 0.0788340 * r + 0.0317567 * r * r + 0.0093407 * r * r * r);
}

}  // namespace boussinesq
