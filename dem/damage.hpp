/// What the waves did: displacement of each block from where it was packed, and damage counts.
#pragma once

#include <array>
#include <vector>

#include "dem/blocks.hpp"

namespace dem {

/// Displacement of one block since packing.
struct Displacement {
    double total;     ///< m
    double offshore;  ///< towards smaller x, m
    double rotation;  ///< rad
};

/// Counts over the blocks that are free to move.
struct Damage {
    static constexpr std::array<double, 3> levels{0.25, 0.5, 1.0};  ///< displacement over block length
    std::size_t free_blocks = 0;
    std::array<std::size_t, 3> moved{};  ///< blocks beyond each level
    /// N_od = blocks moved beyond half a length / (width / block length); of blocks of several lengths, each
    /// counts with its own.
    double number = 0;
    double mean_displacement = 0, mean_offshore = 0, largest_displacement = 0;  ///< m
};

std::vector<Displacement> displacements(const Blocks& blocks, const std::vector<Vector>& packed_position,
                                        const std::vector<Quaternion>& packed_orientation);

/// `width` of the armour along the breakwater, m; 0: no damage number.
Damage assess_damage(const Blocks& blocks, const std::vector<Displacement>& moved, double width);

}  // namespace dem
