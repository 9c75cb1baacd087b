/// Runs the stages side by side and watches over them.
#pragma once

#include <filesystem>
#include <string>

#include "coupler/command_line.hpp"

namespace coupler {

/// Checks the scene with every stage, starts the stages so that each follows the one before, shows the board,
/// and writes chain.json. Returns the exit status of the contract. Throws InputError (scene, layout, folder
/// in use).
int run_chain(const Command& command);

}  // namespace coupler
