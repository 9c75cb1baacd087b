/// Asks every stage whether it can run the scene, before any of them starts.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "coupler/command_line.hpp"
#include "coupler/stages.hpp"

namespace coupler {

/// Folder of the programs: the one this program was started from.
std::filesystem::path program_folder();

/// The stages the scene calls for: those with a section of their own, and boussinesq, which needs none.
/// Throws InputError when the scene cannot be read, or has [dem] without [cmps].
std::vector<StagePlace> stages_of(const Command& command);

/// Runs `<stage> check` for each stage. Throws InputError with one line per mistake (each once, although
/// several stages may see it), RunError when a check itself fails.
void check_scene(const Command& command, std::span<const StagePlace> stages);

/// "--set KEY=VALUE" words of the command line, to hand on.
std::vector<std::string> override_words(const Command& command);

}  // namespace coupler
