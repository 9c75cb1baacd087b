#include "boussinesq/grid.hpp"

#include <algorithm>
#include <cmath>

namespace boussinesq {

std::size_t Grid::cell_at(double x) const {
    const double cell = std::floor((x - offshore_end) / spacing);
    return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(cells - 1)));
}

Bed::Bed(const Grid& grid, const std::vector<std::array<double, 2>>& polyline)
    : face_level(grid.padded() + 1) {
    std::size_t segment = 0;
    for (std::size_t face = 0; face <= grid.cells; ++face) {
        const double x = std::clamp(grid.face(face), polyline.front()[0], polyline.back()[0]);
        while (segment + 2 < polyline.size() && polyline[segment + 1][0] < x) ++segment;
        const auto& [x0, z0] = polyline[segment];
        const auto& [x1, z1] = polyline[segment + 1];
        face_level[ghost_cells + face] = z0 + (z1 - z0) * (x - x0) / (x1 - x0);
    }
    const std::size_t last = ghost_cells + grid.cells;
    for (std::size_t k = 1; k <= ghost_cells; ++k) {
        face_level[ghost_cells - k] = face_level[ghost_cells + std::min(k, grid.cells)];
        face_level[last + k] = face_level[last - std::min(k, grid.cells)];
    }
}

double Bed::largest_depth() const {
    return -*std::min_element(face_level.begin(), face_level.end());
}

}  // namespace boussinesq
