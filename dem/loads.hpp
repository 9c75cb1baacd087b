/// What acts on blocks besides weight and contacts: a list built once, one call each a step. An effect that
/// is off is not in it.
#pragma once

#include <limits>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "dem/blocks.hpp"
#include "dem/effects/fluid_force.hpp"
#include "dem/effects/wires.hpp"

namespace dem {

/// One load on the blocks.
class Load {
 public:
    virtual ~Load() = default;
    /// Called now and then (at the flow interval): looks at the surroundings for the time from t to t + hold.
    virtual void sample(Blocks& blocks, double t, double hold) = 0;
    /// Adds to blocks.force and blocks.torque; every step. `wanted`: the blocks whose sums are wanted, also
    /// as flags.
    virtual void add(Blocks& blocks, std::span<const std::uint32_t> wanted,
                     const std::vector<std::uint8_t>& is_wanted, double t) = 0;
    /// After the step of these blocks: adds up the work done on them.
    virtual void account(const Blocks& blocks, std::span<const std::uint32_t> some, double dt) = 0;
    /// Asks for the memory of blocks that a step will soon come to.
    virtual void fetch(std::size_t first, std::size_t count) const = 0;
    /// Who is awake has changed.
    virtual void awake_changed(const std::vector<std::uint8_t>& is_awake) = 0;
};

/// The water's force on every block that is not fixed.
class FluidLoads final : public Load {
 public:
    FluidLoads(const Blocks& blocks, FluidProperties properties, std::variant<UniformWater, FlowGrid> motion);

    void sample(Blocks& blocks, double t, double hold) override;
    void add(Blocks& blocks, std::span<const std::uint32_t> wanted,
             const std::vector<std::uint8_t>& is_wanted, double t) override;
    void account(const Blocks& blocks, std::span<const std::uint32_t> some, double dt) override;
    void fetch(std::size_t first, std::size_t count) const override;
    void awake_changed(const std::vector<std::uint8_t>& is_awake) override;

    void set_motion(std::variant<UniformWater, FlowGrid> motion);
    /// The next sample() is exact for every block: blocks were put elsewhere.
    void forget_samples();
    /// Those asleep keep the load of an earlier sample while the water around them has changed little: at
    /// most by how much its force and, over the block's radius, its torque may differ by now, N.
    double uncertainty(std::size_t block) const { return resting_[block].uncertainty; }
    /// As sampled last.
    const FluidLoad& load(std::size_t block) const { return loads_[block]; }
    /// Makes the load of one block exact again, for the instant of the last sample().
    void sample_block(Blocks& blocks, std::size_t block, double t);

    double work = 0;        ///< done by the water on blocks, buoyancy and added mass included, J
    double gross_work = 0;  ///< the same in absolute value, J
    double waves_reach_blocks =
        -1;  ///< first time the water at some block is faster than 0.357 sqrt(g d), s; -1: not yet

 private:
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
    /// What the water was around a block that is asleep when it was sampled there last.
    struct Resting {
        bool is_known = false;
        FlowGrid::Points points{};
        std::vector<double> values;
        std::size_t interval = none;  // of the grid's samples in time: for it the uncertainty has been found
        double uncertainty = 0;
    };
    bool stays_as_sampled(const Blocks& blocks, std::size_t block);
    void remember(const Blocks& blocks, std::size_t block);

    std::variant<UniformWater, FlowGrid> motion_;
    FluidProperties properties_;
    double wave_speed_;  // m/s
    std::vector<std::uint8_t> is_awake_;
    std::vector<Resting> resting_;
    std::vector<FluidLoad> loads_;
    std::vector<FluidLoadInMotion> in_motion_;        // the same for steps
    std::vector<FluidLoadInMotion::Wrench> applied_;  // in the last step
    double ahead_ = 0;                                // half the time a sample is held, s
};

/// Wires with an end that may move.
class WireLoads final : public Load {
 public:
    explicit WireLoads(Wires& wires) : wires_(wires) {}
    void sample(Blocks&, double, double) override {}
    void add(Blocks& blocks, std::span<const std::uint32_t> wanted,
             const std::vector<std::uint8_t>& is_wanted, double t) override;
    void account(const Blocks&, std::span<const std::uint32_t>, double) override {}
    void fetch(std::size_t, std::size_t) const override {}
    void awake_changed(const std::vector<std::uint8_t>& is_awake) override;

 private:
    Wires& wires_;
    std::vector<std::uint32_t> all_, active_;  // wires; those with an end awake
    std::size_t awake_count_ = 0;
};

}  // namespace dem
