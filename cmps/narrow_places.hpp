/// What particles of a given spacing cannot resolve: bodies so thin that one row of wall particles would have
/// to carry the pressures of both their sides, gaps so narrow that no two particles fit side by side.
#pragma once

#include <optional>

#include "cmps/solid.hpp"

namespace cmps {

struct NarrowPlace {
    Point at;               ///< on the face of `body`, m
    double width;           ///< m
    std::int32_t body;      ///< whose face it is
    std::int32_t opposite;  ///< whose face lies across
};

/// Bodies must be this many spacings thick, or as thick as the kernel's radius where that is more: the force
/// on a wall between 0.3 and 0.1 m of water is 0.46, 0.86, 0.99 and 1.00 of the right one at 1.75, 2.25, 2.5
/// and 3.
constexpr double least_thickness = 3.0;
/// Gaps must be this many spacings wide, or so narrow that they are meant to be closed: coordinates are
/// rounded.
constexpr double least_gap = 1.5, closed_gap = 0.02;

/// The thinnest place below `top` (m) that is thinner than `least` (m); nothing where there is none. The tip
/// of a wedge of 12 degrees and more is not one: its walls are filled to the tip.
std::optional<NarrowPlace> thinnest_body(const Solid& solid, double least, double spacing, double top);
/// The narrowest gap between two faces below `top` (m), of those narrower than `least_gap` spacings; corners
/// of 12 degrees and more are none.
std::optional<NarrowPlace> narrowest_gap(const Solid& solid, double spacing, double top);

}  // namespace cmps
