/// Blocks that rest and are not pushed are asleep: their contacts, forces and integration are skipped.
///
/// A sleeper does not move whatever acts on it, so it must sleep only as long as it would not move awake: all
/// is measured by the reserve that the block has left before it slides or tips (reserve.hpp). A block falls
/// asleep when no point of it has moved more than a tiny distance over a while, what acts on it is balanced,
/// and the load has changed over that while by less than half of what would wake it. It wakes when its load
/// has changed by a stated share, well below 1, of the reserve it fell asleep with: by the water at the next
/// look, by neighbours that still move and by wires in the very step. Awake it takes up the load, and may
/// sleep again with what is left: the nearer to its limit, the lighter the sleep. A block without a reserve
/// (no friction, no weight, afloat, on a point, hanging) never sleeps: nothing keeps it from following the
/// least push.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "dem/blocks.hpp"

namespace dem {

struct SleepRules {
    double rest_time = 0.1;           ///< s a block must rest before it sleeps
    double rest_displacement = 8e-8;  ///< m, farthest point, over rest_time
    double wake_load = 0.1;           ///< change of load that wakes, of the reserve
};

class Sleeping {
 public:
    Sleeping(const Blocks& blocks, const SleepRules& rules);

    /// Looks at all blocks at time t; blocks.force and blocks.torque must hold the present sums of all of
    /// them. `reserve`: of a block, N. Blocks that fall asleep lose their velocity; returns the kinetic
    /// energy so lost (J). `changed`: someone woke or slept.
    double look(Blocks& blocks, double t, const std::function<double(std::size_t)>& reserve, bool& changed);

    /// Whether the next look may wake this one if its load differs by `uncertainty` (N) from its present sum.
    bool may_wake(const Blocks& blocks, std::size_t block, double uncertainty) const;
    /// Whether this sleeper wakes when its sums are those of blocks and these changes.
    bool is_disturbed(const Blocks& blocks, std::size_t block, const Vector& force_change = Vector::Zero(),
                      const Vector& torque_change = Vector::Zero()) const {
        return load_change(blocks, block, force_change, torque_change) > wake_force_[block];
    }
    /// Wakes one block now.
    void wake(const Blocks& blocks, std::size_t block, double t);
    bool is_asleep(std::size_t block) const { return asleep_[block] != 0; }
    std::size_t count() const;
    /// Everybody up (blocks were moved by hand).
    void wake_all(const Blocks& blocks, double t);

    /// What the next look depends on, for a saved state.
    struct Memory {
        std::vector<std::uint8_t> asleep;
        std::vector<Vector> position, force, torque;
        std::vector<Quaternion> orientation;
        std::vector<double> since, wake_force;
    };
    Memory memory() const { return {asleep_, position_, force_, torque_, orientation_, since_, wake_force_}; }
    void restore(const Memory& memory);

 private:
    void drop_anchor(const Blocks& blocks, std::size_t block, double t);
    bool has_moved(const Blocks& blocks, std::size_t block) const;
    /// Since the block came to rest or fell asleep: of the force, and of the torque over the radius, N.
    double load_change(const Blocks& blocks, std::size_t block, const Vector& more_force,
                       const Vector& more_torque) const;
    SleepRules rules_;
    std::vector<std::uint8_t> asleep_;
    std::vector<Vector> position_, force_, torque_;  // when the block last came to rest or fell asleep
    std::vector<Quaternion> orientation_;
    std::vector<double> since_;
    std::vector<double> wake_force_;  // change of load that wakes a sleeper, N
};

}  // namespace dem
