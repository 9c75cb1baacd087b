/// Kernels and their constants on the square lattice.
///
/// `weight(r2)` is w(r), `slope(r2)` is w'(r)/r, `curvature(r2)` is w'' - w'/r (the higher-order Laplacian's
/// coefficient); all take the squared distance and are zero outside `radius`.
#pragma once

#include <cmath>

namespace cmps {

/// w = re/r - 1: the paper's generation (Koshizuka & Oka 1996).
struct RationalKernel {
    double radius;  ///< re, m
    double weight(double r2) const { return r2 < radius * radius ? radius / std::sqrt(r2) - 1.0 : 0.0; }
    double slope(double r2) const { return r2 < radius * radius ? -radius / (r2 * std::sqrt(r2)) : 0.0; }
    double curvature(double r2) const { return -3.0 * slope(r2); }
};

/// w = (1 - q)^4 (1 + 4 q), q = r/re: Wendland C2 without its factor.
struct WendlandKernel {
    double radius;  ///< re, m
    double weight(double r2) const {
        const double q = std::sqrt(r2) / radius;
        const double inside = q < 1.0 ? 1.0 - q : 0.0;
        const double square = inside * inside;
        return square * square * (1.0 + 4.0 * q);
    }
    double slope(double r2) const {
        const double q = std::sqrt(r2) / radius;
        const double inside = q < 1.0 ? 1.0 - q : 0.0;
        return -20.0 * inside * inside * inside / (radius * radius);
    }
    double curvature(double r2) const {
        const double q = std::sqrt(r2) / radius;
        const double inside = q < 1.0 ? 1.0 - q : 0.0;
        return 60.0 * q * inside * inside / (radius * radius);
    }
};

/// Sums over the full square lattice of spacing l0, the particle itself left out.
struct LatticeConstants {
    double number_density;    ///< n0 = sum w
    double lambda;            ///< sum w r^2 / n0, m^2
    double divergence_scale;  ///< -sum (w'/r) r^2 / (2 n0): what the raw higher-order source is too large by
    double laplacian_ratio;   ///< sum of the higher-order Laplacian's coefficients over n0
    double laplacian_scale;   ///< the same for the higher-order Laplacian: sum (w'' - w'/r) r^2 / (4 n0)
};

/// Computes the constants by summing over the lattice; `spacing` and the kernel's radius in m.
template <class Kernel>
LatticeConstants lattice_constants(const Kernel& kernel, double spacing) {
    const int reach = static_cast<int>(std::ceil(kernel.radius / spacing));
    double n0 = 0, moment = 0, slope_moment = 0, curvature_moment = 0, curvature = 0;
    for (int i = -reach; i <= reach; ++i)
        for (int k = -reach; k <= reach; ++k) {
            const double r2 = spacing * spacing * (i * i + k * k);
            if ((i == 0 && k == 0) || r2 >= kernel.radius * kernel.radius) continue;
            n0 += kernel.weight(r2);
            moment += kernel.weight(r2) * r2;
            slope_moment += kernel.slope(r2) * r2;
            curvature += kernel.curvature(r2);
            curvature_moment += kernel.curvature(r2) * r2;
        }
    return {.number_density = n0,
            .lambda = moment / n0,
            .divergence_scale = -slope_moment / (2.0 * n0),
            .laplacian_ratio = curvature / n0,
            .laplacian_scale = curvature_moment / (4.0 * n0)};
}

}  // namespace cmps
