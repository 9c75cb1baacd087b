/// Neighbour lists with a skin, and the cell order that keeps neighbours near each other in memory.
#pragma once

#include <cstdint>
#include <vector>

#include "cmps/particles.hpp"

namespace cmps {

/// Lists, for every pressure carrier i, of all particles within radius + skin, ascending: dummies first.
/// Row r belongs to particle first_wall() + r; its entries are [start[r], start[r + 1]), those from
/// `carriers[r]` on carry pressure themselves.
struct NeighbourLists {
    std::vector<std::uint32_t> start, carriers;
    std::vector<std::int32_t> neighbour;
};

/// Keeps lists valid while particles move less than the skin against those around them. At every rebuild the
/// fluid is put in the order of its cells, column after column, so that the candidates of a particle are
/// three short runs of indices.
class NeighbourSearch {
 public:
    /// radius: of the kernel, m; skin: m.
    NeighbourSearch(double radius, double skin) : radius_(radius), skin_(skin) {}

    /// Rebuilds the lists, and reorders the fluid, when particles may have moved by the skin against those
    /// around them since, when one came or left, or when `invalidate` was called. `companions` are further
    /// arrays over all particles that must follow the new order. Returns true when it did.
    bool update(Particles& particles, const std::vector<std::vector<double>*>& companions);
    void invalidate() { is_valid_ = false; }
    const NeighbourLists& lists() const { return lists_; }

    /// Places of the particles when the lists were built: what a run must remember to go on with the same
    /// lists, and so with the same order of sums.
    const std::vector<double>& built_x() const { return built_x_; }
    const std::vector<double>& built_z() const { return built_z_; }
    /// Builds the lists as they were when the particles stood at x, z.
    void restore(const Particles& particles, const std::vector<double>& x, const std::vector<double>& z);

 private:
    struct Cells;
    /// The box that holds the displacements of a strip of water since the lists were built, m.
    struct Displacements {
        double x0 = 1e300, x1 = -1e300, z0 = 1e300, z1 = -1e300;
        void include(double dx, double dz) {
            x0 = dx < x0 ? dx : x0, x1 = dx > x1 ? dx : x1;
            z0 = dz < z0 ? dz : z0, z1 = dz > z1 ? dz : z1;
        }
        void include(const Displacements& other) {
            x0 = other.x0 < x0 ? other.x0 : x0, x1 = other.x1 > x1 ? other.x1 : x1;
            z0 = other.z0 < z0 ? other.z0 : z0, z1 = other.z1 > z1 ? other.z1 : z1;
        }
    };
    bool lists_hold(const Particles& particles);
    void build(Particles& particles, const std::vector<std::vector<double>*>& companions);
    void sort_fluid(Particles& particles, const Cells& cells,
                    const std::vector<std::vector<double>*>& companions);
    void sort_boundary(const Particles& particles, const Cells& cells);
    double radius_, skin_;
    bool is_valid_ = false;
    NeighbourLists lists_;
    std::vector<double> built_x_, built_z_;
    double left_ = 0, right_ = 0;  ///< ends of built_x_, m
    std::vector<Displacements> displacements_;
    std::vector<std::uint32_t> fluid_start_, boundary_start_, cell_of_;
    std::vector<std::int32_t> boundary_members_, order_, integer_buffer_;
    std::vector<double> real_buffer_;
    std::vector<std::vector<std::int32_t>> blocks_;
};

}  // namespace cmps
