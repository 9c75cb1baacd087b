/// Mistakes of a scene that no single key shows: what stands where no water is, in the wall's way, or finer
/// than its particles. All are told by the section's problem(), with file, line and key.
#pragma once

#include <array>

#include "cmps/scene.hpp"

namespace cmps {

/// Smallest box around a polygon: x0, x1, z0, z1, m.
std::array<double, 4> bounding_box(const Polygon& polygon);

/// A tank has its own walls; only a piston may stand elsewhere in it.
void check_tank_ends(const common::Section& section, const Scene& scene);
/// Gauges that this stage alone could read, where it has no water. Surfaces outside the near field are the
/// waves' own.
void check_reach_of_gauges(const common::SceneFile& file, const Scene& scene);
/// False where places are so far from the origin that numbers hold them no better than to a nanometre.
bool check_distance_from_origin(const common::Section& section, const Scene& scene);
/// Gauges where no water can ever come, when the effects are decided: behind a structure with a basin or a
/// crest out of reach, in the solid from ground to sky, behind a piston, above all water.
void check_water_at_gauges(const common::SceneFile& file, const Scene& scene);
/// Of a scene whose polygons are sound: structure and water in their places, the moving wall's way free, no
/// body or gap that the particles cannot resolve, no gauge in the solid.
void check_geometry(const common::SceneFile& file, const common::Section& section, const Scene& scene);

}  // namespace cmps
