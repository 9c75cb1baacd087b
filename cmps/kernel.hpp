/// Kernels and their constants on the square lattice.
///
/// `weight(r2)` is w(r), `slope(r2)` is w'(r)/r, `curvature(r2)` is w'' - w'/r (the higher-order Laplacian's
/// coefficient); all take the squared distance and are zero outside `radius`. In the precision of their
/// argument.
#pragma once

#include <cmath>

namespace cmps {

/// w = re/r - 1: the paper's generation (Koshizuka & Oka 1996).
struct RationalKernel {
    double radius;  ///< re, m
    template <class Real>
    Real weight(Real r2) const {
        const Real re = static_cast<Real>(radius);
        return r2 < re * re ? re / std::sqrt(r2) - Real{1} : Real{0};
    }
    template <class Real>
    Real slope(Real r2) const {
        const Real re = static_cast<Real>(radius);
        return r2 < re * re ? -re / (r2 * std::sqrt(r2)) : Real{0};
    }
    template <class Real>
    Real curvature(Real r2) const {
        return Real{-3} * slope(r2);
    }
};

/// w = (1 - q)^4 (1 + 4 q), q = r/re: Wendland C2 without its factor.
struct WendlandKernel {
    double radius;  ///< re, m
    template <class Real>
    Real weight(Real r2) const {
        const Real q = std::sqrt(r2) * static_cast<Real>(1 / radius);
        const Real inside = q < Real{1} ? Real{1} - q : Real{0};
        const Real square = inside * inside;
        return square * square * (Real{1} + Real{4} * q);
    }
    template <class Real>
    Real slope(Real r2) const {
        const Real q = std::sqrt(r2) * static_cast<Real>(1 / radius);
        const Real inside = q < Real{1} ? Real{1} - q : Real{0};
        return static_cast<Real>(-20 / (radius * radius)) * inside * inside * inside;
    }
    template <class Real>
    Real curvature(Real r2) const {
        const Real q = std::sqrt(r2) * static_cast<Real>(1 / radius);
        const Real inside = q < Real{1} ? Real{1} - q : Real{0};
        return static_cast<Real>(60 / (radius * radius)) * q * inside * inside;
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
