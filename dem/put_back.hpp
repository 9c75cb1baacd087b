/// Blocks taken back to where they were packed, before a run goes on from an earlier one.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/blocks.hpp"
#include "dem/boundaries.hpp"
#include "dem/material.hpp"
#include "dem/pair_list.hpp"
#include "dem/snapshot.hpp"

namespace dem {

/// How far spheres may press into each other where a block is set down, m.
struct Pressing {
    double into_fixed;   ///< the mound, walls, fixed blocks
    double into_blocks;  ///< that can give way
};

/// Overlaps at which a Hertz contact bears the lightest block's weight (what packed blocks rest on), and 8
/// times that (a crane that pushes). With less force some blocks stay up on their neighbours, with more they
/// come no closer and push their neighbours farther: on the paper's scene, five seeds, 1, 3, 5, 8, 15, 22
/// weights leave the row 1.1, 0.84, 0.69, 0.54, 0.52, 0.60 mm from its place, the farthest block 15, 13, 13,
/// 4.4, 4.3, 5.4 mm.
Pressing pressing_of(const Blocks& blocks, const Material& material, double gravity);

/// Places those of the `chosen` blocks that have left their packed pose back in it, at rest, one by one in
/// the order of their numbers. Where something has moved into the gap since, a block stands beside its packed
/// place instead, unturned: by the smallest shift that leaves no deeper overlap than `pressing`, in whatever
/// direction. Returns the numbers of the blocks that were placed; the others stand where they were packed and
/// are left as they are. Throws common::RunError where a block does not fit back, not even three block
/// heights up.
std::vector<std::uint32_t> put_back(Blocks& blocks, const Surroundings& surroundings,
                                    const Pressing& pressing, const std::vector<std::uint32_t>& chosen,
                                    const PackedPoses& packed);

/// The contacts that `placed` blocks have no part in: what one remembers belongs to the place it was in.
std::vector<TouchingPair> contacts_without(const std::vector<TouchingPair>& contacts,
                                           const std::vector<std::uint32_t>& placed);

}  // namespace dem
