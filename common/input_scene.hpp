/// Whether windows were computed from the scene that is given now.
#pragma once

#include <filesystem>
#include <string>

#include "common/scene_file.hpp"

namespace common {

/// Compares `scene` with the keys recorded beside the windows in DIR, by the stage that wrote them and by
/// those before it. Throws InputError naming the keys that differ. Times of the simulation, gauges, the
/// title and the perturbation may differ: the windows' own times are checked as they are read, and the rest
/// changes nothing between stages.
///
/// Returns what to tell and to keep in run.json when the folder has no record of a scene (windows made by
/// hand), else nothing. `digest` is that of the windows: a record of another run is refused.
std::string require_same_scene(const SceneFile& scene, const std::filesystem::path& folder,
                               const std::string& digest);

}  // namespace common
