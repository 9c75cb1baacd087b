#include "boussinesq/waves/bound_waves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "boussinesq/grid.hpp"

namespace boussinesq {

BoundPair bound_pair(const LinearDispersion& dispersion, double depth, double k1, double k2, int sign) {
    const double s = sign, d = depth, alpha = dispersion.alpha;
    if (sign < 0 && std::abs(k1 - k2) < 1e-4 * (k1 + k2)) {  // 0/0: the limit, to the square of this
        const double middle = 0.5 * (k1 + k2);
        k1 = middle * (1.0 + 1e-4), k2 = middle * (1.0 - 1e-4);
    }
    const double w1 = dispersion.angular_frequency(k1, d), w2 = dispersion.angular_frequency(k2, d);
    const double u1 = w1 / (k1 * d), u2 = w2 / (k2 * d);  // velocity of unit amplitude
    const auto acceleration = [&](double k) {             // D = -this * sin(phase)
        return gravity / alpha * k / (1.0 + alpha * k * k * d * d / 3.0);
    };
    const double a1 = acceleration(k1), a2 = acceleration(k2);
    const double K = k1 + s * k2, W = w1 + s * w2;
    const double denominator = 1.0 + alpha * K * K * d * d / 3.0;
    // The products of first order on the right of the equations of water, momentum and D:
    const double flux = 0.25 * (u1 + u2);                 // (eta u) = flux cos
    const double head = 0.25 * u1 * u2;                   // u^2 / 2 = head cos
    const double forcing =                                // of D, sin
        -0.25 * gravity / alpha * K                       // eta (g/alpha) eta_x
        + 0.25 * (a1 + s * a2)                            // - eta D
        + 0.25 * alpha * d * d * K * (a1 * k1 + a2 * k2)  // alpha d^2 (eta D_x)_x
        + s / 3.0 * d * d * d * K * u1 * k1 * u2 * k2;    // (2/3) d^3 (u_x^2)_x
    const double free_square =
        gravity * d * K * K * (1.0 + (alpha - 1.0) * K * K * d * d / 3.0) / denominator;
    const double elevation =
        (K * d * (K * head - forcing / (d * denominator)) + K * W * flux) / (W * W - free_square);
    return {elevation, (W * elevation - K * flux) / (K * d)};
}

BoundWaves bound_waves(const LinearDispersion& dispersion, double depth,
                       const std::vector<double>& wave_numbers, const std::vector<double>& amplitudes) {
    constexpr int points = 10;  // all pairs to 1e-4 (tested)
    const auto [low, high] = std::minmax_element(wave_numbers.begin(), wave_numbers.end());
    const double middle = 0.5 * (*low + *high), half = std::max(0.5 * (*high - *low), 1e-6 * middle);
    Eigen::VectorXd node(points), weight(points);  // Chebyshev points, barycentric weights
    for (int p = 0; p < points; ++p) {
        const double angle = std::numbers::pi * (p + 0.5) / points;
        node[p] = middle + half * std::cos(angle);
        weight[p] = (p % 2 == 0 ? 1.0 : -1.0) * std::sin(angle);
    }
    BoundWaves bound;
    const auto count = static_cast<Eigen::Index>(wave_numbers.size());
    bound.share.resize(points, count);
    for (Eigen::Index n = 0; n < count; ++n) {
        const double k = wave_numbers[static_cast<std::size_t>(n)];
        const double amplitude = amplitudes[static_cast<std::size_t>(n)];
        Eigen::VectorXd share(points);
        for (int p = 0; p < points; ++p) {
            const double way = k - node[p];
            share[p] = weight[p] / (way == 0.0 ? 1e-15 * middle : way);
        }
        bound.share.col(n) = amplitude * share / share.sum();
        const BoundPair itself = bound_pair(dispersion, depth, k, k, -1);
        const double velocity = dispersion.angular_frequency(k, depth) / (k * depth);
        bound.mean_elevation += itself.elevation * amplitude * amplitude;
        bound.mean_velocity += (itself.velocity + 0.5 * velocity / depth) * amplitude * amplitude;
    }
    for (auto* matrix :
         {&bound.elevation_real, &bound.elevation_imaginary, &bound.velocity_real, &bound.velocity_imaginary})
        matrix->resize(points, points);
    for (int p = 0; p < points; ++p)
        for (int q = 0; q < points; ++q) {
            const BoundPair sum = bound_pair(dispersion, depth, node[p], node[q], 1);
            const BoundPair difference = bound_pair(dispersion, depth, node[p], node[q], -1);
            bound.elevation_real(p, q) = difference.elevation + sum.elevation;
            bound.elevation_imaginary(p, q) = difference.elevation - sum.elevation;
            bound.velocity_real(p, q) = difference.velocity + sum.velocity;
            bound.velocity_imaginary(p, q) = difference.velocity - sum.velocity;
        }
    return bound;
}

}  // namespace boussinesq
