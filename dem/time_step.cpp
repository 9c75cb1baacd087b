/// The largest stable time step at the present contacts.
///
/// For each block the springs and dashpots of its contacts and wires make a 6 x 6 stiffness and, with the
/// slope of the water's drag, a 6 x 6 damping matrix. With the largest eigenvalues k and c of either over the
/// mass matrix (doubled where the partner moves as well, the bound of Gershgorin), velocity Verlet with
/// velocities half a step back is stable while k dt^2 + 2 c dt < 4.
///
/// Wires ask for more than stability: nothing damps them, and one that comes under tension somewhere within a
/// step and slackens somewhere within another gives back its energy to within a share of k dt^2 / 4 only, k
/// of the wires alone (s of a step into the tension, the energy kept by Verlet changes by k dt^2 s (1 - s)).
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "common/errors.hpp"
#include "dem/step.hpp"

namespace dem {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// Largest share of their energy that wires may gain or lose each time they pull: the bound of the run's
/// energy closure.
constexpr double wire_energy_error = 0.1;

double largest_eigenvalue(const Matrix6& matrix) {
    return Eigen::SelfAdjointEigenSolver<Matrix6>(matrix, Eigen::EigenvaluesOnly).eigenvalues()[5];
}

/// The positive root of k dt^2 + 2 c dt = 4, written so that k = 0 is no special case.
double limit_of(const Matrix6& stiffness, const Matrix6& damping) {
    const double k = largest_eigenvalue(stiffness), c = largest_eigenvalue(damping);
    return 4 / (c + std::sqrt(c * c + 4 * k));
}

/// Adds value * J^T P J, with J the 3 x 6 map from the block's (scaled) velocities to the contact point and P
/// = n n^T scaled by `normal` plus (1 - n n^T) scaled by `tangential`.
void add_spring(Matrix6& matrix, const Vector& arm, const Vector& direction, double normal, double tangential,
                double inverse_root_mass, const Rotation& inverse_root_inertia) {
    Eigen::Matrix<double, 3, 6> map;
    map.leftCols<3>() = inverse_root_mass * Rotation::Identity();
    Rotation cross;
    cross << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0;  // omega x arm
    map.rightCols<3>() = cross * inverse_root_inertia;
    const Rotation spring =
        tangential * Rotation::Identity() + (normal - tangential) * direction * direction.transpose();
    matrix += map.transpose() * spring * map;
}

/// The slope of the water's force and torque over the mass.
Matrix6 drag_over_mass(const FluidLoad& load, double inverse_root_mass,
                       const Rotation& inverse_root_inertia) {
    Matrix6 drag;
    const Rotation coupling = inverse_root_inertia * load.coupling * inverse_root_mass;
    drag << load.drag_slope * inverse_root_mass * inverse_root_mass, coupling.transpose(), coupling,
        inverse_root_inertia * load.spin_slope * inverse_root_inertia;
    return drag;
}

}  // namespace

/// Throws RunError where the drag of the water alone is too stiff for steps of dt: it would go to infinity
/// within a few of them.
void Simulation::require_drag_within(double dt) const {
    for (const auto i : awake_) {
        const FluidLoad& load = water_->load(i);
        // No eigenvalue is larger than the trace.
        const double mass = blocks.mass(i);
        const double bound =
            load.drag_slope.trace() / mass + load.spin_slope.trace() / blocks.inertia(i).minCoeff();
        if (!(dt * bound > 2)) continue;
        const Rotation& turn = blocks.rotation[i];
        const Rotation inverse_root_inertia =
            turn * blocks.inertia(i).cwiseSqrt().cwiseInverse().asDiagonal() * turn.transpose();
        const double largest =
            largest_eigenvalue(drag_over_mass(load, 1 / std::sqrt(mass), inverse_root_inertia));
        if (dt * largest > 2)
            throw common::RunError(
                fmt::format("t = {:.5f} s: the time step of {:.2g} s is past the limit of {:.2g} s that the "
                            "water's drag sets "
                            "on block {}; shorten dem.time_step",
                            time_, dt, 2 / largest, i + 1));
    }
}

