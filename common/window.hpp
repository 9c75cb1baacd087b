/// A window: all samples of one stage with t_begin <= t <= t_end, both ends included.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/data_file.hpp"

namespace common {

struct Window {
    std::string stage;  ///< "boussinesq", "cmps", "dem"
    std::int64_t index = 0;
    double t_begin = 0, t_end = 0;  ///< s
    std::string scene_digest;       ///< of the keys this stage and those before it depend on
    std::string input_digest;       ///< scene digest of the upstream windows, empty for the first stage
    /// "/time", "/surface_elevation", "/gauges/<name>/time", ...
    std::map<std::string, Dataset> datasets;

    /// Throws InputError naming the dataset when absent.
    const Dataset& at(const std::string& name) const;
};

/// What a reader needs to find in a window; shapes are named so that equal names must agree.
/// For instance {"/surface_elevation", "m", {"nt", "nx"}}; a number as a word ("2") fixes an extent.
struct ExpectedDataset {
    std::string name, unit;
    std::vector<std::string> shape;
};

}  // namespace common
