#include "cmps/gradient.hpp"

#include <algorithm>

#include "common/parallel.hpp"

namespace cmps {
namespace {

/// sum over pressure carriers of difference(i, j) r_ij w / r^2, times D/n0.
template <class Difference, class Finish>
void sweep(const Particles& particles, const NeighbourLists& lists, const Interactions& interactions,
           double n0, const Difference& difference, const Finish& finish) {
    const std::size_t first = particles.first_wall(), walls = particles.walls;
    const std::int32_t* const neighbour = lists.neighbour.data();
    const float* const dx = interactions.dx.data();
    const float* const dz = interactions.dz.data();
    const float* const g = interactions.weight_over_r2.data();
    common::parallel_for(particles.fluid, 2000, [&](std::size_t f) {
        const std::size_t row = walls + f, i = first + row;
        const std::size_t begin = lists.carriers[row], end = lists.start[row + 1];
        double x = 0, z = 0;
#pragma omp simd reduction(+ : x, z)
        for (std::size_t k = begin; k < end; ++k) {
            const double share = difference(i, static_cast<std::size_t>(neighbour[k])) * g[k];
            x += share * dx[k], z += share * dz[k];
        }
        finish(f, row, 2.0 / n0 * x, 2.0 / n0 * z);
    });
}

}  // namespace

Correction correction_of(const Interactions& interactions, std::size_t row, double n0) {
    const double xx = 2.0 / n0 * interactions.moment_xx[row], xz = 2.0 / n0 * interactions.moment_xz[row],
                 zz = 2.0 / n0 * interactions.moment_zz[row];
    const double determinant = xx * zz - xz * xz;
    if (determinant < 0.1 || xx + zz < 0.5) return {1, 0, 1};
    return {zz / determinant, -xz / determinant, xx / determinant};
}

void GradientTerm::find_local_minima(const Particles& particles, const NeighbourLists& lists,
                                     const Interactions& interactions) {
    minimum_ = particles.pressure;
    const std::size_t first = particles.first_wall();
    common::parallel_for(particles.size() - first, 2000, [&](std::size_t row) {
        double lowest = particles.pressure[first + row];
        for (std::size_t k = lists.carriers[row]; k < lists.start[row + 1]; ++k)
            if (interactions.weight[k] > 0) lowest = std::min(lowest, particles.pressure[lists.neighbour[k]]);
        minimum_[first + row] = lowest;
    });
}

/// p_i C_i of every carrier; walls, whose neighbourhood is one-sided, take the identity.
void GradientTerm::correct_pressures(const Particles& particles, const Interactions& interactions) {
    const std::size_t first = particles.first_wall(), rows = particles.size() - first;
    for (auto* array : {&pressure_xx_, &pressure_xz_, &pressure_zz_}) array->resize(rows);
    common::parallel_for(rows, 2000, [&](std::size_t row) {
        const Correction c =
            row < particles.walls ? Correction{1, 0, 1} : correction_of(interactions, row, lattice_density_);
        const double p = particles.pressure[first + row];
        pressure_xx_[row] = p * c.xx, pressure_xz_[row] = p * c.xz, pressure_zz_[row] = p * c.zz;
    });
}

void GradientTerm::evaluate_corrected_pairs(const Particles& particles, const NeighbourLists& lists,
                                            const Interactions& interactions, std::vector<double>& gradient_x,
                                            std::vector<double>& gradient_z) const {
    const std::size_t first = particles.first_wall(), walls = particles.walls;
    const double scale = 2.0 / lattice_density_;
    common::parallel_for(particles.fluid, 2000, [&](std::size_t f) {
        const std::size_t row = walls + f;
        const double xx = pressure_xx_[row], xz = pressure_xz_[row], zz = pressure_zz_[row];
        double x = 0, z = 0;
        for (std::size_t k = lists.carriers[row]; k < lists.start[row + 1]; ++k) {
            const std::size_t other = static_cast<std::size_t>(lists.neighbour[k]) - first;
            const double g = interactions.weight_over_r2[k];
            const double dx = g * interactions.dx[k], dz = g * interactions.dz[k];
            x += (xx + pressure_xx_[other]) * dx + (xz + pressure_xz_[other]) * dz;
            z += (xz + pressure_xz_[other]) * dx + (zz + pressure_zz_[other]) * dz;
        }
        gradient_x[f] = scale * x, gradient_z[f] = scale * z;
    });
}

void GradientTerm::evaluate(const Particles& particles, const NeighbourLists& lists,
                            const Interactions& interactions, std::vector<double>& gradient_x,
                            std::vector<double>& gradient_z) {
    gradient_x.resize(particles.fluid);
    gradient_z.resize(particles.fluid);
    const double* const p = particles.pressure.data();
    const auto store = [&](std::size_t f, std::size_t, double x, double z) {
        gradient_x[f] = x, gradient_z[f] = z;
    };
    const auto run = [&](const auto& difference, const auto& finish) {
        sweep(particles, lists, interactions, lattice_density_, difference, finish);
    };
    switch (kind_) {
        case Gradient::standard:  // eq. (1)
            find_local_minima(particles, lists, interactions);
            run([p, m = minimum_.data()](std::size_t i, std::size_t j) { return p[j] - m[i]; }, store);
            break;
        case Gradient::modified:  // eq. (4)
            find_local_minima(particles, lists, interactions);
            run([p, m = minimum_.data()](std::size_t i, std::size_t j) { return p[i] + p[j] - 2 * m[i]; },
                store);
            break;
        case Gradient::antisymmetric_local:  // eq. (5) as printed
            find_local_minima(particles, lists, interactions);
            run([p, m = minimum_.data()](std::size_t i, std::size_t j) { return p[i] + p[j] - m[i] - m[j]; },
                store);
            break;
        case Gradient::antisymmetric_global: {  // eq. (5) with the lowest pressure of the water
            const auto begin =
                particles.pressure.begin() + static_cast<std::ptrdiff_t>(particles.first_wall());
            const double lowest = particles.fluid ? *std::min_element(begin, particles.pressure.end()) : 0.0;
            run([p, lowest](std::size_t i, std::size_t j) { return p[i] + p[j] - 2 * lowest; }, store);
            break;
        }
        case Gradient::antisymmetric_corrected:
            correct_pressures(particles, interactions);
            evaluate_corrected_pairs(particles, lists, interactions, gradient_x, gradient_z);
            break;
        case Gradient::corrected:
            run([p](std::size_t i, std::size_t j) { return p[j] - p[i]; },
                [&](std::size_t f, std::size_t row, double x, double z) {
                    const Correction c = correction_of(interactions, row, lattice_density_);
                    gradient_x[f] = c.xx * x + c.xz * z, gradient_z[f] = c.xz * x + c.zz * z;
                });
            break;
    }
}

}  // namespace cmps
