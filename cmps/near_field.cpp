#include "cmps/near_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/errors.hpp"
#include "common/parallel.hpp"
#include "common/run_record.hpp"

namespace cmps {
namespace {

constexpr double skin_ratio = 0.35;  // of l0: a step of the Courant number 0.25 leaves the lists alone

std::variant<RationalKernel, WendlandKernel> make_kernel(const Settings& settings) {
    const double radius = settings.kernel_radius_ratio * settings.spacing;
    if (settings.kernel == KernelKind::rational) return RationalKernel{radius};
    return WendlandKernel{radius};
}

LatticeConstants constants_of(const Settings& settings) {
    return std::visit([&](const auto& kernel) { return lattice_constants(kernel, settings.spacing); },
                      make_kernel(settings));
}

}  // namespace

NearField::NearField(const Settings& chosen, Particles initial)
    : settings(chosen),
      lattice(constants_of(chosen)),
      particles(std::move(initial)),
      search(chosen.kernel_radius_ratio * chosen.spacing, skin_ratio * chosen.spacing),
      equation(chosen.pressure, lattice),
      kernel_(make_kernel(chosen)),
      solver_(chosen.tolerance, chosen.most_iterations),
      gradient_(chosen.gradient, lattice.number_density) {
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
        largest_speed_ = std::max(largest_speed_, std::hypot(particles.u[i], particles.w[i]));
    first_speed_ = largest_speed_;
}

double NearField::step_of_celerity(double gravity) const {
    const double l0 = settings.spacing;
    if (gravity == 0 && first_speed_ > 0) return 0.4 * l0 / first_speed_;
    const double g = gravity > 0 ? gravity : 9.81;
    return 0.4 * l0 / std::sqrt(g * std::max(settings.depth, l0));
}

double NearField::largest_step() const {
    const double l0 = settings.spacing;
    double step = step_of_celerity(std::hypot(settings.gravity_x, settings.gravity_z));
    if (largest_speed_ > 0) step = std::min(step, settings.courant * l0 / largest_speed_);
    if (largest_acceleration_ > 0) step = std::min(step, 0.25 * std::sqrt(l0 / largest_acceleration_));
    step *= settings.time_step_factor;
    for (const auto& effect : effects) step = std::min(step, effect->longest_step(*this));
    return step;
}

void NearField::advance(double time, double step) {
    old_u_ = particles.u;
    old_w_ = particles.w;
    if (path_average) path_average->begin_step(particles);
    const bool is_midpoint = settings.time_stepping == TimeStepping::midpoint;
    const auto run_effects = [&](auto member, double at) {
        for (const auto& effect : effects) {
            const common::PhaseTimer timer(effect->seconds);
            ((*effect).*member)(*this, at, step);
        }
    };
    const auto fall = [&] {
        for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
            particles.u[i] += step * settings.gravity_x, particles.w[i] += step * settings.gravity_z;
    };

    run_effects(&Effect::begin_step, time);
    if (is_midpoint) {
        drift(0.5 * step);
        fall();
    } else {
        fall();
        drift(step);
    }
    update_geometry();
    run_effects(&Effect::accelerate, time);
    solve_pressure(step);
    apply_gradient(step);
    find_face_pressure();
    filter_velocity(step);
    if (is_midpoint) drift(0.5 * step);
    shift(share_of_step(step), true);
    if (path_average) path_average->end_step(particles, step);
    run_effects(&Effect::end_step, time + step);
    last_step_ = step;
    check(time, step);
    ++counts.steps;
}

void NearField::drift(double step) {
    const common::PhaseTimer timer(seconds.motion);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        particles.x[i] += step * particles.u[i];
        particles.z[i] += step * particles.w[i];
    }
}

void NearField::update_geometry() {
    {
        const common::PhaseTimer timer(seconds.neighbours);
        companions_ = {&old_u_, &old_w_};
        if (path_average) companions_.insert(companions_.end(), {&path_average->old_x, &path_average->old_z});
        if (search.update(particles, companions_)) ++counts.list_builds;
    }
    const common::PhaseTimer timer(seconds.geometry);
    std::visit(
        [&](const auto& kernel) {
            compute_interactions(kernel, particles, search.lists(), equation.extras(), interactions);
        },
        kernel_);
    find_free_surface(particles, search.lists(), interactions, lattice.number_density, place);
}

