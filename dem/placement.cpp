#include "dem/placement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace dem {

double height_above(const FixedSpheres& mound, const Shape& shape, const Quaternion& orientation, double x,
                    double y) {
    const double reach = 0.5 * (shape.diameter + mound.diameter());
    const Rotation turn = orientation.toRotationMatrix();
    double height = -1e300;
    for (const int k : shape.exposed) {
        const Vector arm = turn * shape.spheres[static_cast<std::size_t>(k)];
        const double top = mound.highest_near(x + arm.x(), y + arm.y(), reach);
        if (std::isfinite(top)) height = std::max(height, top + reach - arm.z());
    }
    return height > -1e299 ? height : mound.highest() + reach - shape.low.z();
}

void place_blocks(Blocks& blocks, const ArmourPlan& plan, const FixedSpheres& mound) {
    const Shape& shape = blocks.shapes[static_cast<std::size_t>(plan.shape)];
    const Quaternion upright = shape.body_from_file.conjugate();
    // A tenth of a sphere apart: near enough not to gain speed, far enough not to overlap.
    const double gap = 0.1 * shape.diameter;
    const auto level_at = [&](double x, double y) {
        if (plan.level) return *plan.level;
        if (mound.empty()) return 0.0;
        return height_above(mound, shape, upright, x, y) + gap;
    };
    double mean_level = 0;
    for (std::size_t layer = 0; layer < plan.layers; ++layer)
        for (std::size_t row = 0; row < plan.rows; ++row)
            for (std::size_t column = 0; column < plan.columns; ++column) {
                const double x = plan.origin_x - static_cast<double>(row) * plan.pitch_across;
                const double y = plan.origin_y + static_cast<double>(column) * plan.pitch_along;
                const double z = level_at(x, y) + static_cast<double>(layer) * (shape.height + gap);
                if (layer == 0 && row == 0) mean_level += z / static_cast<double>(plan.columns);
                blocks.add(plan.shape, Vector(x, y, z), upright, false);
            }
    for (std::size_t row = 1; row <= plan.fixed_rows; ++row)
        for (std::size_t column = 0; column < plan.columns; ++column)
            blocks.add(
                plan.shape,
                Vector(plan.origin_x + static_cast<double>(row) * plan.pitch_across,
                       plan.origin_y + static_cast<double>(column) * plan.pitch_along, mean_level - 2 * gap),
                upright, true);
}

namespace {

/// Calls `visit` for every overlap of the listed pairs that concerns `only` (all blocks where it is the block
/// count).
template <class Visit>
void for_overlaps(const Blocks& blocks, const Surroundings& surroundings, std::size_t only,
                  const Visit& visit) {
    const PairList list(blocks, surroundings, 0.02 * (blocks.size() > 0 ? blocks.shape_of(0).diameter : 1.0));
    for (const auto& pair : list.pairs()) {
        if (only < blocks.size() && pair.block != only && pair.partner != only) continue;
        const double radius = 0.5 * blocks.shape_of(pair.block).diameter;
        const Vector shift(0, pair.image * surroundings.period, 0);
        for (const auto& candidate : list.candidates(pair)) {
            const Vector centre = blocks.sphere_centre(pair.block, candidate.a);
            double depth = 0;
            const char* kind = "";
            if (list.is_block(pair.partner)) {
                depth = radius + 0.5 * blocks.shape_of(pair.partner).diameter -
                        (blocks.sphere_centre(pair.partner, candidate.b) + shift - centre).norm();
            } else if (list.is_fixed_spheres(pair.partner)) {
                kind = "the mound or another fixed sphere";
                depth = radius + 0.5 * surroundings.fixed_spheres.diameter() -
                        (surroundings.fixed_spheres.centre_near(candidate.b, centre) - centre).norm();
            } else {
                kind = "a wall";
                const Plane& plane = list.plane(pair.partner);
                depth = radius - (centre - plane.point).dot(plane.normal);
            }
            if (depth > 0)
                visit(pair, depth,
                      list.is_block(pair.partner) ? fmt::format("block {}", pair.partner + 1)
                                                  : std::string(kind));
        }
    }
}

}  // namespace

Clash deepest_overlap(const Blocks& blocks, const Surroundings& surroundings, std::size_t only) {
    Clash deepest;
    for_overlaps(blocks, surroundings, only, [&](const Pair& pair, double depth, const std::string& partner) {
        if (depth > deepest.depth) deepest = {depth, pair.block, partner};
    });
    return deepest;
}

}  // namespace dem
