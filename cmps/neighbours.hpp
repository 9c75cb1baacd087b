/// Neighbour lists with a skin, and the cell order that keeps neighbours near each other in memory.
#pragma once

#include <cstdint>
#include <vector>

#include "cmps/particles.hpp"

namespace cmps {

/// Lists, for every pressure carrier i, of all particles within radius + skin, ascending: dummies first.
/// Row r belongs to particle first_wall() + r; its entries are [start[r], start[r + 1]), those from `carriers[r]`
/// on carry pressure themselves.
struct NeighbourLists {
    std::vector<std::uint32_t> start, carriers;
    std::vector<std::int32_t> neighbour;
};

/// Keeps lists valid while particles move less than half the skin.
class NeighbourSearch {
 public:
    /// radius: of the kernel, m; skin: m.
    NeighbourSearch(double radius, double skin) : radius_(radius), skin_(skin) {}

    /// Rebuilds the lists when a particle has moved half the skin since, or when `invalidate` was called.
    /// Returns true when it did.
    bool update(const Particles& particles);
    void invalidate() { is_valid_ = false; }
    const NeighbourLists& lists() const { return lists_; }

    /// Puts fluid particles in the order of their cells (cell edge `edge`, column after column).
    void sort_fluid(Particles& particles, double edge);

 private:
    void build(const Particles& particles);
    double radius_, skin_;
    bool is_valid_ = false;
    NeighbourLists lists_;
    std::vector<double> built_x_, built_z_;
    std::vector<std::uint32_t> cell_start_, cell_of_;
    std::vector<std::int32_t> cell_members_;
    std::vector<double> sort_buffer_;
    std::vector<std::int32_t> sort_integers_, order_;
};

}  // namespace cmps
