#include "dem/effects/wires.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace dem {

void Wires::add(std::uint32_t a, std::uint32_t sphere_of_a, std::uint32_t b, std::uint32_t sphere_of_b,
                double r0, double k_n, double offset_of_image) {
    block_a.push_back(a);
    sphere_a.push_back(sphere_of_a);
    block_b.push_back(b);
    sphere_b.push_back(sphere_of_b);
    rest_length.push_back(r0);
    stiffness.push_back(k_n);
    image_offset.push_back(offset_of_image);
    is_intact.push_back(1);
    tension.push_back(0);
    broken_at.push_back(-1);
    largest_tension.push_back(0);
}

bool Wires::are_those_of(const Wires& other) const {
    const auto constants = [](const Wires& w) {
        return std::tie(w.law, w.longest_stretch, w.block_a, w.sphere_a, w.block_b, w.sphere_b, w.rest_length,
                        w.stiffness, w.image_offset);
    };
    return constants(*this) == constants(other);
}

double Wires::tension_at(std::size_t wire, double r) const {
    const double r0 = rest_length[wire];
    if (r <= r0) return 0;
    const double hooke = stiffness[wire] * (r - r0);
    return law == WireLaw::hooke ? hooke : hooke * (1 - r0 / r);
}

double Wires::energy_at(std::size_t wire, double r) const {
    const double r0 = rest_length[wire], stretch = r - r0;
    if (stretch <= 0) return 0;
    if (law == WireLaw::hooke) return 0.5 * stiffness[wire] * stretch * stretch;
    const double logarithm = r0 > 0 ? r0 * r0 * std::log(r / r0) : 0.0;
    return stiffness[wire] * (0.5 * (r * r - r0 * r0) - 2 * r0 * stretch + logarithm);
}

Vector Wires::between_ends(const Blocks& blocks, std::size_t wire) const {
    return blocks.sphere_centre(block_b[wire], sphere_b[wire]) + Vector(0, image_offset[wire], 0) -
           blocks.sphere_centre(block_a[wire], sphere_a[wire]);
}

Vector Wires::pull_of(const Blocks& blocks, std::size_t wire) const {
    if (!is_intact[wire]) return Vector::Zero();
    const Vector between = between_ends(blocks, wire);
    const double r = between.norm();
    return r > rest_length[wire] ? Vector(tension_at(wire, r) / r * between) : Vector::Zero();
}

void Wires::pull(Blocks& blocks, double t) {
    std::vector<std::uint32_t> all(size());
    std::iota(all.begin(), all.end(), 0u);
    pull(blocks, t, all, std::vector<std::uint8_t>(blocks.size(), 1));
}

void Wires::pull(Blocks& blocks, double t, const std::vector<std::uint32_t>& which,
                 const std::vector<std::uint8_t>& is_wanted) {
    for (const std::size_t k : which) {
        if (!is_intact[k]) continue;
        const std::uint32_t a = block_a[k], b = block_b[k];
        const Vector arm_a = blocks.arm(a, sphere_a[k]), arm_b = blocks.arm(b, sphere_b[k]);
        const Vector between =
            blocks.position[b] + Vector(0, image_offset[k], 0) + arm_b - blocks.position[a] - arm_a;
        const double squared = between.squaredNorm();
        if (squared <= rest_length[k] * rest_length[k]) {
            tension[k] = 0;
            continue;
        }
        const double r = std::sqrt(squared);
        // r > r_max by more than the rounding of r: broken for good. At r_max it holds.
        if (r > rest_length[k] + longest_stretch + 1e-12 * r) {
            energy_of_broken += energy_at(k, r);
            is_intact[k] = 0;
            tension[k] = 0;
            broken_at[k] = t;
            continue;
        }
        tension[k] = tension_at(k, r);  // (13)
        largest_tension[k] = std::max(largest_tension[k], tension[k]);
        const Vector force = tension[k] / r * between;
        if (is_wanted[a]) {
            blocks.force[a] += force;
            blocks.torque[a] += arm_a.cross(force);
        }
        if (is_wanted[b]) {
            blocks.force[b] -= force;
            blocks.torque[b] -= arm_b.cross(force);
        }
    }
}

double Wires::elastic_energy(const Blocks& blocks) const {
    double energy = 0;
    for (std::size_t k = 0; k < size(); ++k)
        if (is_intact[k]) energy += energy_at(k, between_ends(blocks, k).norm());
    return energy;
}

std::size_t Wires::intact_count() const {
    return static_cast<std::size_t>(std::count(is_intact.begin(), is_intact.end(), 1));
}

double Wires::largest_share_of_breaking() const {
    double share = 0;
    for (std::size_t k = 0; k < size(); ++k)
        share = std::max(share, is_intact[k] == 0
                                    ? 1.0
                                    : largest_tension[k] / tension_at(k, rest_length[k] + longest_stretch));
    return share;
}

}  // namespace dem
