/// Says how the stages of a chain stand.
#pragma once

#include <filesystem>

namespace coupler {

/// Prints how the chain in `folder` and its stages stand, from chain.json and the stages' run.json alone.
/// Throws InputError when there is none.
int show_status(const std::filesystem::path& folder);

}  // namespace coupler
