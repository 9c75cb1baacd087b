#include "cmps/pressure_equation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cmps/gradient.hpp"
#include "common/parallel.hpp"

namespace cmps {

double PressureEquation::divergence(const Particles& particles, const NeighbourLists& lists,
                                    const Interactions& interactions, std::size_t row) const {
    const std::size_t i = particles.first_wall() + row;
    const double ui = particles.u[i], wi = particles.w[i];
    const double* const u = particles.u.data();
    const double* const w = particles.w.data();
    const float* const dx = interactions.dx.data();
    const float* const dz = interactions.dz.data();
    const std::int32_t* const neighbour = lists.neighbour.data();
    if (settings_.source == Source::corrected) {
        const float* const g = interactions.weight_over_r2.data();
        double xx = 0, xz = 0, zx = 0, zz = 0;  // sum u_ij r_ij^T w / r^2
#pragma omp simd reduction(+ : xx, xz, zx, zz)
        for (std::size_t k = lists.carriers[row]; k < lists.start[row + 1]; ++k) {
            const double du = (u[neighbour[k]] - ui) * g[k], dw = (w[neighbour[k]] - wi) * g[k];
            xx += du * dx[k], xz += du * dz[k], zx += dw * dx[k], zz += dw * dz[k];
        }
        const Correction c = correction_of(interactions, row, lattice_.number_density);
        return 2.0 / lattice_.number_density * (c.xx * xx + c.xz * (xz + zx) + c.zz * zz);
    }
    const float* const slope = interactions.slope.data();
    double sum = 0;
#pragma omp simd reduction(+ : sum)
    for (std::size_t k = lists.start[row]; k < lists.start[row + 1]; ++k)
        sum -= slope[k] * (dx[k] * (u[neighbour[k]] - ui) + dz[k] * (w[neighbour[k]] - wi));
    sum += slip(particles, lists, interactions, row);
    return sum / (lattice_.number_density * lattice_.divergence_scale);
}

/// What water sliding along walls has added to the sum of `divergence`, with the sign that takes it away.
///
/// A wall is smooth: only how fast water comes at it counts. The tangential part of a pair's velocity cancels
/// in the mean over the wall's particles; what does not cancel is a roughness of the particles' spacing, that
/// brakes and lifts a thin tongue.
double PressureEquation::slip(const Particles& particles, const NeighbourLists& lists,
                              const Interactions& interactions, std::size_t row) const {
    const std::size_t i = particles.first_wall() + row, first_fluid = particles.first_fluid();
    const std::size_t begin = lists.start[row], end = lists.start[row + 1];
    double sum = 0;
    if (i >= first_fluid) {  // boundary neighbours stand first
        for (std::size_t k = begin; k < end; ++k) {
            const auto j = static_cast<std::size_t>(lists.neighbour[k]);
            if (j >= first_fluid) break;
            const double tx = -particles.normal_z[j], tz = particles.normal_x[j];
            const double along =
                tx * (particles.u[j] - particles.u[i]) + tz * (particles.w[j] - particles.w[i]);
            sum += static_cast<double>(interactions.slope[k]) * along *
                   (tx * interactions.dx[k] + tz * interactions.dz[k]);
        }
        return sum;
    }
    // a wall's own particle goes along with the mean of the water before it
    const double tx = -particles.normal_z[i], tz = particles.normal_x[i];
    double mean = 0, weights = 0, lever = 0;
    for (std::size_t k = end; k-- > begin;) {
        const auto j = static_cast<std::size_t>(lists.neighbour[k]);
        if (j < first_fluid) break;
        const double weight = interactions.weight[k];
        mean += weight * (tx * (particles.u[j] - particles.u[i]) + tz * (particles.w[j] - particles.w[i]));
        weights += weight;
        lever +=
            static_cast<double>(interactions.slope[k]) * (tx * interactions.dx[k] + tz * interactions.dz[k]);
    }
    return weights > 0 ? mean / weights * lever : 0.0;
}

double PressureEquation::surface_share(const Interactions& interactions, std::size_t row) const {
    const double fx = interactions.asymmetry_x[row], fz = interactions.asymmetry_z[row];
    const double asymmetry = std::sqrt(fx * fx + fz * fz);
    // F/n0 is 0.29 in the first row of a flat surface, 0.07 in the second, 0.02 from disorder inside
    return std::clamp((asymmetry / lattice_.number_density - 0.06) / (0.18 - 0.06), 0.0, 1.0);
}

double PressureEquation::missing_kernel(const Interactions& interactions, std::size_t row) const {
    const double missing = std::max(0.0, lattice_.number_density - interactions.number_density[row]);
    // p of the image is -p_i: p_i - p_image = 2 p_i
    return 2.0 * surface_share(interactions, row) * missing;
}

void PressureEquation::assemble(const Particles& particles, const NeighbourLists& lists,
                                const Interactions& interactions, const std::vector<Place>& place,
                                double time_step, double correction_step) {
    const std::size_t first = particles.first_wall(), rows = particles.size() - first;
    unknown_of.resize(rows);
    row_of.clear();
    const bool is_smooth = settings_.surface == SurfaceCondition::smooth;
    const double n0 = lattice_.number_density;
    // a few particles in disorder, in corners mostly, are no surface
    constexpr std::size_t few = 6, share = 50;
    std::size_t at_surface = 0;
    for (std::size_t r = particles.walls; r < rows; ++r) at_surface += place[r] >= Place::surface;
    is_closed = at_surface <= few && at_surface * share < particles.fluid;
    for (std::size_t r = 0; r < rows; ++r) {
        const bool is_unknown = is_smooth ? place[r] != Place::dry : place[r] < Place::surface;
        unknown_of[r] = is_unknown ? static_cast<std::int32_t>(row_of.size()) : -1;
        if (is_unknown) row_of.push_back(static_cast<std::int32_t>(r));
    }
    const std::size_t unknowns = row_of.size();
    matrix.start.resize(unknowns + 1);
    matrix.upper.resize(unknowns);
    matrix.diagonal.resize(unknowns);
    matrix.column.resize(lists.neighbour.size() + 1);  // one place to write what does not count
    matrix.value.resize(lists.neighbour.size() + 1);
    right_hand_side.resize(unknowns);
    density_error.resize(rows);

    const bool is_higher_order = settings_.laplacian == Laplacian::higher_order;
    const float* const coefficient =
        is_higher_order ? interactions.curvature.data() : interactions.weight.data();
    // both are scaled to sum c (p_i - p_j) = -scale * laplacian(p) on the lattice
    const double scale = is_higher_order ? lattice_.number_density * lattice_.laplacian_scale
                                         : lattice_.number_density * lattice_.lambda / 4.0;
    const std::int32_t* const neighbour = lists.neighbour.data();
    const std::int32_t* const unknown = unknown_of.data() - first;  // by particle
    std::int32_t* const column = matrix.column.data();
    float* const value = matrix.value.data();
    std::size_t next = 0;
    matrix.start[0] = 0;
    for (std::size_t a = 0; a < unknowns; ++a) {
        const std::size_t row = static_cast<std::size_t>(row_of[a]);
        const std::size_t begin = next, from = lists.carriers[row], end = lists.start[row + 1];
        double diagonal = 0;
#pragma omp simd reduction(+ : diagonal)
        for (std::size_t k = from; k < end; ++k) diagonal += static_cast<double>(coefficient[k]);
        // an entry is written in any case and overwritten by the next one where it does not count: no branch
        for (std::size_t k = from; k < end; ++k) {
            const std::int32_t b = unknown[neighbour[k]];
            column[next] = b;
            value[next] = -coefficient[k];
            next += (b >= 0) & (coefficient[k] > 0);
        }
        std::int32_t left = 0;
#pragma omp simd reduction(+ : left)
        for (std::size_t k = begin; k < next; ++k) left += column[k] < static_cast<std::int32_t>(a);
        matrix.upper[a] = static_cast<std::uint32_t>(begin) + static_cast<std::uint32_t>(left);
        if (is_smooth && !is_closed)
            diagonal +=
                missing_kernel(interactions, row) * (is_higher_order ? lattice_.laplacian_ratio : 1.0);
        // a closed full box has no surface: the small excess makes it regular
        matrix.diagonal[a] = std::max(diagonal, 1e-3 * n0) * (1 + 1e-7);
        matrix.start[a + 1] = static_cast<std::uint32_t>(next);
    }
    common::parallel_for(rows, 2000, [&](std::size_t row) {
        density_error[row] = (interactions.number_density[row] - n0) / n0;
        if (unknown_of[row] < 0) return;
        // At the surface the kernel is cut short and the volume free to change: only p = 0 holds there. A
        // wall, though, answers to water that comes at it before the kernel between them has filled.
        const double inner = is_smooth ? 1 - surface_share(interactions, row) : 1.0;
        double source = inner * settings_.density_weight / correction_step * density_error[row];
        if (settings_.source != Source::density) {
            const double convergence = -divergence(particles, lists, interactions, row);
            if (settings_.source == Source::error_compensating) {
                const double a = density_error[row];
                source = inner * (std::abs(a) * convergence + std::abs(convergence) * a);
            }
            source += row < particles.walls && convergence > 0 ? convergence : inner * convergence;
        }
        right_hand_side[static_cast<std::size_t>(unknown_of[row])] =
            scale * settings_.density / time_step * source;
    });
    if (!is_closed || unknowns == 0) return;
    // Water that nothing lets out neither swells nor shrinks: what is left in the mean is an error, which no
    // pressure can take away.
    const double mean =
        std::accumulate(right_hand_side.begin(), right_hand_side.end(), 0.0) / static_cast<double>(unknowns);
    for (double& value_of : right_hand_side) value_of -= mean;
}

}  // namespace cmps