void NearField::solve_pressure(double step) {
    {
        const common::PhaseTimer timer(seconds.assembly);
        equation.assemble(particles, search.lists(), interactions, place, step, step / share_of_step(step));
    }
    const common::PhaseTimer timer(seconds.solve);
    const std::size_t first = particles.first_wall(), unknowns = equation.row_of.size();
    unknown_pressure_.resize(unknowns);
    for (std::size_t a = 0; a < unknowns; ++a)
        unknown_pressure_[a] = particles.pressure[first + equation.row_of[a]];
    SolveReport report;
    if (unknowns < settings.multigrid_from) {
        report = solver_.solve(equation.matrix, equation.right_hand_side, unknown_pressure_);
    } else {
        unknown_x_.resize(unknowns), unknown_z_.resize(unknowns);
        for (std::size_t a = 0; a < unknowns; ++a) {
            unknown_x_[a] = particles.x[first + equation.row_of[a]];
            unknown_z_[a] = particles.z[first + equation.row_of[a]];
        }
        report =
            solver_.solve(equation.matrix, equation.right_hand_side, unknown_pressure_, unknown_x_,
                          unknown_z_, std::max(2.5, 0.5 * settings.kernel_radius_ratio) * settings.spacing);
    }
    if (equation.is_closed) {  // the lowest pressure in a full box is zero
        const double least = *std::min_element(unknown_pressure_.begin(), unknown_pressure_.end());
        for (double& pressure : unknown_pressure_) pressure -= least;
    }
    note_pressure_change(unknown_pressure_);
    counts.iterations += report.iterations;
    if (!report.is_converged) ++counts.unconverged;
    std::fill(particles.pressure.begin(), particles.pressure.end(), 0.0);
    const double lowest = settings.negative_pressure ? -std::numeric_limits<double>::infinity() : 0.0;
    for (std::size_t a = 0; a < unknowns; ++a)
        particles.pressure[first + equation.row_of[a]] = std::max(unknown_pressure_[a], lowest);
}

/// How much the pressure changes in a step, against its size, or what the water's speed could make of it:
/// little, where steps resolve the flow.
void NearField::note_pressure_change(const std::vector<double>& solved) {
    constexpr std::size_t first_steps = 3;  // released water takes its pressure at once
    if (counts.steps < first_steps) return;
    // without a free surface the pressure is known up to a constant
    if (equation.is_closed) ++counts.closed;
    if (equation.is_closed) return;
    const std::size_t first = particles.first_wall();
    const double stagnation = 0.5 * settings.pressure.density * largest_speed_ * largest_speed_;
    for (std::size_t a = 0; a < solved.size(); ++a) {
        const double pressure = std::max(solved[a], 0.0);
        pressure_change_ += std::abs(pressure - particles.pressure[first + equation.row_of[a]]);
        pressure_sum_ += pressure;
    }
    stagnation_sum_ += stagnation * static_cast<double>(solved.size());
}

void NearField::apply_gradient(double step) {
    const common::PhaseTimer timer(seconds.gradient);
    gradient_.evaluate(particles, search.lists(), interactions, gradient_x_, gradient_z_);
    const std::size_t first = particles.first_fluid();
    const double factor = step / settings.pressure.density;
    const double back = settings.time_stepping == TimeStepping::predicted ? step : 0.0;  // r = r* + dt u'
    for (std::size_t f = 0; f < particles.fluid; ++f) {
        const double du = -factor * gradient_x_[f], dw = -factor * gradient_z_[f];
        particles.u[first + f] += du, particles.w[first + f] += dw;
        particles.x[first + f] += back * du, particles.z[first + f] += back * dw;
    }
    double strongest = 0;  // of gravity, pressure and effects: contacts are instantaneous and limit no step
    for (std::size_t i = first; i < particles.size(); ++i) {
        const double du = particles.u[i] - old_u_[i], dw = particles.w[i] - old_w_[i];
        strongest = std::max(strongest, (du * du + dw * dw) / (step * step));
    }
    push_apart(step);
    double fastest = 0, total = 0;
    for (std::size_t i = first; i < particles.size(); ++i) {
        total += particles.u[i] * particles.u[i] + particles.w[i] * particles.w[i];
        // a lone drop in flight meets nobody within a step and limits none
        if (place[i - particles.first_wall()] != Place::dry)
            fastest = std::max(fastest, particles.u[i] * particles.u[i] + particles.w[i] * particles.w[i]);
    }
    // a maximum passes over what is no number; the sum does not
    largest_speed_ = std::isfinite(total) ? std::sqrt(fastest) : total;
    largest_acceleration_ = std::sqrt(strongest);
}

