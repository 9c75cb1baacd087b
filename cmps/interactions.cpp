#include "cmps/interactions.hpp"

#include <algorithm>
#include <cmath>

#include "common/parallel.hpp"

namespace cmps {

namespace {
constexpr std::size_t serial_below = 2000;  // rows; less is done before threads are awake
}

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

    const double* const x = particles.x.data();
    const double* const z = particles.z.data();
    const std::int32_t* const neighbour = lists.neighbour.data();
    float* const all_dx = out.dx.data();
    float* const all_dz = out.dz.data();
    float* const all_w = out.weight.data();
    float* const all_g = out.weight_over_r2.data();

    // Block by block, so that a block's pairs stay in cache from the first loop to the last.
    constexpr std::size_t block = 64;  // rows; about 1700 pairs, 80 kB
    common::parallel_for((rows + block - 1) / block, serial_below / block, [&](std::size_t b) {
        const std::size_t row0 = b * block, row1 = std::min(rows, row0 + block);
        const std::size_t from = lists.start[row0], to = lists.start[row1];
        thread_local std::vector<double> scratch;
        scratch.resize(5 * (to - from));
        double* const dx = scratch.data() - from;
        double* const dz = dx + (to - from);
        double* const w = dz + (to - from);
        double* const over_r = w + (to - from);  // w / r
        double* const g = over_r + (to - from);  // w / r^2
        for (std::size_t r = row0; r < row1; ++r) {
            const double xi = x[first + r], zi = z[first + r];
#pragma omp simd
            for (std::size_t k = lists.start[r]; k < lists.start[r + 1]; ++k) {
                dx[k] = x[neighbour[k]] - xi;
                dz[k] = z[neighbour[k]] - zi;
            }
        }
        // one flat run: roots and divisions stay vectorised whatever the rows' lengths
#pragma omp simd
        for (std::size_t k = from; k < to; ++k) {
            const double r2 = dx[k] * dx[k] + dz[k] * dz[k], r = std::sqrt(r2);
            w[k] = kernel.weight(r2), over_r[k] = w[k] / r, g[k] = over_r[k] / r;
        }
#pragma omp simd
        for (std::size_t k = from; k < to; ++k) {
            all_dx[k] = static_cast<float>(dx[k]), all_dz[k] = static_cast<float>(dz[k]);
            all_w[k] = static_cast<float>(w[k]), all_g[k] = static_cast<float>(g[k]);
        }
        for (std::size_t r = row0; r < row1; ++r) {
            const std::size_t begin = lists.start[r], carriers = lists.carriers[r], end = lists.start[r + 1];
            double n = 0, fx = 0, fz = 0, sx = 0, sz = 0;
#pragma omp simd reduction(+ : n, fx, fz, sx, sz)
            for (std::size_t k = begin; k < end; ++k) {
                n += w[k], fx += over_r[k] * dx[k], fz += over_r[k] * dz[k], sx += g[k] * dx[k],
                    sz += g[k] * dz[k];
            }
            double xx = 0, xz = 0, zz = 0;
#pragma omp simd reduction(+ : xx, xz, zz)
            for (std::size_t k = carriers; k < end; ++k) {
                xx += g[k] * dx[k] * dx[k], xz += g[k] * dx[k] * dz[k], zz += g[k] * dz[k] * dz[k];
            }
            out.number_density[r] = n;
            out.asymmetry_x[r] = fx, out.asymmetry_z[r] = fz;
            out.crowding_x[r] = sx, out.crowding_z[r] = sz;
            out.moment_xx[r] = xx, out.moment_xz[r] = xz, out.moment_zz[r] = zz;
        }
        if (extras.slope)
#pragma omp simd
            for (std::size_t k = from; k < to; ++k)
                out.slope[k] = static_cast<float>(kernel.slope(dx[k] * dx[k] + dz[k] * dz[k]));
        if (extras.curvature)
#pragma omp simd
            for (std::size_t k = from; k < to; ++k)
                out.curvature[k] = static_cast<float>(kernel.curvature(dx[k] * dx[k] + dz[k] * dz[k]));
    });
}

template void compute_interactions(const RationalKernel&, const Particles&, const NeighbourLists&, PairExtras,
                                   Interactions&);
template void compute_interactions(const WendlandKernel&, const Particles&, const NeighbourLists&, PairExtras,
                                   Interactions&);

}  // namespace cmps
