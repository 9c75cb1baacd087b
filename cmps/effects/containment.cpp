#include "cmps/effects/containment.hpp"

#include <cmath>

namespace cmps {

void Containment::end_step(NearField& field, double, double) {
    Particles& particles = field.particles;
    const NeighbourLists& lists = field.search.lists();
    const std::size_t first = particles.first_fluid(), walls = particles.walls;
    const double l0 = field.settings.spacing,
                 near2 = 6.25 * l0 * l0;  // a sharp tip has no wall particle nearer
    for (std::size_t f = 0; f < particles.fluid; ++f) {
        const std::size_t i = first + f, row = walls + f;
        bool is_near = false;
        for (std::size_t k = lists.start[row]; k < lists.start[row + 1]; ++k) {
            if (particles.is_fluid(static_cast<std::size_t>(lists.neighbour[k]))) break;
            const double dx = field.interactions.dx[k], dz = field.interactions.dz[k];
            if (dx * dx + dz * dz < near2) {
                is_near = true;
                break;
            }
        }
        if (!is_near || !solid_.contains(particles.x[i], particles.z[i])) continue;
        std::size_t nearest = 0;
        const double depth = solid_.distance(particles.x[i], particles.z[i], nearest) + 0.05 * l0;
        const Point& normal = solid_.surface()[nearest].normal;
        particles.x[i] += depth * normal[0], particles.z[i] += depth * normal[1];
        const double inward = particles.u[i] * normal[0] + particles.w[i] * normal[1];
        if (inward < 0) particles.u[i] -= inward * normal[0], particles.w[i] -= inward * normal[1];
        ++returned_;
    }
}

}  // namespace cmps
