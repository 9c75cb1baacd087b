/// Wires between spheres of different blocks, eq. (13). They pull, never push, and break past r_max.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "dem/blocks.hpp"

namespace dem {

/// The two readings of eq. (13).
enum class WireLaw {
    hooke,       ///< the force is k_wire times the vector of length r: T = k_n (r - r0)
    progressive  ///< k_wire acts on the stretch: T = k_n (1 - r0/r) (r - r0), soft at first
};

/// One wire per entry.
struct Wires {
    WireLaw law = WireLaw::hooke;
    double longest_stretch = 0;  ///< psi d, m; infinite: wires do not break
    std::vector<std::uint32_t> block_a, sphere_a, block_b, sphere_b;
    std::vector<double> rest_length;  ///< r0, m
    std::vector<double> stiffness;    ///< k_n, N/m
    std::vector<double>
        image_offset;  ///< in a periodic box the second end is the image so much further in y, m
    std::vector<std::uint8_t> is_intact;
    std::vector<double> tension;          ///< at the last step, N
    std::vector<double> broken_at;        ///< s; -1 while intact
    std::vector<double> largest_tension;  ///< so far, N
    double energy_of_broken = 0;          ///< elastic energy lost when wires broke, J

    std::size_t size() const { return block_a.size(); }
    /// Whether the same wires hang here as there, whatever has become of them.
    bool are_those_of(const Wires& other) const;
    void add(std::uint32_t a, std::uint32_t sphere_of_a, std::uint32_t b, std::uint32_t sphere_of_b,
             double r0, double k_n, double offset_of_image = 0);
    /// Adds forces and torques of the intact ones among `which` to those blocks that are wanted, in order of
    /// wires; breaks those longer than r0 + psi d at time t.
    void pull(Blocks& blocks, double t, const std::vector<std::uint32_t>& which,
              const std::vector<std::uint8_t>& is_wanted);
    /// The same for all wires and blocks.
    void pull(Blocks& blocks, double t);
    /// Elastic energy of the intact ones at their present length, J.
    double elastic_energy(const Blocks& blocks) const;
    /// Pull of one wire on its first end at the present poses, N; the second end feels the opposite.
    Vector pull_of(const Blocks& blocks, std::size_t wire) const;
    /// From the first end to the second, m.
    Vector between_ends(const Blocks& blocks, std::size_t wire) const;
    std::size_t intact_count() const;
    /// Largest tension of any wire so far over the one at which it breaks; 1 where one broke.
    double largest_share_of_breaking() const;
    /// Stored energy at length r, J.
    double energy_at(std::size_t wire, double r) const;
    double tension_at(std::size_t wire, double r) const;
};

}  // namespace dem
