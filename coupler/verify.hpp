/// Reads all of a chain's files and checks that they agree.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/shared_sections.hpp"
#include "coupler/stages.hpp"

namespace coupler {

/// What a stage's folder was found to hold.
struct FolderReport {
    std::string stage;
    std::string folder;
    std::int64_t windows = 0;
    double t_begin = 0, t_end = 0;  ///< s, of the windows that could be read
    std::string scene_digest, input_digest;
    std::vector<std::string> faults;  ///< a line each; empty: all is well
};

/// Every window readable and as the contract says, none missing, each beginning where the one before ends,
/// one digest, run.json done with its invariants within their bounds.
FolderReport verify_folder(const std::filesystem::path& folder, const std::string& stage);

/// Adds faults of `report` against the folder it was computed from: digests chain, and its time lies inside.
void verify_input(FolderReport& report, const FolderReport& upstream);

/// Verifies the chain in `folder`, prints a line a folder and a line a fault. Exit status 0, or 1 with any
/// fault. Throws InputError when there is no chain.
int verify_chain(const std::filesystem::path& folder);

}  // namespace coupler
