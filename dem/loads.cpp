#include "dem/loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/errors.hpp"
#include "dem/prefetch.hpp"

namespace dem {

namespace {

/// Water faster than this is a wave, m/s: 0.1 m/s for elements of 8 mm, above the near field's noise in still
/// water and far below what moves a block, and to Froude's scale for others.
double speed_of_waves(const FluidProperties& properties) {
    return 0.357 * std::sqrt(properties.gravity.norm() * properties.element.diameter);
}

}  // namespace

FluidLoads::FluidLoads(const Blocks& blocks, FluidProperties properties,
                       std::variant<UniformWater, FlowGrid> water_motion)
    : motion_(std::move(water_motion)),
      properties_(std::move(properties)),
      wave_speed_(speed_of_waves(properties_)) {
    is_awake_.assign(blocks.size(), 1);
    resting_.resize(blocks.size());
    loads_.resize(blocks.size());
    in_motion_.resize(blocks.size());
    applied_.assign(blocks.size(), {Vector::Zero(), Vector::Zero()});
}

void FluidLoads::sample(Blocks& blocks, double t, double hold) {
    // The middle of the time the sample is held, water and block: second order in the interval.
    ahead_ = 0.5 * hold;
    std::visit([&](auto& water) { water.set_time(t + ahead_); }, motion_);
    for (std::size_t i = 0; i < blocks.size(); ++i)
        if (!blocks.is_fixed[i] && !stays_as_sampled(blocks, i)) sample_block(blocks, i, t);
}

void FluidLoads::sample_block(Blocks& blocks, std::size_t i, double t) {
    try {
        loads_[i] = std::visit(
            [&](const auto& water) { return sample_fluid_load(blocks, i, water, properties_, ahead_); },
            motion_);
    } catch (const std::out_of_range& outside) {
        throw common::RunError(
            fmt::format("t = {:.5f} s: block {} leaves the water that is known: {}; enlarge cmps.flow or set "
                        "dem.flow_outside = \"still\"",
                        t, i + 1, outside.what()));
    }
    in_motion_[i] = FluidLoadInMotion(loads_[i]);
    if (waves_reach_blocks < 0 && loads_[i].water_speed > wave_speed_) waves_reach_blocks = t;
    const double ratio = mass_ratio(blocks.shape_of(i), loads_[i].wet, properties_);
    if (ratio != blocks.mass_ratio[i]) work += blocks.set_mass_ratio(i, ratio);
    if (!is_awake_[i]) remember(blocks, i);
}

void FluidLoads::remember(const Blocks& blocks, std::size_t i) {
    Resting& resting = resting_[i];
    resting.is_known = true;
    resting.uncertainty = 0;
    const auto* grid = std::get_if<FlowGrid>(&motion_);
    if (grid == nullptr) return;
    Vector low = blocks.sphere_centre(i, 0), high = low;
    for (std::size_t k = 1; k < blocks.shape_of(i).spheres.size(); ++k) {
        const Vector centre = blocks.sphere_centre(i, k);
        low = low.cwiseMin(centre);
        high = high.cwiseMax(centre);
    }
    const auto points = grid->points_around(low.x(), high.x(), low.z(), high.z());
    resting.is_known = points.has_value();
    if (!points) return;
    resting.points = *points;
    resting.values = grid->values_at(*points);
    resting.interval = none;
}

bool FluidLoads::stays_as_sampled(const Blocks& blocks, std::size_t i) {
    Resting& resting = resting_[i];
    if (is_awake_[i] || !resting.is_known) return false;
    const auto* grid = std::get_if<FlowGrid>(&motion_);
    if (grid == nullptr) return std::get<UniformWater>(motion_).is_steady();
    if (resting.interval == grid->interval()) return true;
    const FlowGrid::Change change = grid->largest_change(resting.points, resting.values);
    // What follows from the sample besides the load must not differ either.
    if (change.wet || (waves_reach_blocks < 0 && change.speed > wave_speed_)) return false;
    resting.interval = grid->interval();
    // No arm is longer than the radius: the torque over it differs by no more than the force.
    resting.uncertainty = 2 * largest_load_change(blocks.shape_of(i), change, properties_);
    return true;
}

void FluidLoads::set_motion(std::variant<UniformWater, FlowGrid> motion) {
    motion_ = std::move(motion);
    forget_samples();
}

void FluidLoads::forget_samples() {
    for (auto& resting : resting_) resting.is_known = false;
}

void FluidLoads::awake_changed(const std::vector<std::uint8_t>& is_awake) {
    is_awake_ = is_awake;
    for (std::size_t i = 0; i < is_awake.size(); ++i)
        if (is_awake[i]) resting_[i] = {};
}

void FluidLoads::add(Blocks& blocks, std::span<const std::uint32_t> wanted, const std::vector<std::uint8_t>&,
                     double) {
    for (const auto i : wanted) {
        applied_[i] = in_motion_[i].at(blocks.velocity[i], blocks.angular_velocity[i]);
        blocks.force[i] += applied_[i].force;
        blocks.torque[i] += applied_[i].torque;
    }
}

void FluidLoads::account(const Blocks& blocks, std::span<const std::uint32_t> some, double dt) {
    for (const auto i : some) {
        const double done = dt * (applied_[i].force.dot(blocks.velocity[i]) +
                                  applied_[i].torque.dot(blocks.angular_velocity[i]));
        work += done;
        gross_work += std::abs(done);
    }
}

void FluidLoads::fetch(std::size_t first, std::size_t count) const {
    fetch_ahead(in_motion_, first, count);
    fetch_ahead(applied_, first, count);
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
