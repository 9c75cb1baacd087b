/// run.json as others read it: how a stage stands or ended, and whether its invariants held.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/run_record.hpp"

namespace common {

/// What run.json says.
struct RunSummary {
    std::string stage, status, message, scene_digest, input_digest;
    std::int64_t windows = 0;
    double wall_time = 0;    ///< s
    double cpu_time = 0;     ///< s
    double peak_memory = 0;  ///< bytes
    std::vector<InvariantRecord> invariants;
    std::map<std::string, double> figures;  ///< by dotted name: "damage.number"; series and nulls left out
};

/// Nothing when DIR holds no run.json; throws InputError when it is not a run record.
std::optional<RunSummary> read_run_summary(const std::filesystem::path& folder);

/// True where the invariant's value is finite and within its bound.
bool holds(const InvariantRecord& invariant);

}  // namespace common
