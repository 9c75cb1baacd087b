#include "dem/put_back.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/errors.hpp"

namespace dem {

namespace {

/// What one block must keep clear of: all spheres and planes in its neighbourhood.
struct Obstacles {
    struct Sphere {
        Vector centre;
        double distance;  ///< least one of the centres, m
    };
    std::vector<Sphere> spheres;
    std::vector<Plane> planes;
    double least_distance_to_planes;  ///< of centres, m
};

Obstacles obstacles_around(const Blocks& blocks, const Surroundings& surroundings, const Pressing& pressing,
                           std::size_t block, double margin) {
    Obstacles obstacles;
    const Shape& own = blocks.shape_of(block);
    const double reach = own.radius + margin;
    const auto add = [&](const Vector& centre, double diameter, bool is_fixed) {
        if ((centre - blocks.position[block]).norm() < reach + 0.5 * diameter)
            obstacles.spheres.push_back(
                {centre,
                 0.5 * (own.diameter + diameter) - (is_fixed ? pressing.into_fixed : pressing.into_blocks)});
    };
    const int images = surroundings.period > 0 ? 1 : 0;
    for (int image = -images; image <= images; ++image) {
        // In a periodic box positions run on past its ends: the copy nearest to this block, and one on either
        // side.
        const auto nearest = [&](double y) {
            return images == 0
                       ? 0.0
                       : surroundings.period *
                             (std::round((blocks.position[block].y() - y) / surroundings.period) + image);
        };
        for (std::size_t j = 0; j < blocks.size(); ++j) {
            if (j == block) continue;
            const Shape& other = blocks.shape_of(j);
            const Vector shift(0, nearest(blocks.position[j].y()), 0);
            if ((blocks.position[j] + shift - blocks.position[block]).norm() > reach + other.radius) continue;
            for (const int k : other.exposed)
                add(blocks.sphere_centre(j, static_cast<std::size_t>(k)) + shift, other.diameter,
                    blocks.is_fixed[j] != 0);
        }
        for (const Vector& centre : surroundings.fixed_spheres.centres())
            add(centre + Vector(0, nearest(centre.y()), 0), surroundings.fixed_spheres.diameter(), true);
    }
    obstacles.planes = surroundings.planes;
    obstacles.least_distance_to_planes = 0.5 * own.diameter - pressing.into_fixed;
    return obstacles;
}

/// A half space the shift must lie in: normal . shift >= least.
struct Bound {
    Vector normal;
    double least;
};

/// The shortest vector within all half spaces (Hildreth's dual coordinate ascent), or nothing when it would
/// be longer than `longest`: then the half spaces have no common point worth going to.
std::optional<Vector> shortest_within(const std::vector<Bound>& bounds, double longest, double tolerance) {
    constexpr int most_sweeps = 2000;
    Vector shift = Vector::Zero();
    std::vector<double> weight(bounds.size(), 0.0);
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        double largest_change = 0;
        for (std::size_t k = 0; k < bounds.size(); ++k) {
            const double change = std::max(bounds[k].least - bounds[k].normal.dot(shift), -weight[k]);
            weight[k] += change;
            shift += change * bounds[k].normal;
            largest_change = std::max(largest_change, std::abs(change));
        }
        if (shift.norm() > 2 * longest) return {};
        if (largest_change < 0.1 * tolerance) return shift;
    }
    return {};
}

/// Finds shifts of one block that free it from its obstacles.
class GapSearch {
 public:
    GapSearch(const Blocks& blocks, std::size_t block, Obstacles obstacles, double longest)
        : longest_(longest), diameter_(blocks.shape_of(block).diameter), obstacles_(std::move(obstacles)) {
        for (const int k : blocks.shape_of(block).exposed)
            own_.push_back(blocks.sphere_centre(block, static_cast<std::size_t>(k)));
    }

    /// The smallest shift found, from one height above the place after another: what is found with some lift
    /// is no shorter than that lift.
    std::optional<Vector> smallest_shift() const {
        std::optional<Vector> best;
        const double step = 0.05 * diameter_;
        for (double lift = 0; lift < (best ? best->norm() : longest_); lift += step)
            if (const auto shift = shift_above(lift); shift && (!best || shift->norm() < best->norm()))
                best = shift;
        return best;
    }

