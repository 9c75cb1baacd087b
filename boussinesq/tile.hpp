/// A tile: a short run of cells whose right-hand side is computed in one go, so that intermediate values stay
/// in the first-level cache whatever the length of the flume. Cost per cell is then the same for 1e3 and 1e6
/// cells.
#pragma once

#include <cstddef>

#include "boussinesq/grid.hpp"

namespace boussinesq {

inline constexpr std::size_t tile_cells = 192;
inline constexpr std::size_t tile_width = tile_cells + 2 * ghost_cells + 8;

/// Values of one variable over a tile; entry t is padded cell (or its offshore face) `first + t`.
struct alignas(64) TileArray {
    double value[tile_width];
    double& operator[](std::size_t t) { return value[t]; }
    double operator[](std::size_t t) const { return value[t]; }
};

/// Scratch of one tile. Inner cells are ghost_cells <= t < ghost_cells + count.
struct Tile {
    std::size_t first;  ///< padded index of entry 0
    std::size_t count;  ///< inner cells

    // cells
    TileArray depth, discharge, bed, elevation, velocity;
    // faces: bed level, states on the offshore (minus) and shoreward (plus) side
    TileArray face_bed, elevation_minus, elevation_plus, velocity_minus, velocity_plus;
    // faces: fluxes of depth and of discharge as the cell on either side sees them
    TileArray depth_flux, momentum_flux_minus, momentum_flux_plus;
    // near dry cells only: how each cell sees its own faces (depth and bed level; plus: its offshore face)
    TileArray depth_minus, depth_plus, level_minus, level_plus;
    TileArray is_first_order;  ///< 1 where a cell's own values stand for its face values, else 0
    TileArray outflow_share;   ///< of a cell's outgoing flux that it can afford
    // dispersion: (g/alpha) eta_x, terms of Q, and the symmetric tridiagonal system (off_diagonal at faces)
    TileArray elevation_slope, bed_slope, stretch, bed_stretch, curvature, force;
    TileArray numerov, off_diagonal, diagonal, diagonal_minus, right_side;
    TileArray held;  ///< 1 where the acceleration D is prescribed (near dry or breaking cells), else 0

    std::size_t begin() const { return ghost_cells; }
    std::size_t end() const { return ghost_cells + count; }
};

}  // namespace boussinesq