/// The water's own pressure carried on to the face with the gradient that has just moved it (over water, not
/// over what is empty between the nearest water and the face), and what the wall has given in contact: the
/// force that stops the water and the pressure that is reported are then the same. The wall particles'
/// unknowns are not: while little water stands before them, they are larger than what the water feels. For
/// the same reason a particle at the surface has the pressure that its own gradient makes over the half
/// spacing from the surface, where that is less.
void NearField::find_face_pressure() {
    face_pressure = contacts_.wall_pressure();
    const NeighbourLists& lists = search.lists();
    const std::size_t first_fluid = particles.first_fluid();
    const double half = 0.5 * settings.spacing,
                 kernel_reach = settings.kernel_radius_ratio * settings.spacing;
    const auto own_pressure = [&](std::size_t f) {
        const double pressure = particles.pressure[first_fluid + f];
        const std::size_t row = particles.walls + f;
        if (place[row] < Place::surface) return pressure;
        const double fx = interactions.asymmetry_x[row], fz = interactions.asymmetry_z[row];  // inwards
        const double size = std::hypot(fx, fz);
        const double inwards = size > 0 ? (gradient_x_[f] * fx + gradient_z_[f] * fz) / size : 0.0;
        return std::min(pressure, half * std::max(0.0, inwards));
    };
    // between a face and the water that comes at it there is nothing yet, and no pressure to gain
    const auto empty_before = [&](std::size_t row) {
        const std::size_t j = particles.first_wall() + row;
        const double nx = particles.normal_x[j], nz = particles.normal_z[j];
        double nearest = kernel_reach;
        for (std::size_t k = lists.start[row + 1]; k-- > lists.start[row];) {
            if (static_cast<std::size_t>(lists.neighbour[k]) < first_fluid) break;
            const double dx = interactions.dx[k], dz = interactions.dz[k];
            if (std::abs(dx * nz - dz * nx) < settings.spacing)
                nearest = std::min(nearest, dx * nx + dz * nz);
        }
        return nearest < kernel_reach ? std::max(0.0, nearest - settings.spacing) : 0.0;
    };
    for (std::size_t row = 0; row < particles.walls; ++row) {
        if (place[row] == Place::dry) continue;
        const std::size_t j = particles.first_wall() + row;
        const double face_x = half * particles.normal_x[j], face_z = half * particles.normal_z[j];
        const double empty = empty_before(row);
        const double empty_x = empty * particles.normal_x[j], empty_z = empty * particles.normal_z[j];
        double sum = 0, weights = 0;
        for (std::size_t k = lists.start[row + 1]; k-- > lists.start[row];) {  // the fluid stands last
            const auto i = static_cast<std::size_t>(lists.neighbour[k]);
            if (i < first_fluid) break;
            const std::size_t f = i - first_fluid;
            const auto weight = static_cast<double>(interactions.weight[k]);
            sum += weight * (own_pressure(f) +
                             gradient_x_[f] * (face_x + empty_x - static_cast<double>(interactions.dx[k])) +
                             gradient_z_[f] * (face_z + empty_z - static_cast<double>(interactions.dz[k])));
            weights += weight;
        }
        if (weights > 0) face_pressure[row] += std::max(0.0, sum / weights);
    }
}

/// Contacts: for pairs that the pressure has left too near each other, and for water that comes at a wall.
void NearField::push_apart(double step) {
    const double l0 = settings.spacing, reach = Contacts::reach(settings);
    const float near_weight = std::visit(
        [&](const auto& kernel) { return kernel.weight(static_cast<float>(1.001 * reach * reach)); },
        kernel_);
    const double celerity =
        std::sqrt(std::hypot(settings.gravity_x, settings.gravity_z) * std::max(settings.depth, l0));
    contacts_.apply(settings, particles, search.lists(), interactions, near_weight, step, 0.4 * l0 / celerity,
                    std::max(celerity, largest_speed_));
}

/// Of what shifting and the density term do in one step of the length that speed and celerity ask for.
double NearField::share_of_step(double step) const {
    const double g = std::hypot(settings.gravity_x, settings.gravity_z), l0 = settings.spacing;
    const double celerity = std::sqrt(g * std::max(settings.depth, l0));
    return std::min(1.0, step * std::max(celerity / 0.4, largest_speed_ / 0.2) / l0);
}