 private:
    /// A shift that frees the block and lifts it by `lift` at least: the half spaces that its near obstacles
    /// leave are taken where the block stands, again and again.
    std::optional<Vector> shift_above(double lift) const {
        constexpr int most_tries = 60;
        const double tolerance = 1e-3 * diameter_;
        Vector shift(0, 0, lift);
        for (int tries = 0; tries < most_tries; ++tries) {
            std::vector<Bound> bounds;
            if (lift > 0) bounds.push_back({Vector::UnitZ(), lift});
            if (find_bounds(shift, bounds) < tolerance) return shift;
            const auto next = shortest_within(bounds, longest_, tolerance);
            if (!next || next->norm() > longest_) return {};
            shift = *next;
        }
        return {};
    }

    /// Appends the bounds that obstacles set near `shift`; returns how far it is out of the worst of them, m.
    double find_bounds(const Vector& shift, std::vector<Bound>& bounds) const {
        const double near = 0.25 * diameter_;
        double worst = 0;
        const auto note = [&](const Vector& normal, double gap) {
            worst = std::max(worst, -gap);
            bounds.push_back({normal, normal.dot(shift) - gap});
        };
        for (const auto& centre : own_) {
            const Vector at = centre + shift;
            for (const auto& obstacle : obstacles_.spheres) {
                const Vector away = at - obstacle.centre;
                const double reach = obstacle.distance + near, squared = away.squaredNorm();
                if (squared > reach * reach) continue;
                const double length = std::sqrt(squared);
                note(length > 0 ? Vector(away / length) : Vector(Vector::UnitZ()),
                     length - obstacle.distance);
            }
            for (const auto& plane : obstacles_.planes) {
                const double gap = (at - plane.point).dot(plane.normal) - obstacles_.least_distance_to_planes;
                if (gap < near) note(plane.normal, gap);
            }
        }
        return worst;
    }

    double longest_, diameter_;
    Obstacles obstacles_;
    std::vector<Vector> own_;  ///< centres of the block's spheres in its packed pose
};

/// Whether no point of the block is farther from its packed place than a sleeper may move.
bool stands_as_packed(const Blocks& blocks, const PackedPoses& packed, std::size_t block) {
    const Shape& shape = blocks.shape_of(block);
    const double turned = (packed.orientation[block].conjugate() * blocks.orientation[block]).vec().norm();
    return (blocks.position[block] - packed.position[block]).norm() + 2 * shape.radius * turned <
           1e-4 * shape.diameter;
}

}  // namespace

Pressing pressing_of(const Blocks& blocks, const Material& material, double gravity) {
    constexpr double push = 8;       // weights
    constexpr double softest = 0.2;  // d, however soft the spheres
    double mass = std::numeric_limits<double>::infinity(), diameter = mass;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        mass = std::min(mass, blocks.shape_of(i).mass);
        diameter = std::min(diameter, blocks.shape_of(i).diameter);
    }
    // F = 4/3 E* sqrt(R*) delta^(3/2), with R* = d/4
    const auto overlap_under = [&](double force) {
        return std::min(
            softest * diameter,
            std::pow(0.75 * force / (material.contact_modulus() * std::sqrt(diameter / 4)), 2.0 / 3.0));
    };
    return {overlap_under(mass * gravity), overlap_under(push * mass * gravity)};
}

std::vector<std::uint32_t> put_back(Blocks& blocks, const Surroundings& surroundings,
                                    const Pressing& pressing, const std::vector<std::uint32_t>& chosen,
                                    const PackedPoses& packed) {
    std::vector<std::uint32_t> placed;
    for (const auto i : chosen)
        if (!stands_as_packed(blocks, packed, i)) placed.push_back(i);
    // All of them first, so that none is set down where a later one belongs.
    for (const auto i : placed)
        blocks.place(i, packed.position[i], packed.orientation[i], Vector::Zero(), Vector::Zero());
    for (const auto i : placed) {
        const double longest = 3 * blocks.shape_of(i).height;
        const auto shift =
            GapSearch(blocks, i, obstacles_around(blocks, surroundings, pressing, i, longest), longest)
                .smallest_shift();
        if (!shift)
            throw common::RunError(fmt::format(
                "wires.put_back: block {} does not fit back into its place, nor within {:.2g} m of it", i + 1,
                longest));
        blocks.position[i] += *shift;
    }
    return placed;
}

std::vector<TouchingPair> contacts_without(const std::vector<TouchingPair>& contacts,
                                           const std::vector<std::uint32_t>& placed) {
    const auto is_placed = [&](std::uint32_t body) {
        return std::binary_search(placed.begin(), placed.end(), body);
    };
    std::vector<TouchingPair> kept;
    for (const auto& pair : contacts)
        if (!is_placed(pair.block) && !is_placed(pair.partner)) kept.push_back(pair);
    return kept;
}

}  // namespace dem
