#include "dem/effects/sleeping.hpp"

#include <algorithm>

namespace dem {

Sleeping::Sleeping(const Blocks& blocks, const SleepRules& rules, const std::vector<double>& weights)
    : rules_(rules), weight_(weights) {
    wake_all(blocks, 0);
}

void Sleeping::wake_all(const Blocks& blocks, double t) {
    asleep_.assign(blocks.size(), 0);
    position_ = blocks.position;
    orientation_ = blocks.orientation;
    force_ = blocks.force;
    torque_ = blocks.torque;
    since_.assign(blocks.size(), t);
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

double Sleeping::load_change(const Blocks& blocks, std::size_t block) const {
    return (blocks.force[block] - force_[block]).norm() +
           (blocks.torque[block] - torque_[block]).norm() / blocks.shape_of(block).radius;
}

bool Sleeping::may_wake(const Blocks& blocks, std::size_t block, double uncertainty) const {
    constexpr double rounding = 1e-9;  // far above that of the sums, far below anything that matters
    return is_asleep(block) &&
           load_change(blocks, block) + uncertainty > (1 - rounding) * rules_.wake_load * weight_[block];
}

double Sleeping::look(Blocks& blocks, double t, bool& changed) {
    double energy_lost = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (blocks.is_fixed[i]) continue;
        if (asleep_[i]) {
            if (load_changed(blocks, i, rules_.wake_load)) {
                wake(blocks, i, t);
                changed = true;
            }
            continue;
        }
        const double turned = (orientation_[i].conjugate() * blocks.orientation[i]).vec().norm();
        const double moved =
            (blocks.position[i] - position_[i]).norm() + 2 * blocks.shape_of(i).radius * turned;
        // Half the waking load: a block that has just fallen asleep is not woken by what it slept through.
        if (moved > rules_.rest_displacement || load_changed(blocks, i, 0.5 * rules_.wake_load)) {
            drop_anchor(blocks, i, t);
        } else if (t - since_[i] >= rules_.rest_time) {
            energy_lost += blocks.kinetic_energy(i);
            blocks.place(i, blocks.position[i], blocks.orientation[i], Vector::Zero(), Vector::Zero());
            drop_anchor(blocks, i, t);
            asleep_[i] = 1;
            changed = true;
        }
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
}

}  // namespace dem
