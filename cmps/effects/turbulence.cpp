#include "cmps/effects/turbulence.hpp"

#include <cmath>

#include "common/parallel.hpp"

namespace cmps {

void Turbulence::accelerate(NearField& field, double, double step) {
    Particles& particles = field.particles;
    const NeighbourLists& lists = field.search.lists();
    const Interactions& pairs = field.interactions;
    const std::size_t first = particles.first_fluid(), walls = particles.walls;
    const double* const u = particles.u.data();
    const double* const w = particles.w.data();
    const std::int32_t* const neighbour = lists.neighbour.data();
    const float* const dx = pairs.dx.data();
    const float* const dz = pairs.dz.data();
    const float* const weight = pairs.weight.data();
    const float* const weight_over_r2 = pairs.weight_over_r2.data();
    const double n0 = field.lattice.number_density, length = constant_ * field.settings.spacing;
    eddy_viscosity_.resize(particles.fluid), du_.resize(particles.fluid), dw_.resize(particles.fluid);
    common::parallel_for(particles.fluid, 2000, [&](std::size_t f) {
        const std::size_t row = walls + f;
        const double ui = u[first + f], wi = w[first + f];
        double ux = 0, uz = 0, wx = 0, wz = 0;
#pragma omp simd reduction(+ : ux, uz, wx, wz)
        for (std::size_t k = lists.carriers[row]; k < lists.start[row + 1]; ++k) {
            const double du = (u[neighbour[k]] - ui) * weight_over_r2[k];
            const double dw = (w[neighbour[k]] - wi) * weight_over_r2[k];
            ux += du * dx[k], uz += du * dz[k], wx += dw * dx[k], wz += dw * dz[k];
        }
        const Correction c = correction_of(pairs, row, n0);
        const double scale = 2.0 / n0;
        const double sxx = scale * (c.xx * ux + c.xz * uz), szz = scale * (c.xz * wx + c.zz * wz);
        const double sxz = 0.5 * scale * (c.xz * ux + c.zz * uz + c.xx * wx + c.xz * wz);
        eddy_viscosity_[f] = length * length * std::sqrt(2 * (sxx * sxx + szz * szz) + 4 * sxz * sxz);
    });
    const double* const viscosity = eddy_viscosity_.data();
    const auto start = static_cast<std::int32_t>(first);
    const double factor = step * 4.0 / (field.lattice.lambda * n0);
    common::parallel_for(particles.fluid, 2000, [&](std::size_t f) {
        const std::size_t row = walls + f, end = lists.start[row + 1];
        const double ui = u[first + f], wi = w[first + f], own = viscosity[f];
        std::size_t begin = lists.carriers[row];
        // walls slip: the boundary layer is not resolved
        while (begin < end && static_cast<std::size_t>(neighbour[begin]) < first) ++begin;
        double su = 0, sw = 0;
#pragma omp simd reduction(+ : su, sw)
        for (std::size_t k = begin; k < end; ++k) {
            const double share = 0.5 * (own + viscosity[neighbour[k] - start]) * weight[k];
            su += share * (u[neighbour[k]] - ui), sw += share * (w[neighbour[k]] - wi);
        }
        du_[f] = factor * su, dw_[f] = factor * sw;
    });
    for (std::size_t f = 0; f < particles.fluid; ++f)
        particles.u[first + f] += du_[f], particles.w[first + f] += dw_[f];
}

}  // namespace cmps
