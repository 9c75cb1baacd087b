#include "cmps/free_surface.hpp"

#include "common/parallel.hpp"

namespace cmps {

void find_free_surface(const Particles& particles, const NeighbourLists& lists,
                       const Interactions& interactions, double n0, std::vector<Place>& place) {
    const std::size_t first = particles.first_wall(), rows = particles.size() - first,
                      walls = particles.walls;
    place.resize(rows);
    common::parallel_for(rows, 4000, [&](std::size_t r) {
        const double n = interactions.number_density[r];
        const double fx = interactions.asymmetry_x[r], fz = interactions.asymmetry_z[r];
        const double limit = 0.18 * n0;
        const bool is_surface = n < 0.97 * n0 && (fx * fx + fz * fz > limit * limit || n < 0.5 * n0);
        place[r] = is_surface ? Place::surface : Place::inside;
        if (r >= walls) {
            if (n < 0.1 * n0) place[r] = Place::dry;  // less than one neighbour in reach
            return;
        }
        double water = 0;
        for (std::size_t k = lists.start[r + 1]; k-- > lists.start[r];) {
            if (!particles.is_fluid(static_cast<std::size_t>(lists.neighbour[k]))) break;
            water += interactions.weight[k];
        }
        if (water <= 0.02 * n0) place[r] = Place::dry;
    });
    // from the few at the surface to those around them: lists hold every pair twice
    for (std::size_t r = walls; r < rows; ++r) {
        if (place[r] < Place::surface) continue;
        for (std::size_t k = lists.carriers[r]; k < lists.start[r + 1]; ++k) {
            Place& other = place[static_cast<std::size_t>(lists.neighbour[k]) - first];
            if (interactions.weight[k] > 0 && other == Place::inside) other = Place::near_surface;
        }
    }
}

}  // namespace cmps