StepLimit Simulation::step_limit(bool sleepers_too) const {
    const std::vector<std::uint32_t>& judged = sleepers_too ? movable_ : awake_;
    std::vector<std::vector<std::uint32_t>> wires_of(judged.empty() ? 0 : blocks.size());
    for (std::uint32_t w = 0; !judged.empty() && w < wires.size(); ++w)
        if (wires.is_intact[w])
            for (const auto i : {wires.block_a[w], wires.block_b[w]}) wires_of[i].push_back(w);
    StepLimit least;
    for (const auto i : judged) {
        const double inverse_root_mass = 1 / std::sqrt(blocks.mass(i));
        const Rotation& turn = blocks.rotation[i];
        const Rotation inverse_root_inertia =
            turn * blocks.inertia(i).cwiseSqrt().cwiseInverse().asDiagonal() * turn.transpose();
        Matrix6 stiffness = Matrix6::Zero(), damping = Matrix6::Zero(), of_wires = Matrix6::Zero(),
                drag = Matrix6::Zero();
        bool any = false;
        for (const auto entry : pair_list_.pairs_of(i)) {
            const Pair& pair = pair_list_.pairs()[entry >> 1];
            if (pair.contacts == 0) continue;
            any = true;
            const bool is_partner = (entry & 1) != 0;
            const bool both_move = pair_list_.is_block(pair.partner) && !blocks.is_fixed[pair.partner] &&
                                   !blocks.is_fixed[pair.block];
            const double share = both_move ? 2 : 1;
            double inverse = blocks.is_fixed[pair.block] ? 0 : 1 / blocks.mass(pair.block);
            if (pair_list_.is_block(pair.partner) && !blocks.is_fixed[pair.partner])
                inverse += 1 / blocks.mass(pair.partner);
            for (const auto& contact : pair_list_.contacts(pair)) {
                const Vector arm = blocks.arm(i, is_partner ? contact.b : contact.a);
                // The direction of the contact hardly matters to the bound: arms and spheres suffice.
                Vector direction = Vector::UnitZ();
                if (pair_list_.is_block(pair.partner)) {
                    Vector between = blocks.sphere_centre(pair.partner, contact.b) -
                                     blocks.sphere_centre(pair.block, contact.a);
                    between.y() += pair.image * surroundings_.period;
                    direction = between.normalized();
                } else if (pair_list_.is_fixed_spheres(pair.partner)) {
                    const Vector centre = blocks.sphere_centre(pair.block, contact.a);
                    direction =
                        (surroundings_.fixed_spheres.centre_near(contact.b, centre) - centre).normalized();
                } else {
                    direction = pair_list_.plane(pair.partner).normal;
                }
                const double k = share * contact.stiffness, ratio = contact_model_->tangential_ratio();
                const double c = share * contact_model_->damping_coefficient(1 / inverse, pair.contacts,
                                                                             contact.stiffness);
                add_spring(stiffness, arm, direction, k, ratio * k, inverse_root_mass, inverse_root_inertia);
                add_spring(damping, arm, direction, c, std::sqrt(ratio) * c, inverse_root_mass,
                           inverse_root_inertia);
            }
        }
        for (const auto w : wires_of[i]) {
            any = true;
            const Vector direction = wires.between_ends(blocks, w).normalized();
            const Vector arm = blocks.arm(i, wires.block_a[w] == i ? wires.sphere_a[w] : wires.sphere_b[w]);
            add_spring(of_wires, arm, direction, 2 * wires.stiffness[w], 0, inverse_root_mass,
                       inverse_root_inertia);
        }
        if (water_ != nullptr && water_->load(i).wet > 0) {
            any = true;
            drag = drag_over_mass(water_->load(i), inverse_root_mass, inverse_root_inertia);
        }
        if (!any) continue;
        const double wired = std::sqrt(4 * wire_energy_error / largest_eigenvalue(of_wires));
        const double limit = std::min(wired, limit_of(stiffness + of_wires, damping + drag));
        if (!(limit < least.time_step)) continue;
        // What would set the shortest step if it were alone.
        const Matrix6 none = Matrix6::Zero();
        const double contacts = limit_of(stiffness, damping), dragged = limit_of(none, drag);
        least = {limit, dragged < std::min(contacts, wired) ? "the water's drag sets"
                        : wired < contacts                  ? "the wires set"
                                                            : "the contacts set"};
    }
    return least;
}

}  // namespace dem
