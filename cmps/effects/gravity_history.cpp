#include "cmps/effects/gravity_history.hpp"

#include <algorithm>
#include <cmath>

namespace cmps {
namespace {

std::array<double, 2> sums_of_velocity(const Particles& particles) {
    double u = 0, w = 0;
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
        u += particles.u[i], w += particles.w[i];
    return {u, w};
}

}  // namespace

GravityHistory::GravityHistory(TimeTable table) : table_(std::move(table)) {
    const auto largest = [&](std::size_t column) {
        const auto [least, greatest] = table_.range(column);
        return std::max(std::abs(least), std::abs(greatest));
    };
    strongest_ = std::hypot(largest(1), largest(2));
}

double GravityHistory::longest_step(const NearField& field) const {
    return field.settings.time_step_factor * field.step_of_celerity(strongest_);
}

void GravityHistory::begin_step(NearField& field, double time, double step) {
    // means, so that a jerk within a step gives the water its whole impulse
    field.settings.gravity_x = table_.mean(1, time, time + step);
    field.settings.gravity_z = table_.mean(2, time, time + step);
    before_ = sums_of_velocity(field.particles);
}

/// Force times the way, which is that of the mean of the velocities before and after.
void GravityHistory::end_step(NearField& field, double, double step) {
    const Settings& settings = field.settings;
    const std::array<double, 2> after = sums_of_velocity(field.particles);
    const double mass = settings.pressure.density * settings.spacing * settings.spacing;
    work_.add(0.5 * step * mass *
              (settings.gravity_x * (before_[0] + after[0]) + settings.gravity_z * (before_[1] + after[1])));
}

}  // namespace cmps