void NearField::filter_velocity(double step) {
    if (settings.velocity_filter == 0 && settings.shifting == 0) return;
    const common::PhaseTimer timer(seconds.motion);
    const NeighbourLists& lists = search.lists();
    filter_.find_gradients(particles, lists, interactions, lattice.number_density);
    if (settings.velocity_filter == 0) return;
    const double g = std::hypot(settings.gravity_x, settings.gravity_z);
    const double share = settings.velocity_filter * step * std::sqrt(g * settings.depth) / settings.spacing;
    filter_.apply(particles, lists, interactions, lattice.number_density, std::min(share, 0.25));
}

/// Particle shifting: dr = -0.3 (l0^2/n0) sum w r_ij / r^2, at most 0.05 l0; none at the surface, along it
/// next to it. A shifted particle takes the velocity of its new place, u += grad u . dr: left out, a wave
/// loses half as much height again. `carries_velocity`: gradients are current.
/// `share` of the coefficient: less on steps shorter than those of speed and celerity ask for.
void NearField::shift(double share, bool carries_velocity) {
    if (settings.shifting == 0) return;
    const common::PhaseTimer timer(seconds.motion);
    const std::size_t first = particles.first_fluid(), walls = particles.walls;
    const double l0 = settings.spacing, factor = share * settings.shifting * l0 * l0 / lattice.number_density;
    const double limit = share * 0.05 * l0;
    for (std::size_t f = 0; f < particles.fluid; ++f) {
        const std::size_t row = walls + f;
        if (place[row] >= Place::surface) continue;
        double sx = -factor * interactions.crowding_x[row], sz = -factor * interactions.crowding_z[row];
        if (place[row] == Place::near_surface) {
            const double fx = interactions.asymmetry_x[row], fz = interactions.asymmetry_z[row];
            const double f2 = fx * fx + fz * fz;
            if (f2 > 0) {
                const double across = (sx * fx + sz * fz) / f2;
                sx -= across * fx, sz -= across * fz;
            }
        }
        const double size = std::sqrt(sx * sx + sz * sz), scale = size > limit ? limit / size : 1.0;
        sx *= scale, sz *= scale;
        particles.x[first + f] += sx;
        particles.z[first + f] += sz;
        if (!carries_velocity) continue;
        particles.u[first + f] += filter_.du_dx[f] * sx + filter_.du_dz[f] * sz;
        particles.w[first + f] += filter_.dw_dx[f] * sx + filter_.dw_dz[f] * sz;
    }
}

void NearField::settle(int sweeps, double surface_level) {
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        old_u_ = particles.u, old_w_ = particles.w;
        if (path_average) path_average->begin_step(particles);
        update_geometry();
        shift(1.0, false);
    }
    const std::size_t first = particles.first_wall();
    const auto still_water = [&](double z) {
        return std::max(0.0, -settings.gravity_z * settings.pressure.density * (surface_level - z));
    };
    face_pressure.assign(particles.walls, 0.0);
    for (std::size_t i = first; i < particles.size(); ++i) {
        if (place[i - first] == Place::dry) continue;
        particles.pressure[i] = still_water(particles.z[i]);
        if (i < particles.first_fluid())
            face_pressure[i - first] =
                still_water(particles.z[i] + 0.5 * settings.spacing * particles.normal_z[i]);
    }
}

void NearField::check(double time, double step) const {
    const double g = std::hypot(settings.gravity_x, settings.gravity_z);
    // a fall over 25 times the depth, or the tank's extent, and five times the water's first speed
    const double height = std::max({settings.depth, settings.fall, settings.spacing});
    const double limit = 5.0 * (std::sqrt(2.0 * std::max(g, 1.0) * height) + first_speed_) + 5.0;
    if (largest_speed_ < limit) return;
    const auto speed = [&](std::size_t i) { return std::hypot(particles.u[i], particles.w[i]); };
    std::size_t worst = particles.first_fluid();  // the first that is no number, or the fastest
    for (std::size_t i = worst; i < particles.size() && !std::isnan(speed(worst)); ++i)
        if (!(speed(i) <= speed(worst))) worst = i;
    throw common::RunError(
        fmt::format("unstable at t = {:.4f} s (step {} of {:.2e} s): particle {} at ({:.3f}, {:.3f}) m moves "
                    "at {:.3g} m/s, limit {:.3g}",
                    time + step, counts.steps, step, particles.identity[worst], particles.x[worst],
                    particles.z[worst], speed(worst), limit));
}

}  // namespace cmps
