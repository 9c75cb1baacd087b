/// What a chain was run for, in one sentence: how many blocks moved, what became of the wires.
#pragma once

#include <filesystem>
#include <string>

namespace coupler {

/// From run.json of the folder that dem wrote; empty when there is none yet, or when dem has written no
/// window.
std::string answer_of(const std::filesystem::path& blocks_folder);

}  // namespace coupler
