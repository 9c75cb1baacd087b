/// Decides, before a run, which optional effects it needs, and says why.
#pragma once

#include "cmps/scene.hpp"

namespace cmps {

/// Fills scene.effects from [effects] and the scene.
void decide_effects(const common::SceneFile& file, Scene& scene);

}  // namespace cmps
