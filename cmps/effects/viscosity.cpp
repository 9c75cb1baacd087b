#include "cmps/effects/viscosity.hpp"

#include "common/parallel.hpp"

namespace cmps {

void Viscosity::accelerate(NearField& field, double, double step) {
    Particles& particles = field.particles;
    const NeighbourLists& lists = field.search.lists();
    const std::size_t first = particles.first_fluid(), walls = particles.walls;
    const double factor = step * kinematic_ * 4.0 / (field.lattice.lambda * field.lattice.number_density);
    du_.resize(particles.fluid), dw_.resize(particles.fluid);
    common::parallel_for(particles.fluid, 2000, [&](std::size_t f) {
        const std::size_t row = walls + f, i = first + f;
        double su = 0, sw = 0;
        for (std::size_t k = lists.start[row]; k < lists.start[row + 1]; ++k) {
            const std::int32_t j = lists.neighbour[k];
            su += field.interactions.weight[k] * (particles.u[j] - particles.u[i]);
            sw += field.interactions.weight[k] * (particles.w[j] - particles.w[i]);
        }
        du_[f] = factor * su, dw_[f] = factor * sw;
    });
    for (std::size_t f = 0; f < particles.fluid; ++f)
        particles.u[first + f] += du_[f], particles.w[first + f] += dw_[f];
}

}  // namespace cmps
