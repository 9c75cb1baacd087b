/// Where particles stand at the start: boundary layers behind every face, water column by column.
#pragma once

#include <functional>
#include <vector>

#include "cmps/particles.hpp"
#include "cmps/solid.hpp"

namespace cmps {

/// Boundary particles as dummies and walls, no fluid.
Particles make_boundary(const std::vector<BoundaryParticle>& placed);

/// Fills [x0, x1] between solid and `surface(x)` (m), column after column of width l0; the rounding of one
/// column is carried to the next, so that count * l0^2 is the area of the water to within one particle.
void fill_water(const Solid& solid, double spacing, double x0, double x1, double bottom,
                const std::function<double(double)>& surface, Particles& particles);

/// Fills polygons of water the same way; `velocity` (m/s) of each, or none: at rest.
void fill_polygons(const Solid& solid, double spacing, const std::vector<Polygon>& water,
                   const std::vector<Point>& velocity, Particles& particles);

}  // namespace cmps
