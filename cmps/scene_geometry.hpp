/// What the scene's polygons make: the solid, the bed's level, where water ends, the particles at the start.
#pragma once

#include "cmps/particles.hpp"
#include "cmps/scene.hpp"
#include "cmps/solid.hpp"
#include "cmps/wave_field.hpp"

namespace cmps {

/// Bed, structure and end walls of a scene. Tanks are closed on four sides.
Solid make_solid(const Scene& scene);
/// Bed level at x (m); of a tank its floor.
double bottom_level(const Scene& scene, double x);
/// Lowest level of the bed or the tank's floor, m.
double lowest_bottom(const Scene& scene);
/// Where still water behind the moving wall ends: the first x at which the solid stands above z = 0, or
/// `onshore`.
double end_of_water(const Scene& scene, const Solid& solid);
/// x (m) behind which water counts as overtopped: the rear of whatever stands above still water.
double rear_of_structure(const Scene& scene);

/// Particles over the scene's geometry at the start; surface and velocity from the waves when they are given.
Particles initial_particles(const Scene& scene, const Solid& solid, const WaveField* waves);

}  // namespace cmps
