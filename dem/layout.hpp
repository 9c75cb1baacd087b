/// Which spheres are joined by wires: single links between blocks, rows along the breakwater, columns across
/// it.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <optional>
#include <vector>

#include "dem/blocks.hpp"

namespace dem {

/// A link between two blocks before its spheres are chosen.
struct LinkRequest {
    std::uint32_t block_a, block_b;
    std::optional<std::array<std::uint32_t, 2>> spheres;  ///< one given pair; else pairs of the facing sides
    std::size_t wires = 0;                                ///< of the facing pairs, evenly chosen; 0: all
    std::optional<double> rest_length;                    ///< m; default: the distance when packed
    double slack = 0;                                     ///< added to the packed distance, m
    std::optional<double> stiffness;                      ///< N/m; default k_n
};

/// One wire: a sphere of one block and one of another.
struct WirePlace {
    std::uint32_t block_a, sphere_a, block_b, sphere_b;
    bool operator==(const WirePlace&) const = default;
    auto operator<=>(const WirePlace&) const = default;
};

/// The same wire with the lower block first.
WirePlace in_order(const WirePlace& place);

/// How much further in y the image of block b stands that is nearest to block a, m. `period`: width of the
/// periodic box; 0: none. A link joins a block to that image, for good.
double nearest_image(const Blocks& placed, std::uint32_t block_a, std::uint32_t block_b, double period);

/// Spheres of the sides of two blocks that face each other, paired by their place across the gap.
/// `placed`: blocks as they stand before packing, where sides are parallel.
std::vector<WirePlace> facing_spheres(const Blocks& placed, std::uint32_t block_a, std::uint32_t block_b,
                                      double period = 0);

/// The wires of one link.
std::vector<WirePlace> wires_of(const Blocks& placed, const LinkRequest& link, double period = 0);

}  // namespace dem
