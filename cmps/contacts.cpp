#include "cmps/contacts.hpp"

#include <algorithm>
#include <cmath>

#include "common/parallel.hpp"

namespace cmps {
namespace {

constexpr std::size_t serial_below = 2000;  // particles
constexpr double restitution = 0.2;
constexpr double nearest = 0.1;    // of l0: no water comes nearer to a face
constexpr double sideways = 0.55;  // of l0: a wall particle's share of the face, to both sides

}  // namespace

double Contacts::reach(const Settings& settings) {
    // across the face a contact at `nearest` ends 0.6 l0 from the wall particle
    return std::max(settings.stabilisation, 0.82) * settings.spacing;
}

void Contacts::apply(const Settings& settings, Particles& particles, const NeighbourLists& lists,
                     const Interactions& interactions, float near_weight, double step, double reference_step,
                     double speed) {
    const std::size_t first = particles.first_fluid(), first_wall = particles.first_wall(),
                      walls = particles.walls;
    const double l0 = settings.spacing, push_step = std::max(step, reference_step);
    const double stabilised = settings.stabilisation * l0, touching = 0.5 * l0;
    const double near = reach(settings), near2 = near * near;
    const double far2 = (1.5 * 1.5 + sideways * sideways) * l0 * l0;  // a spacing from the face
    const double to_pressure = settings.pressure.density * l0 / step;
    change_u_.assign(particles.fluid, 0.0);
    change_w_.assign(particles.fluid, 0.0);
    wall_pressure_.assign(walls, 0.0);

    /// What particle f gets from its neighbours; `given(j, speed)`: from wall particle j, along its normal.
    const auto push = [&](std::size_t f, const auto& given) {
        const std::size_t row = walls + f, i = first + f;
        const double ui = particles.u[i], wi = particles.w[i];
        double du = 0, dw = 0;
        for (std::size_t k = lists.start[row]; k < lists.start[row + 1]; ++k) {
            const double dx = interactions.dx[k], dz = interactions.dz[k], r2 = dx * dx + dz * dz;
            const auto j = static_cast<std::size_t>(lists.neighbour[k]);
            const bool is_wall = j < first && j >= first_wall;
            if (r2 >= near2 && !(is_wall && r2 < far2)) continue;
            const double r = std::sqrt(r2), share = j >= first ? 0.5 : 1.0, u0 = du, w0 = dw;
            if (r < stabilised) {
                const double made_up =
                    share * std::min(stabilised - r, 0.1 * l0) * step / (push_step * push_step);
                du -= made_up * dx / r, dw -= made_up * dz / r;
            }
            if (r < touching) {
                const double approach = ((particles.u[j] - ui) * dx + (particles.w[j] - wi) * dz) / r;
                if (approach < 0) {
                    const double kick = share * (1 + restitution) * approach;
                    du += kick * dx / r, dw += kick * dz / r;
                }
            }
            if (!is_wall) continue;
            const double nx = particles.normal_x[j], nz = particles.normal_z[j];
            const double gap = -(dx * nx + dz * nz) - 0.5 * l0;  // from the face
            // farther behind it is water of another face
            const bool is_before = gap < l0 && (gap >= nearest * l0 || (r2 < near2 && gap > -0.5 * l0));
            if (is_before && std::abs(-dx * nz + dz * nx) < sideways * l0) {
                const double across = (ui + du - particles.u[j]) * nx + (wi + dw - particles.w[j]) * nz;
                const double wanted = gap < nearest * l0
                                          ? (nearest * l0 - gap) / push_step  // back within a reference step
                                          : -speed * (gap / l0 - nearest) / (1.0 - nearest);
                if (across < wanted) du += (wanted - across) * nx, dw += (wanted - across) * nz;
            }
            given(j, (du - u0) * nx + (dw - w0) * nz);
        }
        change_u_[f] = du, change_w_[f] = dw;
    };
    const auto has_wall = [&](std::size_t f) {  // walls stand first
        const std::size_t k = lists.start[walls + f];
        return k < lists.start[walls + f + 1] && static_cast<std::size_t>(lists.neighbour[k]) < first;
    };
    common::parallel_for(particles.fluid, serial_below, [&](std::size_t f) {
        if (interactions.largest_weight[walls + f] < near_weight || has_wall(f))
            return;  // most: nobody is near
        push(f, [](std::size_t, double) {});
    });
    // few: one after the other, so that what a wall particle gives is one sum
    for (std::size_t f = 0; f < particles.fluid; ++f)
        if (has_wall(f))
            push(f, [&](std::size_t j, double change) {
                wall_pressure_[j - first_wall] += to_pressure * change;
            });
    for (std::size_t f = 0; f < particles.fluid; ++f)
        particles.u[first + f] += change_u_[f], particles.w[first + f] += change_w_[f];
}

}  // namespace cmps
