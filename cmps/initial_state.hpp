/// Where particles stand at the start: boundary layers behind every face, water column by column.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "cmps/particles.hpp"
#include "cmps/solid.hpp"

namespace cmps {

/// Boundary particles as dummies and walls, no fluid.
Particles make_boundary(const std::vector<BoundaryParticle>& placed);

/// What is free for water on the vertical line at x: intervals [z0, z1], m, from below.
using FreeIntervals = std::function<std::vector<std::array<double, 2>>(double)>;

/// Area within [x0, x1] of what `free` leaves, m2: exact for vertical faces, by lines l0/8 apart elsewhere.
double free_area(const Solid& solid, double spacing, double x0, double x1, const FreeIntervals& free);
/// Area of a polygon outside the solid, m2.
double free_area(const Solid& solid, double spacing, const Polygon& polygon);

/// Fills what `free` leaves between x0 and x1, column after column. Columns are about l0 wide, and a whole
/// number of them stands between any two vertical faces; each gets its area in particles, and the rounding of
/// one is carried to the next, so that count * l0^2 is the area of the water to within one particle.
void fill_water(const Solid& solid, double spacing, double x0, double x1, const FreeIntervals& free,
                Particles& particles);

/// Fills polygons of water the same way, each at its velocity (m/s; none: at rest).
void fill_polygons(const Solid& solid, double spacing, const std::vector<Polygon>& water,
                   const std::vector<Point>& velocity, Particles& particles);

/// Moves each particle of the water by rounding: 1e-12 of the spacing and two units in the last place of its
/// coordinates at most, as the seed and its identity say; none for the seed 0.
void perturb(Particles& particles, double spacing, std::int64_t seed);

}  // namespace cmps
