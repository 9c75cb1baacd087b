/// The time step of the blocks, and the run's own books: energy, overlaps, who is awake.
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "dem/blocks.hpp"
#include "dem/contacts.hpp"
#include "dem/effects/sleeping.hpp"
#include "dem/loads.hpp"
#include "dem/pair_list.hpp"

namespace dem {

/// How the run steps.
struct StepRules {
    double time_step = 1e-4;                ///< largest, s; steps are equal between two outputs
    double flow_interval = 2e-3;            ///< between samples of the water and looks for sleepers, s
    double skin = 0.0012;                   ///< largest of the sphere pairs, m
    double overlap_noted = 4e-4;            ///< deeper contacts are counted, m
    double overlap_limit = 4e-3;            ///< deeper contacts stop the run, m
    bool cross_still = true;                ///< while all are asleep, go from look to look without steps
    double element_overlap_allowed = 0.25;  ///< at the start, in element diameters
};

/// The bound on stable steps errs by some percent: a step is past it from this many times it on.
constexpr double time_step_margin = 1.2;

/// Largest stable step, s.
struct StepLimit {
    double time_step = std::numeric_limits<double>::infinity();
    const char* set_by = "nothing sets";  ///< subject and verb, for a message
};

/// Energies of the whole, J. The sum `balance` stays at its first value but for errors of the time step.
struct EnergyBudget {
    double kinetic = 0, potential = 0, contacts = 0, wires = 0;  ///< stored
    double dissipated = 0;                        ///< in contacts, broken wires and by falling asleep
    double water_work = 0, gross_water_work = 0;  ///< put in by the water (buoyancy included)
    double largest_kinetic = 0;                   ///< at any look since the start

    double balance() const { return kinetic + potential + contacts + wires + dissipated - water_work; }
};

/// All that moves and all that moves it.
class Simulation {
 public:
    Simulation(Blocks blocks, Surroundings surroundings, std::unique_ptr<ContactModel> contact_model,
               Vector gravity, StepRules rules);
    Simulation(const Simulation&) = delete;
    Simulation& operator=(const Simulation&) = delete;

    /// Adds the water; without it the blocks are dry.
    void add_water(FluidProperties properties, std::variant<UniformWater, FlowGrid> motion);
    /// Mounts wires (replaces those there); they hang in `wires`.
    void mount_wires(Wires mounted);
    void add_sleeping(const SleepRules& rules);

    /// Forces at the present poses, before the first step. Contact histories stay as they are.
    void start(double t);
    /// Goes on to time `target` in equal steps. Throws common::RunError when overlaps or values go out of
    /// bounds.
    void advance(double target);

    double time() const { return time_; }
    EnergyBudget energy() const;
    std::size_t asleep_count() const { return sleeping_ ? sleeping_->count() : 0; }
    std::uint64_t steps() const { return steps_; }
    std::uint64_t awake_block_steps() const { return awake_block_steps_; }
    double largest_overlap() const { return largest_overlap_; }
    std::uint64_t deep_contact_steps() const { return deep_contact_steps_; }
    FluidLoads* water() { return water_; }
    const FluidLoads* water() const { return water_; }
    const StepRules& rules() const { return rules_; }
    /// Largest stable step at the present contacts and wires of the blocks that are awake (or of all), s; see
    /// time_step.cpp.
    StepLimit step_limit(bool sleepers_too = false) const;
    double stable_time_step(bool sleepers_too = false) const { return step_limit(sleepers_too).time_step; }

    Blocks blocks;
    Wires wires;

    /// What a saved run adds to the poses, wires and forces.
    struct Memory {
        std::vector<TouchingPair> pairs;  ///< those that touch
        std::optional<Sleeping::Memory> sleeping;
        double time, dissipated, water_work, gross_water_work, largest_kinetic, largest_overlap,
            waves_reach_blocks;
        std::uint64_t steps, awake_block_steps, deep_contact_steps;
    };
    Memory memory() const;
    /// Takes up a saved run; blocks and wires must have been put back before.
    void restore(const Memory& memory);
    /// Blocks were moved by hand: lists anew, everybody awake.
    void blocks_were_placed(double t);

    const PairList& pair_list() const { return pair_list_; }
    const Surroundings& surroundings() const { return surroundings_; }

 private:
    void step(double dt, double t, bool is_first, bool is_last);
    void begin_step(std::span<const std::uint32_t> some, double dt, double t);
    void begin_sums(std::span<const std::uint32_t> of);
    void add_contacts(double dt, bool is_last);
    void add_pair(const Pair& pair, const PairForces& forces, bool to_block, bool to_partner);
    double damping_power_of(std::uint32_t block) const;
    void note_pulls();
    void note_change(const Pair& pair, const PairForces& now, const PairForces& at_look);
    void wake_disturbed(double dt, bool is_last);
    void look_for_sleepers(double t);
    double reserve(std::size_t block) const;
    void finish_step(std::span<const std::uint32_t> some, double dt, bool is_last);
    void sum_all_forces();
    bool sample_doubtful(double t);
    void note_overlap(const Pair& pair, double overlap);
    void check_values() const;
    void note_kinetic_energy();
    void require_drag_within(double dt) const;
    void find_awake();
    void find_active();

    Surroundings surroundings_;
    std::unique_ptr<ContactModel> contact_model_;
    Vector gravity_;
    StepRules rules_;
    PairList pair_list_;
    std::vector<std::unique_ptr<Load>> own_loads_;   ///< act on each block by itself
    std::vector<std::unique_ptr<Load>> link_loads_;  ///< act between blocks
    FluidLoads* water_ = nullptr;
    std::unique_ptr<Sleeping> sleeping_;
    std::vector<std::uint32_t> movable_, awake_;  ///< blocks
    std::vector<std::uint8_t> is_awake_, is_movable_;
    /// How the sums of a sleeper differ in the step at hand from those of the last look.
    struct Change {
        Vector force{0, 0, 0}, torque{0, 0, 0};                  // of all
        Vector damping_force{0, 0, 0}, damping_torque{0, 0, 0};  // the dashpots' whole share
    };
    std::vector<std::uint32_t> bordering_, disturbed_;  ///< sleepers next to blocks awake; those to wake now
    std::vector<Change> change_;                        ///< of all blocks, kept for those bordering
    std::vector<std::uint32_t> wires_to_sleepers_;      ///< with a block awake at the other end
    std::vector<Vector> pull_at_look_;                  ///< of all wires with a sleeper, N
    std::vector<Vector> damping_force_, damping_torque_;  ///< the dashpots' share of the sums
    std::vector<std::uint32_t> active_;                   ///< pairs that may touch, with a block awake
    std::vector<PairForces> portion_;                     ///< of the pairs at hand
    double damping_power_ = 0;                            ///< of the dashpots in the step at hand, W
    double time_ = 0, dissipated_ = 0, largest_kinetic_ = 0, largest_overlap_ = 0;
    std::uint64_t steps_ = 0, awake_block_steps_ = 0, deep_contact_steps_ = 0;
};

}  // namespace dem
