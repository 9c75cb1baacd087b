/// The three verbs of the program.
#pragma once

#include "common/scene_file.hpp"
#include "common/stage_command.hpp"
#include "dem/scene.hpp"

namespace dem {

/// `dem check`: what would be simulated, why, and how long it would take; runs nothing.
void check(const common::StageCommand& command, const common::SceneFile& file, const Scene& scene);

/// Throws common::InputError where the flow or the earlier state that a run would start from does not fit the
/// scene; nothing when neither is given.
void require_input(const common::StageCommand& command, const Scene& scene);

/// `dem pack`: settles the blocks and stores the state.
void pack(const common::StageCommand& command, const common::SceneFile& file, const Scene& scene);

/// `dem run`: receive flow, advance, publish, window by window.
void run(const common::StageCommand& command, const common::SceneFile& file, const common::SceneFile* layout,
         const Scene& scene);

}  // namespace dem
