#include "cmps/interactions.hpp"

#include <algorithm>
#include <cmath>

#include "common/parallel.hpp"

namespace cmps {

namespace {

constexpr std::size_t serial_below = 2000;  // rows; less is done before threads are awake

/// Weights, and slopes where asked for, of `count` pairs in one flat run: roots and divisions stay vectorised
/// whatever the rows' lengths.
template <bool has_slope, class Kernel>
void weigh(const Kernel& kernel, std::size_t count, const float* dx, const float* dz, float* w,
           float* w_over_r, float* w_over_r2, float* slope) {
#pragma omp simd
    for (std::size_t k = 0; k < count; ++k) {
        const float r2 = dx[k] * dx[k] + dz[k] * dz[k], over_r = 1.0F / std::sqrt(r2);
        w[k] = kernel.weight(r2), w_over_r[k] = w[k] * over_r, w_over_r2[k] = w_over_r[k] * over_r;
        if constexpr (has_slope) slope[k] = kernel.slope(r2);
    }
}

}  // namespace

template <class Kernel>
void compute_interactions(const Kernel& kernel, const Particles& particles, const NeighbourLists& lists,
                          PairExtras extras, Interactions& out) {
    const std::size_t first = particles.first_wall(), rows = particles.size() - first;
    const std::size_t entries = lists.neighbour.size();
    for (auto* array : {&out.dx, &out.dz, &out.weight, &out.weight_over_r2}) array->resize(entries);
    if (extras.slope) out.slope.resize(entries);
    if (extras.curvature) out.curvature.resize(entries);
    for (auto* array : {&out.number_density, &out.asymmetry_x, &out.asymmetry_z, &out.crowding_x,
                        &out.crowding_z, &out.moment_xx, &out.moment_xz, &out.moment_zz})
        array->resize(rows);
    out.largest_weight.resize(rows);

    const double* const x = particles.x.data();
    const double* const z = particles.z.data();
    const std::int32_t* const neighbour = lists.neighbour.data();
    float* const all_dx = out.dx.data();
    float* const all_dz = out.dz.data();
    float* const all_w = out.weight.data();
    float* const all_g = out.weight_over_r2.data();

    // Block by block, so that a block's pairs stay in cache from the first loop to the last.
    constexpr std::size_t block = 64;  // rows; about 1700 pairs, 40 kB
    common::parallel_for((rows + block - 1) / block, serial_below / block, [&](std::size_t b) {
        const std::size_t row0 = b * block, row1 = std::min(rows, row0 + block);
        const std::size_t from = lists.start[row0], to = lists.start[row1];
        thread_local std::vector<float> scratch;
        scratch.resize(to - from);
        float* const w_over_r = scratch.data();
        for (std::size_t r = row0; r < row1; ++r) {
            const double xi = x[first + r], zi = z[first + r];
#pragma omp simd
            for (std::size_t k = lists.start[r]; k < lists.start[r + 1]; ++k) {
                all_dx[k] = static_cast<float>(x[neighbour[k]] - xi);
                all_dz[k] = static_cast<float>(z[neighbour[k]] - zi);
            }
        }
        const auto weigh_block = extras.slope ? weigh<true, Kernel> : weigh<false, Kernel>;
        weigh_block(kernel, to - from, all_dx + from, all_dz + from, all_w + from, w_over_r, all_g + from,
                    out.slope.data() + from);
        if (extras.curvature)
#pragma omp simd
            for (std::size_t k = from; k < to; ++k)
                out.curvature[k] = kernel.curvature(all_dx[k] * all_dx[k] + all_dz[k] * all_dz[k]);
        const float* const dx = all_dx + from;
        const float* const dz = all_dz + from;
        const float* const w = all_w + from;
        const float* const g = all_g + from;
        for (std::size_t r = row0; r < row1; ++r) {
            const std::size_t begin = lists.start[r] - from, carriers = lists.carriers[r] - from,
                              end = lists.start[r + 1] - from;
            float n = 0, fx = 0, fz = 0, sx = 0, sz = 0, largest = 0;
#pragma omp simd reduction(+ : n, fx, fz, sx, sz) reduction(max : largest)
            for (std::size_t k = begin; k < end; ++k) {
                largest = w[k] > largest ? w[k] : largest;
                n += w[k], fx += w_over_r[k] * dx[k], fz += w_over_r[k] * dz[k], sx += g[k] * dx[k],
                    sz += g[k] * dz[k];
            }
            float xx = 0, xz = 0, zz = 0;
#pragma omp simd reduction(+ : xx, xz, zz)
            for (std::size_t k = carriers; k < end; ++k) {
                xx += g[k] * dx[k] * dx[k], xz += g[k] * dx[k] * dz[k], zz += g[k] * dz[k] * dz[k];
            }
            out.largest_weight[r] = largest;
            out.number_density[r] = static_cast<double>(n);
            out.asymmetry_x[r] = static_cast<double>(fx), out.asymmetry_z[r] = static_cast<double>(fz);
            out.crowding_x[r] = static_cast<double>(sx), out.crowding_z[r] = static_cast<double>(sz);
            out.moment_xx[r] = static_cast<double>(xx), out.moment_xz[r] = static_cast<double>(xz),
            out.moment_zz[r] = static_cast<double>(zz);
        }
    });
}

template void compute_interactions(const RationalKernel&, const Particles&, const NeighbourLists&, PairExtras,
                                   Interactions&);
template void compute_interactions(const WendlandKernel&, const Particles&, const NeighbourLists&, PairExtras,
                                   Interactions&);

}  // namespace cmps
