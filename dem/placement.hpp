/// Where blocks stand before they settle.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dem/blocks.hpp"
#include "dem/boundaries.hpp"
#include "dem/pair_list.hpp"

namespace dem {

/// A grid of upright blocks, numbered row by row from the shore.
struct ArmourPlan {
    int shape;
    std::size_t rows, columns, layers, fixed_rows;
    double origin_x, origin_y;         ///< of block 1, m
    double pitch_across, pitch_along;  ///< m
    std::optional<double> level;       ///< of all centres, m; else each block just above the mound
};

/// Appends the blocks of `plan`: layer by layer, row by row, column by column; the fixed rows come last and
/// stand on the mean level of the row beside them.
void place_blocks(Blocks& blocks, const ArmourPlan& plan, const FixedSpheres& mound);

/// Lowest height of a block's centre at x, y where none of its spheres touches the mound; its orientation is
/// upright.
double height_above(const FixedSpheres& mound, const Shape& shape, const Quaternion& orientation, double x,
                    double y);

/// The deepest overlap of blocks with each other or with what is fixed.
struct Clash {
    double depth = 0;  ///< m
    std::size_t block = 0;
    std::string partner;
};
/// `only`: pairs of this block alone; every pair where it is no block.
Clash deepest_overlap(const Blocks& blocks, const Surroundings& surroundings,
                      std::size_t only = ~std::size_t{0});

}  // namespace dem
