/// Cells, faces and the bed under them.
///
/// Every array over cells carries `ghost_cells` extra cells at each end; cell k of the flume is entry k +
/// ghost_cells. Face arrays have one entry more; entry k is the offshore face of cell k.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "boussinesq/cell_array.hpp"

namespace boussinesq {

inline constexpr std::size_t ghost_cells = 4;
inline constexpr double gravity = 9.81;  ///< m/s2

/// Equal cells from the offshore end to the shoreward end of the flume.
struct Grid {
    double offshore_end;  ///< x of the first face, m
    double spacing;       ///< m
    std::size_t cells;

    std::size_t padded() const { return cells + 2 * ghost_cells; }
    double centre(std::size_t cell) const {
        return offshore_end + (static_cast<double>(cell) + 0.5) * spacing;
    }
    double face(std::size_t face) const { return offshore_end + static_cast<double>(face) * spacing; }
    double shoreward_end() const { return face(cells); }
    /// The cell that holds x; x outside is held at the end cells.
    std::size_t cell_at(double x) const;
};

/// The bed: continuous, given at faces, linear inside a cell; mirrored beyond both ends.
struct Bed {
    CellArray face_level;  ///< m, padded faces

    /// `polyline`: [[x, z], ...] with x increasing (m).
    Bed(const Grid& grid, const std::vector<std::array<double, 2>>& polyline);
    double level(std::size_t padded_cell) const {
        return 0.5 * (face_level[padded_cell] + face_level[padded_cell + 1]);
    }
    /// Largest depth below z = 0, m.
    double largest_depth() const;
};

}  // namespace boussinesq
