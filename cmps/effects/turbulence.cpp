#include "cmps/effects/turbulence.hpp"

#include <cmath>

#include "common/parallel.hpp"

namespace cmps {

void Turbulence::accelerate(NearField& field, double, double step) {
    Particles& particles = field.particles;
    const NeighbourLists& lists = field.search.lists();
    const Interactions& pairs = field.interactions;
    const std::size_t first = particles.first_fluid(), walls = particles.walls;
    const double n0 = field.lattice.number_density, length = constant_ * field.settings.spacing;
    eddy_viscosity_.resize(particles.fluid), du_.resize(particles.fluid), dw_.resize(particles.fluid);
    common::parallel_for(particles.fluid, 2000, [&](std::size_t f) {
        const std::size_t row = walls + f, i = first + f;
        double ux = 0, uz = 0, wx = 0, wz = 0;
        for (std::size_t k = lists.carriers[row]; k < lists.start[row + 1]; ++k) {
            const std::int32_t j = lists.neighbour[k];
            const double du = (particles.u[j] - particles.u[i]) * pairs.weight_over_r2[k];
            const double dw = (particles.w[j] - particles.w[i]) * pairs.weight_over_r2[k];
            ux += du * pairs.dx[k], uz += du * pairs.dz[k], wx += dw * pairs.dx[k], wz += dw * pairs.dz[k];
        }
        const Correction c = correction_of(pairs, row, n0);
        const double scale = 2.0 / n0;
        const double sxx = scale * (c.xx * ux + c.xz * uz), szz = scale * (c.xz * wx + c.zz * wz);
        const double sxz = 0.5 * scale * (c.xz * ux + c.zz * uz + c.xx * wx + c.xz * wz);
        eddy_viscosity_[f] = length * length * std::sqrt(2 * (sxx * sxx + szz * szz) + 4 * sxz * sxz);
    });
    const double factor = step * 4.0 / (field.lattice.lambda * n0);
    common::parallel_for(particles.fluid, 2000, [&](std::size_t f) {
        const std::size_t row = walls + f, i = first + f;
        double su = 0, sw = 0;
        for (std::size_t k = lists.carriers[row]; k < lists.start[row + 1]; ++k) {
            const std::size_t j = static_cast<std::size_t>(lists.neighbour[k]);
            if (j < first) continue;  // walls slip: the boundary layer is not resolved
            const double share = 0.5 * (eddy_viscosity_[f] + eddy_viscosity_[j - first]) * pairs.weight[k];
            su += share * (particles.u[j] - particles.u[i]), sw += share * (particles.w[j] - particles.w[i]);
        }
        du_[f] = factor * su, dw_[f] = factor * sw;
    });
    for (std::size_t f = 0; f < particles.fluid; ++f)
        particles.u[first + f] += du_[f], particles.w[first + f] += dw_[f];
}

}  // namespace cmps
