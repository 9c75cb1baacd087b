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
    for (auto* array : {&out.number_density, &out.asymmetry_x, &out.asymmetry_z, &out.crowding_x, &out.crowding_z,
                        &out.moment_xx, &out.moment_xz, &out.moment_zz})
        array->resize(rows);

    const double* const x = particles.x.data();
    const double* const z = particles.z.data();
    const std::int32_t* const neighbour = lists.neighbour.data();
    double* const all_dx = out.dx.data();
    double* const all_dz = out.dz.data();
    double* const all_w = out.weight.data();
    double* const all_g = out.weight_over_r2.data();

    // Block by block, so that a block's pairs stay in cache from the first loop to the last.
    constexpr std::size_t block = 64;  // rows; about 1700 pairs, 80 kB
    common::parallel_for((rows + block - 1) / block, serial_below / block, [&](std::size_t b) {
        const std::size_t row0 = b * block, row1 = std::min(rows, row0 + block);
        const std::uint32_t from = lists.start[row0], to = lists.start[row1];
        for (std::size_t r = row0; r < row1; ++r) {
            const double xi = x[first + r], zi = z[first + r];
#pragma omp simd
            for (std::uint32_t k = lists.start[r]; k < lists.start[r + 1]; ++k) {
                all_dx[k] = x[neighbour[k]] - xi;
                all_dz[k] = z[neighbour[k]] - zi;
            }
        }
        // one flat run: roots and divisions stay vectorised whatever the rows' lengths
        thread_local std::vector<double> over_r_store;
        over_r_store.resize(to - from);
        double* const over_r = over_r_store.data() - from;  // w / r
#pragma omp simd
        for (std::uint32_t k = from; k < to; ++k) {
            const double r2 = all_dx[k] * all_dx[k] + all_dz[k] * all_dz[k], r = std::sqrt(r2);
            const double w = kernel.weight(r2), ratio = w / r;
            all_w[k] = w, over_r[k] = ratio, all_g[k] = ratio / r;
        }
        for (std::size_t r = row0; r < row1; ++r) {
            const std::uint32_t begin = lists.start[r], carriers = lists.carriers[r], end = lists.start[r + 1];
            double n = 0, fx = 0, fz = 0, sx = 0, sz = 0;
#pragma omp simd reduction(+ : n, fx, fz, sx, sz)
            for (std::uint32_t k = begin; k < end; ++k) {
                const double dx = all_dx[k], dz = all_dz[k];
                n += all_w[k], fx += over_r[k] * dx, fz += over_r[k] * dz, sx += all_g[k] * dx, sz += all_g[k] * dz;
            }
            double xx = 0, xz = 0, zz = 0;
#pragma omp simd reduction(+ : xx, xz, zz)
            for (std::uint32_t k = carriers; k < end; ++k) {
                const double g = all_g[k], dx = all_dx[k], dz = all_dz[k];
                xx += g * dx * dx, xz += g * dx * dz, zz += g * dz * dz;
            }
            out.number_density[r] = n;
            out.asymmetry_x[r] = fx, out.asymmetry_z[r] = fz;
            out.crowding_x[r] = sx, out.crowding_z[r] = sz;
            out.moment_xx[r] = xx, out.moment_xz[r] = xz, out.moment_zz[r] = zz;
        }
        if (extras.slope)
#pragma omp simd
            for (std::uint32_t k = from; k < to; ++k)
                out.slope[k] = kernel.slope(all_dx[k] * all_dx[k] + all_dz[k] * all_dz[k]);
        if (extras.curvature)
#pragma omp simd
            for (std::uint32_t k = from; k < to; ++k)
                out.curvature[k] = kernel.curvature(all_dx[k] * all_dx[k] + all_dz[k] * all_dz[k]);
    });
}

template void compute_interactions(const RationalKernel&, const Particles&, const NeighbourLists&, PairExtras, Interactions&);
template void compute_interactions(const WendlandKernel&, const Particles&, const NeighbourLists&, PairExtras, Interactions&);

}  // namespace cmps
