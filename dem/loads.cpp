#include "dem/loads.hpp"

#include <algorithm>
#include <cmath>

namespace dem {

FluidLoads::FluidLoads(const Blocks& blocks, FluidProperties properties,
                       std::variant<UniformWater, FlowGrid> water_motion)
    : motion(std::move(water_motion)), properties_(std::move(properties)) {
    loads_.assign(blocks.size(), {Vector::Zero(), Vector::Zero(), Rotation::Zero(), Vector::Zero(), 0, 0});
    applied_.assign(blocks.size(), Vector::Zero());
}

void FluidLoads::sample(Blocks& blocks, double t, double hold) {
    constexpr double wave_speed =
        0.1;  // m/s: above the near field's noise in still water, far below what moves a block
    // The middle of the time the sample is held: second order in the interval.
    if (auto* grid = std::get_if<FlowGrid>(&motion)) grid->set_time(t + 0.5 * hold);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (blocks.is_fixed[i]) continue;
        loads_[i] = std::visit(
            [&](const auto& water) { return sample_fluid_load(blocks, i, water, properties_); }, motion);
        if (waves_reach_blocks < 0 && loads_[i].water_speed > wave_speed) waves_reach_blocks = t;
        const double ratio = mass_ratio(blocks.shape_of(i), loads_[i].wet, properties_);
        if (ratio != blocks.mass_ratio[i]) work += blocks.set_mass_ratio(i, ratio);
    }
}

void FluidLoads::add(Blocks& blocks, std::span<const std::uint32_t> wanted, const std::vector<std::uint8_t>&,
                     double) {
    for (const auto i : wanted) {
        applied_[i] = loads_[i].force_at(blocks.velocity[i]);
        blocks.force[i] += applied_[i];
        blocks.torque[i] += loads_[i].torque;
    }
}

void FluidLoads::account(const Blocks& blocks, std::span<const std::uint32_t> some, double dt) {
    for (const auto i : some) {
        const double done =
            dt * (applied_[i].dot(blocks.velocity[i]) + loads_[i].torque.dot(blocks.angular_velocity[i]));
        work += done;
        gross_work += std::abs(done);
    }
}

void WireLoads::add(Blocks& blocks, std::span<const std::uint32_t> wanted,
                    const std::vector<std::uint8_t>& is_wanted, double t) {
    // More blocks wanted than are awake: the sums of sleepers too, so all wires.
    wires_.pull(blocks, t, wanted.size() > awake_count_ ? all_ : active_, is_wanted);
}

void WireLoads::awake_changed(const std::vector<std::uint8_t>& is_awake) {
    all_.clear();
    active_.clear();
    awake_count_ = static_cast<std::size_t>(std::count(is_awake.begin(), is_awake.end(), 1));
    for (std::uint32_t k = 0; k < wires_.size(); ++k) {
        all_.push_back(k);
        if (is_awake[wires_.block_a[k]] || is_awake[wires_.block_b[k]]) active_.push_back(k);
    }
}

}  // namespace dem
