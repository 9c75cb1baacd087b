#include "cmps/pools.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace cmps {
namespace {

enum class Cell : std::uint8_t { air, solid, water };

/// Square cells over all particles, with a margin of one; in the thinnest wall that a scene may have, three
/// spacings, there is one at least between the waters on its two sides.
struct Cells {
    double size, x0, z0;
    std::size_t nx, nz;
    std::vector<Cell> kind;

    Cells(const Particles& particles, double spacing) : size(1.5 * spacing) {
        const auto [left, right] = std::minmax_element(particles.x.begin(), particles.x.end());
        const auto [low, high] = std::minmax_element(particles.z.begin(), particles.z.end());
        x0 = *left - size, z0 = *low - size;
        nx = static_cast<std::size_t>((*right - x0) / size) + 2;
        nz = static_cast<std::size_t>((*high - z0) / size) + 2;
        kind.assign(nx * nz, Cell::air);
        for (std::size_t i = 0; i < particles.size(); ++i)  // water stands last and prevails
            kind[static_cast<std::size_t>((particles.z[i] - z0) / size) * nx +
                 static_cast<std::size_t>((particles.x[i] - x0) / size)] =
                particles.is_fluid(i) ? Cell::water : Cell::solid;
    }
    template <class Visit>
    void for_sides(std::size_t cell, const Visit& visit) const {
        const std::size_t i = cell % nx, k = cell / nx;
        if (i > 0) visit(cell - 1);
        if (i + 1 < nx) visit(cell + 1);
        if (k > 0) visit(cell - nx);
        if (k + 1 < nz) visit(cell + nx);
    }
    /// A hole between particles is no air.
    bool is_open(std::size_t cell) const {
        if (kind[cell] != Cell::air) return false;
        int open = 0;
        for_sides(cell, [&](std::size_t side) { open += kind[side] == Cell::air; });
        return open >= 2;
    }
};

}  // namespace

double height_to_fall(const Particles& particles, double spacing) {
    if (particles.fluid == 0) return 0.0;
    const Cells cells(particles, spacing);
    std::vector<bool> is_seen(cells.kind.size(), false);
    std::size_t most = 0;  // cells
    std::vector<std::size_t> pool;
    for (std::size_t first = 0; first < cells.kind.size(); ++first) {
        if (cells.kind[first] != Cell::water || is_seen[first]) continue;
        pool.assign(1, first), is_seen[first] = true;
        std::size_t top = 0, lowest_air = cells.nz;
        for (std::size_t next = 0; next < pool.size(); ++next) {
            const std::size_t cell = pool[next];
            top = std::max(top, cell / cells.nx);
            cells.for_sides(cell, [&](std::size_t side) {
                if (cells.is_open(side)) lowest_air = std::min(lowest_air, side / cells.nx);
                if (cells.kind[side] != Cell::water || is_seen[side]) return;
                is_seen[side] = true;
                pool.push_back(side);
            });
        }
        // air lies a cell above a level surface; a row that is not quite full may be one more below
        if (lowest_air < top) most = std::max(most, top - lowest_air);
    }
    return static_cast<double>(most) * cells.size;
}

}  // namespace cmps
