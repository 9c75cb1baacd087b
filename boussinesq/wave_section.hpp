/// [waves] and [initial] of the scene: what comes in from offshore, or what is there at t = 0.
#pragma once

#include "boussinesq/scene.hpp"
#include "boussinesq/waves/wave_theory.hpp"

namespace boussinesq {

/// Fills scene.waves; notes every mistake in `file`. Needs scene.time and scene.bed.
void read_waves(const common::SceneFile& file, Scene& scene, const LinearDispersion& dispersion);

}  // namespace boussinesq
