#include "boussinesq/dispersion.hpp"

#include <algorithm>
#include <cmath>

namespace boussinesq {
namespace {

constexpr double square(double x) {
    return x * x;
}

/// (g/alpha) eta_x of cells begin-1 .. end, fourth order.
void wet_slopes(Tile& tile, const FlowParameters& flow) {
    const double* e = tile.elevation.value;
    const double scale = gravity / flow.alpha / flow.spacing / 12.0;
    for (std::size_t t = tile.begin() - 1; t < tile.end() + 1; ++t)
        tile.elevation_slope[t] = scale * (8.0 * (e[t + 1] - e[t - 1]) - (e[t + 2] - e[t - 2]));
}

/// Marks the cells whose flow is hydrostatic: where the fluxes are first order (near dry cells and over bed
/// steps as high as the water), their neighbours, where the surface jumps by half the depth from cell to
/// cell, and the cells listed (bores, bed steps, open ends). Elsewhere the slope is the very gradient the
/// fluxes make, weighted with the depths at the faces: any other one would let the dispersive part feed on
/// the difference over a rough bed.
void shoreline_slopes(Tile& tile, const FlowParameters& flow, const unsigned char* hydrostatic) {
    const double scale = 0.5 * gravity / flow.alpha / flow.spacing;
    for (std::size_t t = tile.begin() - 1; t < tile.end() + 1; ++t) {
        const bool rough =
            tile.is_first_order[t - 1] + tile.is_first_order[t] + tile.is_first_order[t + 1] != 0.0;
        const double jump = std::max(std::abs(tile.elevation[t] - tile.elevation[t - 1]),
                                     std::abs(tile.elevation[t + 1] - tile.elevation[t]));
        const double speed_jump = std::max(std::abs(tile.velocity[t] - tile.velocity[t - 1]),
                                           std::abs(tile.velocity[t + 1] - tile.velocity[t]));
        const double least = std::min(std::min(tile.depth[t - 1], tile.depth[t]), tile.depth[t + 1]);
        const bool is_bore = jump > std::min(0.5 * least, steepest_front * flow.spacing) ||
                             square(speed_jump) > 0.25 * gravity * least;
        tile.held[t] = rough || is_bore || hydrostatic[tile.first + t] != 0 ? 1.0 : 0.0;
        const double e = tile.elevation[t];
        const double left = tile.elevation_minus[t] + tile.elevation_plus[t] - 2.0 * e;
        const double right = tile.elevation_minus[t + 1] + tile.elevation_plus[t + 1] - 2.0 * e;
        const double rise =
            ((e - tile.face_bed[t + 1]) * right - (e - tile.face_bed[t]) * left) / tile.depth[t];
        tile.elevation_slope[t] = tile.held[t] != 0.0 ? 0.0 : scale * rise;
    }
    tile.held[tile.begin() - 2] = tile.held[tile.end() + 1] = 0.0;  // read, but without effect on inner cells
}

/// Value at the offshore face of cell t from cell averages, fourth order.
inline double face_value(const double* v, std::size_t t) {
    return (7.0 * (v[t - 1] + v[t]) - (v[t - 2] + v[t + 1])) / 12.0;
}
/// Slope there times the spacing, fourth order.
inline double face_difference(const double* v, std::size_t t) {
    return (15.0 * (v[t] - v[t - 1]) - (v[t + 1] - v[t - 2])) / 12.0;
}

/// alpha h T + h on the left, h ((g/alpha) eta_x + Q) on the right, from the slopes.
/// Beside dry cells (`is_smooth` false) face values come from the two cells at the face only. `has_held`:
/// some cells of the tile are held.
template <bool is_smooth, bool has_held>
void assemble(Tile& tile, const FlowParameters& flow) {
    const double inverse = 1.0 / flow.spacing;
    const double sqrt3 = std::sqrt(3.0);
    const double* h = tile.depth.value;
    const double* u = tile.velocity.value;
    const double* b = tile.bed.value;
    const double* s = tile.elevation_slope.value;
    const double* bed_slope = tile.bed_slope.value;
    const std::size_t from = tile.begin(), to = tile.end();

    for (std::size_t t = from - 2; t < to + 3; ++t)
        tile.bed_slope[t] = std::clamp((b[t] - b[t - 1]) * inverse, -steepest_slope, steepest_slope);
    for (std::size_t t = from - 2; t < to + 2; ++t) {
        tile.curvature[t] = square(h[t] * u[t]) * (bed_slope[t + 1] - bed_slope[t]) * inverse;
        if constexpr (is_smooth && has_held) tile.curvature[t] *= 1.0 - tile.held[t];
    }
    for (std::size_t t = from - 1; t < to + 2; ++t) {
        const double depth = is_smooth ? face_value(h, t) : 0.5 * (h[t - 1] + h[t]);
        const double p = depth * inverse / sqrt3, r = 0.25 * sqrt3 * bed_slope[t],
                     q = square(0.25 * bed_slope[t]);
        // No coupling and none but hydrostatic pressure at the edge of held cells: the natural condition,
        // which keeps the operator symmetric and momentum conserved.
        const double mild = std::abs(b[t] - b[t - 1]) * inverse > steepest_slope ? 0.0 : 1.0;
        double coupled = mild;
        if constexpr (has_held) coupled *= (1.0 - tile.held[t - 1]) * (1.0 - tile.held[t]);
        const double weight = coupled * flow.alpha * depth;
        // The smaller depth keeps the matrix positive.
        const double numerov = coupled * std::min(h[t - 1], h[t]) / 12.0;
        tile.numerov[t] = numerov;
        tile.off_diagonal[t] = weight * (q - (p - r) * (p + r)) + numerov;
        tile.diagonal[t] = weight * (square(p - r) + q) - numerov;        // of the cell shoreward
        tile.diagonal_minus[t] = weight * (square(p + r) + q) - numerov;  // of the cell offshore
        const double difference = is_smooth ? face_difference(u, t) : u[t] - u[t - 1];
        const double strain = coupled * depth * square(difference * inverse);
        tile.stretch[t] = square(depth) * strain;
        tile.bed_stretch[t] = depth * strain * bed_slope[t];
    }
    for (std::size_t t = from - 1; t < to + 1; ++t) {
        const double slope = 0.5 * (bed_slope[t] + bed_slope[t + 1]);
        const double bend = (bed_slope[t + 1] - bed_slope[t]) * inverse;
        tile.force[t] = (2.0 / 3.0) * (tile.stretch[t + 1] - tile.stretch[t]) * inverse +
                        0.5 * (tile.bed_stretch[t + 1] + tile.bed_stretch[t]) +
                        0.25 * (tile.curvature[t + 1] - tile.curvature[t - 1]) * inverse +
                        h[t] * square(u[t]) * bend * slope;
        if constexpr (is_smooth && has_held) tile.force[t] *= 1.0 - tile.held[t];
    }
    for (std::size_t t = from; t < to; ++t) {
        const double averaged_slope =
            h[t] * s[t] + tile.numerov[t + 1] * (s[t + 1] - s[t]) - tile.numerov[t] * (s[t] - s[t - 1]);
        const double averaged_force =
            is_smooth ? (tile.force[t - 1] + 10.0 * tile.force[t] + tile.force[t + 1]) / 12.0 : tile.force[t];
        tile.right_side[t] = averaged_slope + averaged_force;
        tile.diagonal[t] += h[t] + tile.diagonal_minus[t + 1];
    }
}

/// Rows of held cells: D = 0, nothing else.
void release_held(Tile& tile) {
    for (std::size_t t = tile.begin(); t < tile.end(); ++t) {
        if (tile.held[t] == 0.0) continue;
        tile.diagonal[t] = 1.0;
        tile.right_side[t] = 0.0;
    }
}

}  // namespace

void assemble_wet_dispersion(Tile& tile, const FlowParameters& flow) {
    wet_slopes(tile, flow);
    assemble<true, false>(tile, flow);
}

void assemble_wet_dispersion(Tile& tile, const FlowParameters& flow, const unsigned char* hydrostatic) {
    wet_slopes(tile, flow);
    for (std::size_t t = tile.begin() - 2; t < tile.end() + 2; ++t) {
        tile.held[t] = hydrostatic[tile.first + t] != 0 ? 1.0 : 0.0;
        if (tile.held[t] != 0.0) tile.elevation_slope[t] = 0.0;
    }
    assemble<true, true>(tile, flow);
    release_held(tile);
}

void assemble_shoreline_dispersion(Tile& tile, const FlowParameters& flow, const unsigned char* hydrostatic) {
    shoreline_slopes(tile, flow, hydrostatic);
    assemble<false, true>(tile, flow);
    release_held(tile);
}

void eliminate(Tile* left, Tile* right, DispersionSystem& system, ChainEnds& ends) {
    // Two independent chains; each waits on its own division only.
    double* ratio = system.ratio.data();
    double* value = system.value.data();
    const auto step_left = [&](std::size_t t) {
        const double before = left->off_diagonal[t];
        const double pivot = 1.0 / (left->diagonal[t] - before * ends.left_ratio);
        ends.left_ratio = left->off_diagonal[t + 1] * pivot;
        ends.left_value = (left->right_side[t] - before * ends.left_value) * pivot;
        ratio[left->first + t] = ends.left_ratio;
        value[left->first + t] = ends.left_value;
    };
    const auto step_right = [&](std::size_t t) {
        const double before = right->off_diagonal[t + 1];
        const double pivot = 1.0 / (right->diagonal[t] - before * ends.right_ratio);
        ends.right_ratio = right->off_diagonal[t] * pivot;
        ends.right_value = (right->right_side[t] - before * ends.right_value) * pivot;
        ratio[right->first + t] = ends.right_ratio;
        value[right->first + t] = ends.right_value;
    };
    const std::size_t count_left = left ? left->count : 0, count_right = right ? right->count : 0;
    const std::size_t together = count_left < count_right ? count_left : count_right;
    for (std::size_t j = 0; j < together; ++j) {
        step_left(ghost_cells + j);
        step_right(ghost_cells + count_right - 1 - j);
    }
    for (std::size_t j = together; j < count_left; ++j) step_left(ghost_cells + j);
    for (std::size_t j = together; j < count_right; ++j) step_right(ghost_cells + count_right - 1 - j);
}

void subtract_accelerations(const DispersionSystem& system, std::size_t middle, std::size_t cells,
                            double step, const double* depth, double* discharge) {
    const double* ratio = system.ratio.data();
    const double* value = system.value.data();
    const std::size_t first = ghost_cells, last = ghost_cells + cells - 1;
    const std::size_t centre = ghost_cells + middle;  // first cell of the right chain
    double left = 0.0, right = 0.0;
    if (middle == cells) {  // one chain only
        left = value[last];
        discharge[last] -= step * depth[last] * left;
    } else {  // where the chains meet: two unknowns, two equations
        const double ratio_left = ratio[centre - 1], ratio_right = ratio[centre];
        right = (value[centre] - ratio_right * value[centre - 1]) / (1.0 - ratio_left * ratio_right);
        left = value[centre - 1] - ratio_left * right;
        discharge[centre] -= step * depth[centre] * right;
        discharge[centre - 1] -= step * depth[centre - 1] * left;
    }
    // Asked for ahead of the recurrences, which leave the processor no time to wait.
    constexpr std::size_t ahead = 128, line = 64 / sizeof(double);
    const auto fetch = [&](std::size_t k) {
        __builtin_prefetch(ratio + k);
        __builtin_prefetch(value + k);
        __builtin_prefetch(depth + k);
        __builtin_prefetch(discharge + k, 1);
    };
    std::size_t i = centre - 1, j = centre;
    while (i > first && j < last) {
        --i;
        ++j;
        if (i % line == 0) {
            fetch(i > first + ahead ? i - ahead : first);
            fetch(std::min(j + ahead, last));
        }
        left = value[i] - ratio[i] * left;
        right = value[j] - ratio[j] * right;
        discharge[i] -= step * depth[i] * left;
        discharge[j] -= step * depth[j] * right;
    }
    while (i > first) {
        --i;
        left = value[i] - ratio[i] * left;
        discharge[i] -= step * depth[i] * left;
    }
    while (j < last) {
        ++j;
        right = value[j] - ratio[j] * right;
        discharge[j] -= step * depth[j] * right;
    }
}

}  // namespace boussinesq
