#include "boussinesq/shallow_water.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "boussinesq/reconstruction.hpp"

namespace boussinesq {
namespace {

/// Depth, in dry depths, from which the kernels for wet cells hold.
constexpr double deep = 100.0;

/// HLL flux of depth and discharge between (h, u) on the offshore and on the shoreward side of a face.
struct Flux {
    double depth, discharge;
};
inline Flux hll_flux(double h_minus, double u_minus, double h_plus, double u_plus) {
    const double c_minus = std::sqrt(gravity * h_minus), c_plus = std::sqrt(gravity * h_plus);
    const double u_star = 0.5 * (u_minus + u_plus) + c_minus - c_plus;
    const double c_star = 0.5 * (c_minus + c_plus) + 0.25 * (u_minus - u_plus);
    const double left = std::min(std::min(u_minus - c_minus, u_star - c_star), 0.0);
    const double right = std::max(std::max(u_plus + c_plus, u_star + c_star), 0.0);
    const double q_minus = h_minus * u_minus, q_plus = h_plus * u_plus;
    const double p_minus = q_minus * u_minus + 0.5 * gravity * h_minus * h_minus;
    const double p_plus = q_plus * u_plus + 0.5 * gravity * h_plus * h_plus;
    const double scale = 1.0 / (right - left);
    return {(right * q_minus - left * q_plus + left * right * (h_plus - h_minus)) * scale,
            (right * p_minus - left * p_plus + left * right * (q_plus - q_minus)) * scale};
}

/// The same where either side may be dry: fronts run at u +- 2 c.
inline Flux hll_flux_beside_dry(double h_minus, double u_minus, double h_plus, double u_plus, double dry) {
    const double c_minus = std::sqrt(gravity * h_minus), c_plus = std::sqrt(gravity * h_plus);
    const double u_star = 0.5 * (u_minus + u_plus) + c_minus - c_plus;
    const double c_star = 0.5 * (c_minus + c_plus) + 0.25 * (u_minus - u_plus);
    const bool dry_minus = h_minus <= dry, dry_plus = h_plus <= dry;
    double left = dry_minus ? u_plus - 2.0 * c_plus : std::min(u_minus - c_minus, u_star - c_star);
    double right = dry_plus ? u_minus + 2.0 * c_minus : std::max(u_plus + c_plus, u_star + c_star);
    left = std::min(dry_plus ? u_minus - c_minus : left, 0.0);
    right = std::max(dry_minus ? u_plus + c_plus : right, 0.0);
    const double q_minus = h_minus * u_minus, q_plus = h_plus * u_plus;
    const double p_minus = q_minus * u_minus + 0.5 * gravity * h_minus * h_minus;
    const double p_plus = q_plus * u_plus + 0.5 * gravity * h_plus * h_plus;
    const double width = right - left;
    const double scale = width > 0.0 ? 1.0 / width : 0.0;
    return {(right * q_minus - left * q_plus + left * right * (h_plus - h_minus)) * scale,
            (right * p_minus - left * p_plus + left * right * (q_plus - q_minus)) * scale};
}

/// Elevation and velocity on both sides of faces [from, to). Velocity comes from the discharge, which stays
/// smooth where the bed does not, over the depth at the face; from the velocity itself where `may_be_dry` and
/// the water is shallow.
template <bool may_be_dry>
void reconstruct(Tile& tile, std::size_t from, std::size_t to, const FlowParameters& flow) {
    const double elevation_noise = flow.elevation_scale * flow.elevation_scale;
    const double discharge_noise = flow.discharge_scale * flow.discharge_scale;
    [[maybe_unused]] const double velocity_noise =
        gravity * flow.elevation_scale;  // of waves that small over as little water
    const double* e = tile.elevation.value;
    const double* q = tile.discharge.value;
#pragma omp simd
    for (std::size_t t = from; t < to; ++t) {
        tile.elevation_minus[t] = weno5(e[t - 3], e[t - 2], e[t - 1], e[t], e[t + 1], elevation_noise);
        tile.elevation_plus[t] = weno5(e[t + 2], e[t + 1], e[t], e[t - 1], e[t - 2], elevation_noise);
    }
#pragma omp simd
    for (std::size_t t = from; t < to; ++t) {
        const double minus = weno5(q[t - 3], q[t - 2], q[t - 1], q[t], q[t + 1], discharge_noise);
        const double plus = weno5(q[t + 2], q[t + 1], q[t], q[t - 1], q[t - 2], discharge_noise);
        tile.velocity_minus[t] = minus / std::max(tile.elevation_minus[t] - tile.face_bed[t], flow.dry_depth);
        tile.velocity_plus[t] = plus / std::max(tile.elevation_plus[t] - tile.face_bed[t], flow.dry_depth);
    }
    if constexpr (may_be_dry) {
        const double* u = tile.velocity.value;
        for (std::size_t t = from; t < to; ++t) {
            const double least = std::min(std::min(tile.depth[t - 1], tile.depth[t]),
                                          std::min(e[t - 1], e[t]) - tile.face_bed[t]);
            if (least > deep * flow.dry_depth) continue;  // as a tile that is deep throughout takes it
            tile.velocity_minus[t] = weno5(u[t - 3], u[t - 2], u[t - 1], u[t], u[t + 1], velocity_noise);
            tile.velocity_plus[t] = weno5(u[t + 2], u[t + 1], u[t], u[t - 1], u[t - 2], velocity_noise);
        }
    }
}

}  // namespace

void load_tile(Tile& tile, const double* depth, const double* discharge, const double* face_level,
               const FlowParameters& flow, bool may_be_dry) {
    const std::size_t width = tile.count + 2 * ghost_cells;
    const double* h = depth + tile.first;
    const double* q = discharge + tile.first;
    const double* b = face_level + tile.first;
    for (std::size_t t = 0; t < width; ++t) {
        tile.depth[t] = h[t];
        tile.discharge[t] = q[t];
        tile.face_bed[t] = b[t];
        tile.bed[t] = 0.5 * (b[t] + b[t + 1]);
        tile.elevation[t] = h[t] + tile.bed[t];
    }
    tile.face_bed[width] = b[width];
    if (may_be_dry) {
        // A film thinner than a few dry depths must not turn round-off into speed.
        const double film = 16.0 * flow.dry_depth * flow.dry_depth;
        for (std::size_t t = 0; t < width; ++t)
            tile.velocity[t] = 2.0 * h[t] * q[t] / (h[t] * h[t] + std::max(h[t] * h[t], film));
    } else {
        for (std::size_t t = 0; t < width; ++t) tile.velocity[t] = q[t] / h[t];
    }
}

bool is_deep(const Tile& tile, const FlowParameters& flow) {
    const std::size_t width = tile.count + 2 * ghost_cells;
    double shallowest = tile.depth[0];
    for (std::size_t t = 1; t < width; ++t) {
        const double lower = std::min(tile.elevation[t - 1], tile.elevation[t]);
        shallowest = std::min(shallowest, std::min(tile.depth[t], lower - tile.face_bed[t]));
    }
    // The reconstruction overshoots neighbours by a fraction of their difference only: a margin of a tenth of
    // the steepest step between neighbours would do; 100 dry depths is wider for every wave that is resolved.
    return shallowest > deep * flow.dry_depth;
}

void wet_fluxes(Tile& tile, const FlowParameters& flow) {
    const std::size_t from = tile.begin(), to = tile.end() + 1;
    reconstruct<false>(tile, from, to, flow);
#pragma omp simd
    for (std::size_t t = from; t < to; ++t) {
        const double h_minus = std::max(tile.elevation_minus[t] - tile.face_bed[t], flow.dry_depth);
        const double h_plus = std::max(tile.elevation_plus[t] - tile.face_bed[t], flow.dry_depth);
        const Flux flux = hll_flux(h_minus, tile.velocity_minus[t], h_plus, tile.velocity_plus[t]);
        tile.depth_flux[t] = flux.depth;
        tile.momentum_flux_plus[t] = flux.discharge;
    }
}

void shoreline_fluxes(Tile& tile, const FlowParameters& flow, double step) {
    const std::size_t from = tile.begin() - 1,
                      to = tile.end() + 2;  // one face more each side for the outflow limit
    reconstruct<true>(tile, from, to, flow);

    // Face states as each cell sees them: index t holds cell t's own view of its offshore (plus) and
    // shoreward (minus) face.
    constexpr double no_such_face = std::numeric_limits<double>::infinity();  // never the shallow one
    for (std::size_t t = from - 1; t < to; ++t) {
        double lowest = tile.depth[t];
        for (std::size_t n = t - 2; n <= t + 2; ++n) lowest = std::min(lowest, tile.depth[n]);
        const bool has_offshore = t >= from, has_shoreward = t + 1 < to;
        const double h_plus = has_offshore ? tile.elevation_plus[t] - tile.face_bed[t] : no_such_face;
        const double h_minus =
            has_shoreward ? tile.elevation_minus[t + 1] - tile.face_bed[t + 1] : no_such_face;
        const bool first_order =
            lowest <= flow.dry_depth || h_plus <= 0.25 * tile.depth[t] || h_minus <= 0.25 * tile.depth[t];
        tile.is_first_order[t] = first_order ? 1.0 : 0.0;
        if (first_order) {
            if (has_offshore)
                tile.elevation_plus[t] = tile.elevation[t], tile.velocity_plus[t] = tile.velocity[t];
            if (has_shoreward)
                tile.elevation_minus[t + 1] = tile.elevation[t],
                                         tile.velocity_minus[t + 1] = tile.velocity[t];
        }
        tile.level_plus[t] = first_order ? tile.bed[t] : tile.face_bed[t];
        tile.level_minus[t] = first_order ? tile.bed[t] : tile.face_bed[t + 1];
        tile.depth_plus[t] = first_order ? tile.depth[t] : h_plus;
        tile.depth_minus[t] = first_order ? tile.depth[t] : h_minus;
    }
    for (std::size_t t = from; t < to; ++t) {
        const double level = std::max(tile.level_minus[t - 1], tile.level_plus[t]);
        const double h_minus = std::max(tile.elevation_minus[t] - level, 0.0);
        const double h_plus = std::max(tile.elevation_plus[t] - level, 0.0);
        const Flux flux = hll_flux_beside_dry(h_minus, tile.velocity_minus[t], h_plus, tile.velocity_plus[t],
                                              1e-3 * flow.dry_depth);
        tile.depth_flux[t] = flux.depth;
        const double own_minus = tile.depth_minus[t - 1], own_plus = tile.depth_plus[t];
        tile.momentum_flux_minus[t] =
            flux.discharge + 0.5 * gravity * (own_minus * own_minus - h_minus * h_minus);
        tile.momentum_flux_plus[t] = flux.discharge + 0.5 * gravity * (own_plus * own_plus - h_plus * h_plus);
    }
    // No cell gives away more water than it holds; what is held back is held back on both sides of the face.
    const double share = step / flow.spacing;
    const auto allowed = [&](std::size_t t) {
        const double outflow =
            share * (std::max(tile.depth_flux[t + 1], 0.0) - std::min(tile.depth_flux[t], 0.0));
        return outflow > tile.depth[t] ? tile.depth[t] / outflow : 1.0;
    };
    for (std::size_t t = tile.begin() - 1; t <= tile.end(); ++t) tile.outflow_share[t] = allowed(t);
    for (std::size_t t = tile.begin(); t <= tile.end(); ++t)
        tile.depth_flux[t] *= tile.depth_flux[t] > 0.0 ? tile.outflow_share[t - 1] : tile.outflow_share[t];
}

}  // namespace boussinesq
