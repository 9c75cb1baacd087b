#include "dem/effects/sleeping.hpp"

#include <algorithm>

namespace dem {

Sleeping::Sleeping(const Blocks& blocks, const SleepRules& rules) : rules_(rules) {
    wake_all(blocks, 0);
}

void Sleeping::wake_all(const Blocks& blocks, double t) {
    asleep_.assign(blocks.size(), 0);
    position_ = blocks.position;
    orientation_ = blocks.orientation;
    force_ = blocks.force;
    torque_ = blocks.torque;
    since_.assign(blocks.size(), t);
    wake_force_.assign(blocks.size(), 0);
}

void Sleeping::drop_anchor(const Blocks& blocks, std::size_t block, double t) {
    position_[block] = blocks.position[block];
    orientation_[block] = blocks.orientation[block];
    force_[block] = blocks.force[block];
    torque_[block] = blocks.torque[block];
    since_[block] = t;
}

void Sleeping::wake(const Blocks& blocks, std::size_t block, double t) {
    asleep_[block] = 0;
    drop_anchor(blocks, block, t);
}

double Sleeping::load_change(const Blocks& blocks, std::size_t block, const Vector& more_force,
                             const Vector& more_torque) const {
    return (blocks.force[block] + more_force - force_[block]).norm() +
           (blocks.torque[block] + more_torque - torque_[block]).norm() / blocks.shape_of(block).radius;
}

bool Sleeping::has_moved(const Blocks& blocks, std::size_t block) const {
    const double turned = (orientation_[block].conjugate() * blocks.orientation[block]).vec().norm();
    return (blocks.position[block] - position_[block]).norm() + 2 * blocks.shape_of(block).radius * turned >
           rules_.rest_displacement;
}

bool Sleeping::may_wake(const Blocks& blocks, std::size_t block, double uncertainty) const {
    constexpr double rounding = 1e-9;  // far above that of the sums, far below anything that matters
    return is_asleep(block) && load_change(blocks, block, Vector::Zero(), Vector::Zero()) + uncertainty >
                                   (1 - rounding) * wake_force_[block];
}

double Sleeping::look(Blocks& blocks, double t, const std::function<double(std::size_t)>& reserve,
                      bool& changed) {
    double energy_lost = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (blocks.is_fixed[i]) continue;
        if (asleep_[i]) {
            if (is_disturbed(blocks, i)) {
                wake(blocks, i, t);
                changed = true;
            }
            continue;
        }
        if (has_moved(blocks, i)) {
            drop_anchor(blocks, i, t);
            continue;
        }
        if (t - since_[i] < rules_.rest_time) continue;
        wake_force_[i] = rules_.wake_load * reserve(i);
        // Half the waking load: a block that has just fallen asleep is not woken by what it slept through.
        // And what is left over is about what the water changes by from one look to the next, no
        // acceleration.
        constexpr double quiet = 0.5, balanced = 0.05;
        const double left_over = blocks.force[i].norm() + blocks.torque[i].norm() / blocks.shape_of(i).radius;
        if (wake_force_[i] > 0 && left_over <= balanced * wake_force_[i] &&
            load_change(blocks, i, Vector::Zero(), Vector::Zero()) <= quiet * wake_force_[i]) {
            energy_lost += blocks.kinetic_energy(i);
            blocks.place(i, blocks.position[i], blocks.orientation[i], Vector::Zero(), Vector::Zero());
            asleep_[i] = 1;
            changed = true;
        }
        drop_anchor(blocks, i, t);
    }
    return energy_lost;
}

std::size_t Sleeping::count() const {
    return static_cast<std::size_t>(std::count(asleep_.begin(), asleep_.end(), 1));
}

void Sleeping::restore(const Memory& memory) {
    asleep_ = memory.asleep;
    position_ = memory.position;
    force_ = memory.force;
    torque_ = memory.torque;
    orientation_ = memory.orientation;
    since_ = memory.since;
    wake_force_ = memory.wake_force;
}

}  // namespace dem
