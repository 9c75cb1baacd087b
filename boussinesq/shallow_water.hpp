/// The hydrostatic part of the equations over one tile:
///
///     h_t + (h u)_x = 0
///     (h u)_t + (h u^2 + g h^2 / 2)_x = - g h b_x
///
/// Finite volumes: WENO5 of surface elevation and velocity, HLL fluxes with the wave speeds of Toro (2001)
/// and their dry-bed limits, bed slope well balanced (lake at rest stays at rest to round-off). Beside dry
/// cells the reconstruction is first order with the hydrostatic reconstruction of Audusse et al. (2004).
/// Fifth order in space on a level bed, second order where the bed bends, first order at the shoreline.
#pragma once

#include "boussinesq/tile.hpp"
#include "boussinesq/wave_state.hpp"

namespace boussinesq {

/// Fills depth, bed, elevation and velocity of the tile from the padded state arrays.
void load_tile(Tile& tile, const double* depth, const double* discharge, const double* face_level,
               const FlowParameters& flow, bool may_be_dry);

/// True where no cell of the tile or its halo is near to drying, so that the wet kernels hold.
bool is_deep(const Tile& tile, const FlowParameters& flow);

/// Fluxes at faces begin..end of a tile that is wet throughout.
void wet_fluxes(Tile& tile, const FlowParameters& flow);

/// Fluxes at the same faces where cells may be dry; `step` (s) limits outflow to the water that is there.
void shoreline_fluxes(Tile& tile, const FlowParameters& flow, double step);

/// Rates of depth and discharge (per second) of inner cell t, from the fluxes and the bed slope.
inline double depth_rate(const Tile& tile, std::size_t t, double inverse_spacing) {
    return (tile.depth_flux[t] - tile.depth_flux[t + 1]) * inverse_spacing;
}
inline double wet_discharge_rate(const Tile& tile, std::size_t t, double inverse_spacing) {
    return (tile.momentum_flux_plus[t] - tile.momentum_flux_plus[t + 1] -
            gravity * tile.depth[t] * (tile.face_bed[t + 1] - tile.face_bed[t])) *
           inverse_spacing;
}
inline double shoreline_discharge_rate(const Tile& tile, std::size_t t, double inverse_spacing) {
    return (tile.momentum_flux_plus[t] - tile.momentum_flux_minus[t + 1] -
            gravity * tile.depth[t] * (tile.level_minus[t] - tile.level_plus[t])) *
           inverse_spacing;
}

}  // namespace boussinesq
