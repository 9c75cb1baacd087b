#include "dem/layout.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem {

namespace {

/// Spheres on the side of a block that looks along `direction` (world), within half a sphere of the outermost
/// one.
std::vector<std::uint32_t> side_spheres(const Blocks& placed, std::uint32_t block, const Vector& direction) {
    const Shape& shape = placed.shape_of(block);
    std::vector<std::uint32_t> side;
    double farthest = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < shape.spheres.size(); ++k)
        farthest = std::max(farthest, placed.arm(block, k).dot(direction));
    for (std::size_t k = 0; k < shape.spheres.size(); ++k)
        if (placed.arm(block, k).dot(direction) > farthest - 0.5 * shape.diameter)
            side.push_back(static_cast<std::uint32_t>(k));
    return side;
}

}  // namespace

WirePlace in_order(const WirePlace& place) {
    if (place.block_a <= place.block_b) return place;
    return {place.block_b, place.sphere_b, place.block_a, place.sphere_a};
}

double nearest_image(const Blocks& placed, std::uint32_t block_a, std::uint32_t block_b, double period) {
    if (period == 0) return 0;
    return -period * std::round((placed.position[block_b].y() - placed.position[block_a].y()) / period);
}

std::vector<WirePlace> facing_spheres(const Blocks& placed, std::uint32_t block_a, std::uint32_t block_b,
                                      double period) {
    const Vector image(0, nearest_image(placed, block_a, block_b, period), 0);
    // The world axis along which the two stand side by side.
    const Vector between = placed.position[block_b] + image - placed.position[block_a];
    Eigen::Index axis = 0;
    between.cwiseAbs().maxCoeff(&axis);
    const Vector direction = Vector::Unit(axis) * (between[axis] < 0 ? -1.0 : 1.0);
    auto side_a = side_spheres(placed, block_a, direction),
         side_b = side_spheres(placed, block_b, -direction);
    // The side of fewer spheres chooses, of equal ones that of the lower block: whichever end is named first.
    const bool a_chooses = side_a.size() != side_b.size() ? side_a.size() < side_b.size() : block_a < block_b;
    const auto& choosing = a_chooses ? side_a : side_b;
    auto& open = a_chooses ? side_b : side_a;
    std::vector<WirePlace> pairs;
    for (const auto own : choosing) {
        auto nearest = open.end();
        double least = std::numeric_limits<double>::infinity();
        for (auto other = open.begin(); other != open.end(); ++other) {
            const auto a = a_chooses ? own : *other, b = a_chooses ? *other : own;
            Vector across = placed.sphere_centre(block_b, b) + image - placed.sphere_centre(block_a, a);
            across[axis] = 0;
            // A hair's breadth of preference for the first keeps ties from being decided by rounding.
            if (across.norm() < least - 1e-9) {
                least = across.norm();
                nearest = other;
            }
        }
        if (a_chooses)
            pairs.push_back({block_a, own, block_b, *nearest});
        else
            pairs.push_back({block_a, *nearest, block_b, own});
        open.erase(nearest);
    }
    return pairs;
}

std::vector<WirePlace> wires_of(const Blocks& placed, const LinkRequest& link, double period) {
    if (link.spheres) return {{link.block_a, (*link.spheres)[0], link.block_b, (*link.spheres)[1]}};
    const auto all = facing_spheres(placed, link.block_a, link.block_b, period);
    const std::size_t count = link.wires == 0 ? all.size() : std::min(link.wires, all.size());
    std::vector<WirePlace> chosen;
    for (std::size_t k = 0; k < count; ++k) chosen.push_back(all[(2 * k + 1) * all.size() / (2 * count)]);
    return chosen;
}

}  // namespace dem
