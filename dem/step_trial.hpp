/// Whether a scene's time step is one its contacts and wires can bear: found out before the run.
#pragma once

#include "common/scene_file.hpp"
#include "dem/scene.hpp"

namespace dem {

/// Largest stable step (s) once the placed blocks have come down on what is below them and the wires are
/// mounted: a trial of 0.06 s, at a step no longer than the program's own choice. Infinite where nothing
/// touches by then, or where so short a time would take more than 10,000 steps. What a block does later may
/// ask for less: the run watches that by itself.
StepLimit stable_step_after_landing(const Scene& scene);

/// Notes and throws (common::InputError) that dem.time_step is past that limit, by as much as would stop the
/// run at its second output. Returns the limit.
StepLimit require_stable_step(const common::SceneFile& file, const Scene& scene);

}  // namespace dem
