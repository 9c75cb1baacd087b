#include "dem/step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/errors.hpp"
#include "dem/motion.hpp"

namespace dem {

Simulation::Simulation(Blocks placed, Surroundings surroundings, std::unique_ptr<ContactModel> contact_model,
                       Vector gravity, StepRules rules)
    : blocks(std::move(placed)),
      surroundings_(std::move(surroundings)),
      contact_model_(std::move(contact_model)),
      gravity_(std::move(gravity)),
      rules_(rules),
      pair_list_(blocks, surroundings_, rules.skin) {
    for (std::uint32_t i = 0; i < blocks.size(); ++i)
        if (!blocks.is_fixed[i]) movable_.push_back(i);
    damping_force_.assign(blocks.size(), Vector::Zero());
    damping_torque_.assign(blocks.size(), Vector::Zero());
    find_awake();
}

void Simulation::add_water(FluidProperties properties, std::variant<UniformWater, FlowGrid> motion) {
    auto water = std::make_unique<FluidLoads>(blocks, std::move(properties), std::move(motion));
    water_ = water.get();
    loads_.push_back(std::move(water));
}

void Simulation::mount_wires(Wires mounted) {
    wires = std::move(mounted);
    loads_.push_back(std::make_unique<WireLoads>(wires));
    loads_.back()->awake_changed(is_awake_);
}

void Simulation::add_sleeping(const SleepRules& rules) {
    std::vector<double> weights;
    for (std::size_t i = 0; i < blocks.size(); ++i)
        weights.push_back(blocks.shape_of(i).mass * std::max(gravity_.norm(), 1e-3));
    sleeping_ = std::make_unique<Sleeping>(blocks, rules, weights);
}

void Simulation::start(double t) {
    time_ = t;
    if (sleeping_) sleeping_->wake_all(blocks, t);
    find_awake();
    for (const auto& load : loads_) load->sample(blocks, t, 0);
    // Contacts as they are: a step of no length leaves their histories alone.
    contact_model_->evaluate(blocks, surroundings_, pair_list_, active_, 0);
    sum_all_forces();
    if (sleeping_) sleeping_->wake_all(blocks, t);  // once more: now the loads they rest under are known
}

void Simulation::blocks_were_placed(double t) {
    pair_list_.rebuild();
    start(t);
}

void Simulation::advance(double target) {
    const double begin = time_;
    const auto count = std::max<std::int64_t>(
        1, static_cast<std::int64_t>(std::ceil((target - begin) / rules_.time_step * (1 - 1e-12))));
    const double dt = (target - begin) / static_cast<double>(count);
    const auto every = std::max<std::int64_t>(1, std::llround(rules_.flow_interval / dt));
    for (std::int64_t k = 0; k < count; ++k) {
        if (k % every == 0) {
            common::check_for_interrupt();
            check_values();
            const double hold = dt * static_cast<double>(std::min(every, count - k));
            for (const auto& load : loads_) load->sample(blocks, begin + dt * static_cast<double>(k), hold);
            if (sleeping_) {
                sum_all_forces();  // of those asleep too; contacts are those of the last step
                bool changed = false;
                dissipated_ += sleeping_->look(blocks, time_, changed);
                if (changed) find_awake();
            }
        }
        if (awake_.empty()) {  // all asleep: only the next look can change that
            if (rules_.cross_still) k = std::min(count, (k / every + 1) * every) - 1;
            time_ = k + 1 == count ? target : begin + dt * static_cast<double>(k + 1);
            continue;
        }
        step(dt, k + 1 == count ? target : begin + dt * static_cast<double>(k + 1));
    }
    check_values();
}

void Simulation::step(double dt, double t) {
    pair_list_.begin_update();
    for (const auto i : awake_) {
        kick_half(blocks, i, 0.5 * dt);
        drift(blocks, i, dt);
        pair_list_.note_motion(i);
    }
    time_ = t;
    if (pair_list_.update()) find_active();
    sum_forces(awake_, is_awake_, active_, dt);
    double damping_power = 0;
    for (const auto i : awake_) {
        kick_half(blocks, i, 0.5 * dt);
        blocks.update_angular_velocity(i);
        // The mean velocity of the two kicks around this instant makes this the very energy that the dashpots
        // take.
        damping_power +=
            damping_force_[i].dot(blocks.velocity[i]) + damping_torque_[i].dot(blocks.angular_velocity[i]);
    }
    dissipated_ -= dt * damping_power;
    for (const auto& load : loads_) load->account(blocks, awake_, dt);
    ++steps_;
    awake_block_steps_ += awake_.size();
}

void Simulation::sum_forces(const std::vector<std::uint32_t>& of, const std::vector<std::uint8_t>& is_wanted,
                            const std::vector<std::uint32_t>& pairs_to_add, double dt) {
    for (const auto i : of) {
        blocks.force[i] =
            blocks.shape_of(i).mass * gravity_;  // (11), dry part: buoyancy comes with the water
        blocks.torque[i].setZero();
        damping_force_[i].setZero();
        damping_torque_[i].setZero();
    }
    for (const auto& load : loads_) load->add(blocks, of, is_wanted, time_);
    // Pairs in their order: every block adds its own up in the same order, whoever is listed and however many
    // threads run. In portions that stay in the cache between their evaluation and their adding up.
    constexpr std::size_t portion = 4096;
    for (std::size_t from = 0; from < pairs_to_add.size(); from += portion) {
        const std::span<const std::uint32_t> some(pairs_to_add.data() + from,
                                                  std::min(portion, pairs_to_add.size() - from));
        if (dt > 0) contact_model_->evaluate(blocks, surroundings_, pair_list_, some, dt);
        for (const auto k : some) {
            const Pair& pair = pair_list_.pairs()[k];
            if (pair.contacts.empty()) continue;
            if (is_wanted[pair.block]) {
                blocks.force[pair.block] += pair.force;
                blocks.torque[pair.block] += pair.torque_on_block;
                damping_force_[pair.block] += pair.damping_force;
                damping_torque_[pair.block] += pair.damping_torque;
            }
            if (pair_list_.is_block(pair.partner) && is_wanted[pair.partner]) {
                blocks.force[pair.partner] -= pair.force;
                blocks.torque[pair.partner] += pair.offset.cross(pair.force) - pair.torque_on_block;
                damping_force_[pair.partner] -= pair.damping_force;
                damping_torque_[pair.partner] += pair.offset.cross(pair.damping_force) - pair.damping_torque;
            }
            if (dt > 0) {
                dissipated_ += pair.dissipated;
                if (pair.largest_overlap > rules_.overlap_noted || pair.largest_overlap > largest_overlap_)
                    note_overlap(pair);
            }
        }
    }
}

void Simulation::sum_all_forces() {
    std::vector<std::uint32_t> all(pair_list_.pairs().size());
    std::iota(all.begin(), all.end(), 0u);
    std::vector<std::uint8_t> is_movable(blocks.size(), 0);
    for (const auto i : movable_) is_movable[i] = 1;
    sum_forces(movable_, is_movable, all, 0);
}

void Simulation::note_overlap(const Pair& pair) {
    largest_overlap_ = std::max(largest_overlap_, pair.largest_overlap);
    if (pair.largest_overlap > rules_.overlap_noted) ++deep_contact_steps_;
    if (pair.largest_overlap > rules_.overlap_limit)
        throw common::RunError(
            fmt::format("t = {:.5f} s: block {} is {:.2g} m deep in {}, past the limit of {:.2g} m; a "
                        "shorter dem.time_step or stiffer "
                        "spheres are needed",
                        time_, pair.block + 1, pair.largest_overlap,
                        pair_list_.is_block(pair.partner) ? fmt::format("block {}", pair.partner + 1)
                        : pair_list_.is_fixed_spheres(pair.partner) ? std::string("the fixed spheres")
                                                                    : std::string("a plane"),
                        rules_.overlap_limit));
}

void Simulation::check_values() const {
    for (const auto i : awake_)
        if (!blocks.position[i].allFinite() || !blocks.velocity[i].allFinite() ||
            !blocks.orientation[i].coeffs().allFinite() || !blocks.angular_momentum[i].allFinite())
            throw common::RunError(
                fmt::format("t = {:.5f} s: the motion of block {} is no longer finite", time_, i + 1));
    // Below everything that could hold it, a block would fall for ever.
    if (surroundings_.fixed_spheres.empty() || !surroundings_.planes.empty()) {
        bool has_floor = surroundings_.fixed_spheres.empty();
        for (const auto& plane : surroundings_.planes)
            has_floor = has_floor || plane.normal.dot(gravity_) < -0.1 * gravity_.norm();
        if (has_floor) return;
    }
    for (const auto i : awake_)
        if (blocks.position[i].z() < surroundings_.fixed_spheres.lowest() - 4 * blocks.shape_of(i).radius)
            throw common::RunError(
                fmt::format("t = {:.5f} s: block {} has left the mound at x = {:.3f}, y = {:.3f} m and "
                            "falls; extend dem.mound.profile",
                            time_, i + 1, blocks.position[i].x(), blocks.position[i].y()));
}

void Simulation::find_awake() {
    awake_.clear();
    is_awake_.assign(blocks.size(), 0);
    for (const auto i : movable_) {
        if (sleeping_ && sleeping_->is_asleep(i)) continue;
        awake_.push_back(i);
        is_awake_[i] = 1;
    }
    for (const auto& load : loads_) load->awake_changed(is_awake_);
    find_active();
}

void Simulation::find_active() {
    active_.clear();
    for (std::uint32_t k = 0; k < pair_list_.keys().size(); ++k) {
        const PairList::Key& key = pair_list_.keys()[k];
        if (!key.has_candidates) continue;
        if (is_awake_[key.block] || (pair_list_.is_block(key.partner) && is_awake_[key.partner]))
            active_.push_back(k);
    }
}

EnergyBudget Simulation::energy() const {
    EnergyBudget budget;
    for (const auto i : movable_) {
        budget.kinetic += blocks.kinetic_energy(i);
        budget.potential -= blocks.shape_of(i).mass * gravity_.dot(blocks.position[i]);
    }
    budget.contacts = contact_model_->elastic_energy(blocks, surroundings_, pair_list_);
    budget.wires = wires.elastic_energy(blocks);
    budget.dissipated = dissipated_ + wires.energy_of_broken;
    if (water_ != nullptr) {
        budget.water_work = water_->work;
        budget.gross_water_work = water_->gross_work;
    }
    return budget;
}

Simulation::Memory Simulation::memory() const {
    Memory memory{.pairs = {},
                  .sleeping = {},
                  .time = time_,
                  .dissipated = dissipated_,
                  .water_work = water_ != nullptr ? water_->work : 0,
                  .gross_water_work = water_ != nullptr ? water_->gross_work : 0,
                  .largest_overlap = largest_overlap_,
                  .waves_reach_blocks = water_ != nullptr ? water_->waves_reach_blocks : -1,
                  .steps = steps_,
                  .awake_block_steps = awake_block_steps_,
                  .deep_contact_steps = deep_contact_steps_};
    for (const auto& pair : pair_list_.pairs())
        if (!pair.contacts.empty()) memory.pairs.push_back(pair);
    if (sleeping_) memory.sleeping = sleeping_->memory();
    return memory;
}

void Simulation::restore(const Memory& memory) {
    pair_list_.rebuild();
    pair_list_.restore(memory.pairs);
    time_ = memory.time;
    dissipated_ = memory.dissipated;
    largest_overlap_ = memory.largest_overlap;
    steps_ = memory.steps;
    awake_block_steps_ = memory.awake_block_steps;
    deep_contact_steps_ = memory.deep_contact_steps;
    if (water_ != nullptr) {
        water_->work = memory.water_work;
        water_->gross_work = memory.gross_water_work;
        water_->waves_reach_blocks = memory.waves_reach_blocks;
    }
    if (sleeping_ && memory.sleeping) sleeping_->restore(*memory.sleeping);
    find_awake();
}

}  // namespace dem
