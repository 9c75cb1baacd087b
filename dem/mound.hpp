/// The rubble mound: columns of fixed spheres under a mean profile, each shifted by a normal deviate.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dem/vector.hpp"

namespace dem {

using MoundProfile = std::vector<std::array<double, 2>>;

struct MoundDescription {
    MoundProfile profile;           ///< mean surface [x, z], m, x increasing
    double y_begin = 0, y_end = 1;  ///< m
    double roughness = 0;           ///< standard deviation of a column's height, m (paper: H_B / 3)
    double patch =
        0;  ///< side of the square patches of columns that share a height, m; 0: every column its own
    std::uint64_t seed = 1;
    double diameter = 0.008;   ///< of the spheres, and their pitch, m
    double least_depth = 0;    ///< columns reach at least this far down, m
    bool is_periodic = false;  ///< its two ends in y meet
};

/// Height of the mean surface at x, m; level beyond its ends.
double mean_height(const MoundProfile& profile, double x);

/// Sphere centres, column by column. The top of a column's highest sphere is its height. Columns are filled
/// downwards to the top of their lowest neighbour, so that no hole between two spheres lets another through.
std::vector<Vector> build_mound(const MoundDescription& description);

}  // namespace dem
