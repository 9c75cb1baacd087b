/// Which particles lie at the free surface (pressure zero), and which next to it.
///
/// Surface: n < 0.97 n0 and (F > 0.18 F0 or n < 0.5 n0), F = |sum w r_ij / r|, F0 = n0. The density alone is
/// wrong for wide kernels: with re = 3.1 l0 the second row of a flat surface has 0.918 n0. F is 0.29 F0 in
/// the first row and 0.074 F0 in the second.
#pragma once

#include <cstdint>
#include <vector>

#include "cmps/interactions.hpp"

namespace cmps {

enum class Place : std::uint8_t {
    inside,        ///< pressure unknown
    near_surface,  ///< pressure unknown; a surface particle is within the kernel
    surface,       ///< at the surface
    dry            ///< a wall that touches no water, or a lone particle: pressure zero
};

/// One entry per pressure carrier.
void find_free_surface(const Particles& particles, const NeighbourLists& lists,
                       const Interactions& interactions, double lattice_density, std::vector<Place>& place);

}  // namespace cmps
