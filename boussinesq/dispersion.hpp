/// The dispersive part of the equations (Serre-Green-Naghdi with alpha; Bonneton et al. 2011, Popinet 2015):
///
///     (h u)_t = ... + h ( (g/alpha) eta_x - D ),      h D + alpha h T(D) = h ( (g/alpha) eta_x + Q(u) )
///
///     h T(w) = - (h^3 w_x)_x / 3 + (h^2 b_x w)_x / 2 - h^2 b_x w_x / 2 + h b_x^2 w
///     h Q(u) = (2/3) (h^3 u_x^2)_x + h^2 u_x^2 b_x + (h^2 u^2 b_xx)_x / 2 + h u^2 b_xx b_x
///
/// T is built face by face as a sum of squares, alpha h {[p (D_R - D_L) - r (D_L + D_R)]^2 + q (D_L + D_R)^2}
/// with p = h / (sqrt(3) dx), r = sqrt(3) b_x / 4, q = b_x^2 / 16: the tridiagonal matrix is symmetric and
/// positive on any bed. The plain part h D and its right-hand side are averaged with (1, 10, 1)/12 (Numerov),
/// which makes the system fourth-order accurate on a level bed, second order where the bed bends.
/// Unconditionally stable as a linear solve.
///
/// Where cells are `held` (dry ones, their neighbours, bores, bed steps, open ends) the flow is hydrostatic:
/// the system ends there with its natural condition.
#pragma once

#include "boussinesq/cell_array.hpp"
#include "boussinesq/tile.hpp"
#include "boussinesq/wave_state.hpp"

namespace boussinesq {

/// The equations hold over mild slopes; across a step they would all but stop the flow, so that the
/// dispersive parts on both sides are uncoupled and the flow over it is hydrostatic. Above 1 by more than
/// rounding, so that a face of 1:1 is not now mild, now steep.
inline constexpr double steepest_slope = 1.0 + 1e-9;

/// Slope of a front, 30 degrees, from which it breaks (Tissier et al. 2012): steeper ones beside dry water
/// are bores at any cell size. Without it the tip of a dam break ran the faster ahead the smaller the cells.
inline constexpr double steepest_front = 0.577;

/// Fills off_diagonal, diagonal, right_side and elevation_slope (already times g/alpha) of a tile that is wet
/// throughout.
void assemble_wet_dispersion(Tile& tile, const FlowParameters& flow);

/// The same where some cells are `hydrostatic` (padded, non-zero).
void assemble_wet_dispersion(Tile& tile, const FlowParameters& flow, const unsigned char* hydrostatic);

/// The same where cells may be dry besides.
void assemble_shoreline_dispersion(Tile& tile, const FlowParameters& flow, const unsigned char* hydrostatic);

/// Eliminated tridiagonal system of the whole flume: row i reads D_i = value_i - ratio_i D_(neighbour nearer
/// the middle). Elimination runs from both ends towards the middle at once: two independent chains hide each
/// row's division.
struct DispersionSystem {
    CellArray ratio, value;  ///< padded

    explicit DispersionSystem(const Grid& grid) : ratio(grid.padded(), 0.0), value(grid.padded(), 0.0) {}
};

/// Last eliminated row of either chain; at the walls D is odd, which the caller folds into the first
/// diagonal.
struct ChainEnds {
    double left_ratio = 0, left_value = 0, right_ratio = 0, right_value = 0;
};

/// Eliminates the rows of `left` from its offshore end and those of `right` from its shoreward end; either
/// may be null.
void eliminate(Tile* left, Tile* right, DispersionSystem& system, ChainEnds& ends);

/// Solves outward from the middle (number of cells of the left chain) and takes step * h * D off the
/// discharge.
void subtract_accelerations(const DispersionSystem& system, std::size_t middle, std::size_t cells,
                            double step, const double* depth, double* discharge);

}  // namespace boussinesq
