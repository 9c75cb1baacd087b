/// Blocks that rest and are not pushed are asleep: their contacts, forces and integration are skipped.
///
/// A block falls asleep when no point of it has moved more than a small distance over a while, and the load
/// on it has hardly changed. It wakes when the sum of all that acts on it (water, wires, neighbours that
/// still move) has changed by more than a stated share of its weight, or at once where one contact or wire of
/// a block that moves has, since a hit is over before the next look: displacement and load are judged, never
/// speed alone.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/blocks.hpp"

namespace dem {

struct SleepRules {
    double rest_time = 0.1;           ///< s a block must rest before it sleeps
    double rest_displacement = 8e-7;  ///< m, farthest point, over rest_time
    double wake_load = 0.05;          ///< change of load that wakes, in submerged weights
};

class Sleeping {
 public:
    Sleeping(const Blocks& blocks, const SleepRules& rules, const std::vector<double>& weights);

    /// Looks at all blocks at time t; blocks.force and blocks.torque must hold the present sums of all of
    /// them. Blocks that fall asleep lose their velocity; returns the kinetic energy so lost (J). `changed`:
    /// someone woke or slept.
    double look(Blocks& blocks, double t, bool& changed);

    /// Whether the next look may wake this one if its load differs by `uncertainty` (N) from its present sum.
    bool may_wake(const Blocks& blocks, std::size_t block, double uncertainty) const;
    /// Wakes one block now.
    void wake(const Blocks& blocks, std::size_t block, double t);
    /// Change of a force that wakes it, N.
    double wake_force(std::size_t block) const { return rules_.wake_load * weight_[block]; }
    bool is_asleep(std::size_t block) const { return asleep_[block] != 0; }
    std::size_t count() const;
    /// Everybody up (blocks were moved by hand).
    void wake_all(const Blocks& blocks, double t);

    /// What the next look depends on, for a saved state.
    struct Memory {
        std::vector<std::uint8_t> asleep;
        std::vector<Vector> position, force, torque;
        std::vector<Quaternion> orientation;
        std::vector<double> since;
    };
    Memory memory() const { return {asleep_, position_, force_, torque_, orientation_, since_}; }
    void restore(const Memory& memory);

 private:
    void drop_anchor(const Blocks& blocks, std::size_t block, double t);
    bool load_changed(const Blocks& blocks, std::size_t block, double share) const {
        return load_change(blocks, block) > share * weight_[block];
    }
    double load_change(const Blocks& blocks, std::size_t block) const;
    SleepRules rules_;
    std::vector<double> weight_;  // submerged, N
    std::vector<std::uint8_t> asleep_;
    std::vector<Vector> position_, force_, torque_;  // when the block last came to rest or fell asleep
    std::vector<Quaternion> orientation_;
    std::vector<double> since_;
};

}  // namespace dem
