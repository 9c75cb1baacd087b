/// The three verbs of the program.
#pragma once

#include "common/scene_file.hpp"
#include "common/stage_command.hpp"
#include "dem/scene.hpp"

namespace dem {

/// `dem check`: what would be simulated, why, and how long it would take; runs nothing.
void check(const common::StageCommand& command, const common::SceneFile& file, const Scene& scene);

/// Time at which a run would start, s: that of the flow or of the earlier state, 0 without either. Throws
/// common::InputError where they do not fit the scene.
double require_input(const common::StageCommand& command, const common::SceneFile& file, const Scene& scene);

/// `dem pack`: settles the blocks and stores the state.
void pack(const common::StageCommand& command, const common::SceneFile& file, const Scene& scene);

/// `dem run`: receive flow, advance, publish, window by window.
void run(const common::StageCommand& command, const common::SceneFile& file, const common::SceneFile* layout,
         const Scene& scene);

}  // namespace dem
