#include "cmps/velocity_filter.hpp"

#include <algorithm>

#include "common/parallel.hpp"

namespace cmps {
namespace {

constexpr std::size_t serial_below = 2000;  // fluid particles

}  // namespace

void VelocityFilter::find_gradients(const Particles& particles, const NeighbourLists& lists,
                                    const Interactions& interactions, double lattice_density) {
    const std::size_t first = particles.first_fluid(), walls = particles.walls;
    for (auto* array : {&du_dx, &du_dz, &dw_dx, &dw_dz}) array->resize(particles.fluid);
    begin_.resize(particles.fluid);
    const double smallest = 0.02 * lattice_density * lattice_density;  // determinant; the lattice's is n0^2/4
    const double* const u = particles.u.data();
    const double* const w = particles.w.data();
    const std::int32_t* const neighbour = lists.neighbour.data();
    const float* const all_x = interactions.dx.data();
    const float* const all_z = interactions.dz.data();
    const float* const all_g = interactions.weight_over_r2.data();
    common::parallel_for(particles.fluid, serial_below, [&](std::size_t f) {
        const std::size_t row = walls + f, end = lists.start[row + 1];
        std::size_t begin = lists.carriers[row];
        const double ui = u[first + f], wi = w[first + f];
        double ux = 0, uz = 0, wx = 0, wz = 0;
        double xx = interactions.moment_xx[row], xz = interactions.moment_xz[row],
               zz = interactions.moment_zz[row];
        for (; begin < end && static_cast<std::size_t>(neighbour[begin]) < first;
             ++begin) {  // walls do not count
            const double gx = all_g[begin] * all_x[begin], gz = all_g[begin] * all_z[begin];
            xx -= gx * all_x[begin], xz -= gx * all_z[begin], zz -= gz * all_z[begin];
        }
        begin_[f] = begin;
#pragma omp simd reduction(+ : ux, uz, wx, wz)
        for (std::size_t k = begin; k < end; ++k) {
            const double gx = all_g[k] * all_x[k], gz = all_g[k] * all_z[k];
            const double du = u[neighbour[k]] - ui, dw = w[neighbour[k]] - wi;
            ux += gx * du, uz += gz * du, wx += gx * dw, wz += gz * dw;
        }
        const double determinant = xx * zz - xz * xz;
        const double scale = determinant > smallest ? 1.0 / determinant : 0.0;  // too few neighbours: zero
        du_dx[f] = scale * (zz * ux - xz * uz), du_dz[f] = scale * (xx * uz - xz * ux);
        dw_dx[f] = scale * (zz * wx - xz * wz), dw_dz[f] = scale * (xx * wz - xz * wx);
    });
}

void VelocityFilter::apply(Particles& particles, const NeighbourLists& lists,
                           const Interactions& interactions, double lattice_density, double share) {
    const std::size_t first = particles.first_fluid(), walls = particles.walls;
    change_u_.resize(particles.fluid), change_w_.resize(particles.fluid);
    const double* const u = particles.u.data();
    const double* const w = particles.w.data();
    const double* const ux = du_dx.data();
    const double* const uz = du_dz.data();
    const double* const wx = dw_dx.data();
    const double* const wz = dw_dz.data();
    const std::int32_t* const neighbour = lists.neighbour.data();
    const float* const all_x = interactions.dx.data();
    const float* const all_z = interactions.dz.data();
    const float* const weight = interactions.weight.data();
    const auto start = static_cast<std::int32_t>(first);
    common::parallel_for(particles.fluid, serial_below, [&](std::size_t f) {
        const double ui = u[first + f], wi = w[first + f];
        double su = 0, sw = 0;
#pragma omp simd reduction(+ : su, sw)
        for (std::size_t k = begin_[f]; k < lists.start[walls + f + 1]; ++k) {
            const std::int32_t j = neighbour[k], q = j - start;
            const double dx = 0.5 * all_x[k], dz = 0.5 * all_z[k];
            su += weight[k] * (u[j] - ui - (ux[f] + ux[q]) * dx - (uz[f] + uz[q]) * dz);
            sw += weight[k] * (w[j] - wi - (wx[f] + wx[q]) * dx - (wz[f] + wz[q]) * dz);
        }
        change_u_[f] = share / lattice_density * su, change_w_[f] = share / lattice_density * sw;
    });
    for (std::size_t f = 0; f < particles.fluid; ++f)
        particles.u[first + f] += change_u_[f], particles.w[first + f] += change_w_[f];
}

}  // namespace cmps
