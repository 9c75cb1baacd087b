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
/// Level of the highest water at the start, m.
double highest_water(const Scene& scene);
/// Level that no water reaches, m: walls end there.
double out_of_reach(const Scene& scene);
/// Where still water behind the moving wall ends: the first x at which the solid fills all from the bed to
/// z = 0, or `onshore`. Water passes under what hangs free of the bed.
double end_of_water(const Scene& scene, const Solid& solid);
/// Polygons of the structure that stand above z = 0 and let no water pass below it.
std::vector<std::size_t> barriers(const Scene& scene, const Solid& solid);
/// x (m) behind which water counts as overtopped: the rear of the barrier farthest shoreward, or `onshore`.
double rear_of_structure(const Scene& scene, const Solid& solid);

/// Area of the water at the start, m2.
double initial_area(const Scene& scene, const Solid& solid, const WaveField* waves);
/// Particles over the scene's geometry at the start; surface and velocity from the waves when they are given.
Particles initial_particles(const Scene& scene, const Solid& solid, const WaveField* waves);

}  // namespace cmps
