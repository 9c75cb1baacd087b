#include "cmps/free_surface.hpp"

#include <cmath>

#include "common/parallel.hpp"

namespace cmps {

void find_free_surface(const Particles& particles, const NeighbourLists& lists,
                       const Interactions& interactions, double n0, std::vector<Place>& place) {
    const std::size_t first = particles.first_wall(), rows = particles.size() - first,
                      walls = particles.walls;
    place.resize(rows);
    common::parallel_for(rows, 4000, [&](std::size_t r) {
        const double n = interactions.number_density[r];
        const double asymmetry = std::hypot(interactions.asymmetry_x[r], interactions.asymmetry_z[r]);
        const bool is_surface = n < 0.97 * n0 && (asymmetry > 0.18 * n0 || n < 0.5 * n0);
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
    common::parallel_for(rows, 4000, [&](std::size_t r) {
        if (place[r] != Place::inside) return;
        for (std::size_t k = lists.carriers[r]; k < lists.start[r + 1]; ++k) {
            const std::size_t other = static_cast<std::size_t>(lists.neighbour[k]) - first;
            if (interactions.weight[k] > 0 && place[other] >= Place::surface && other >= walls) {
                place[r] = Place::near_surface;
                return;
            }
        }
    });
}

}  // namespace cmps
