/// What the windows' samples lose of the waves for who follows them, and what that may be.
#pragma once

#include "boussinesq/scene.hpp"

namespace boussinesq {

/// Rms error over the rms elevation of the incident waves known every `interval` seconds and interpolated as
/// cmps does it. 0 where nothing is known of the waves.
double output_sampling_error(const Scene& scene, double interval);

/// Judges scene.output_interval: an error above the accuracy level's is refused where a near field follows
/// in the scene, else told like one above a tenth of it (scene.sampling_note). Needs a scene without
/// mistakes.
void check_output_sampling(const common::SceneFile& file, common::Accuracy accuracy, Scene& scene);

}  // namespace boussinesq
