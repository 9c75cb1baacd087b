#include "dem/step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/errors.hpp"
#include "common/parallel.hpp"
#include "dem/motion.hpp"
#include "dem/prefetch.hpp"

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
    is_movable_.assign(blocks.size(), 0);
    for (const auto i : movable_) is_movable_[i] = 1;
    change_.resize(blocks.size());
    find_awake();
}

void Simulation::add_water(FluidProperties properties, std::variant<UniformWater, FlowGrid> motion) {
    auto water = std::make_unique<FluidLoads>(blocks, std::move(properties), std::move(motion));
    water_ = water.get();
    own_loads_.push_back(std::move(water));
}

void Simulation::mount_wires(Wires mounted) {
    wires = std::move(mounted);
    pull_at_look_.assign(wires.size(), Vector::Zero());
    link_loads_.clear();
    link_loads_.push_back(std::make_unique<WireLoads>(wires));
    link_loads_.back()->awake_changed(is_awake_);
}

void Simulation::add_sleeping(const SleepRules& rules) {
    sleeping_ = std::make_unique<Sleeping>(blocks, rules);
}

void Simulation::start(double t) {
    time_ = t;
    if (sleeping_) sleeping_->wake_all(blocks, t);
    find_awake();
    for (const auto& load : own_loads_) load->sample(blocks, t, 0);
    // Contacts as they are: a step of no length leaves their histories alone.
    std::vector<PairForces> forces(active_.size());
    contact_model_->evaluate(blocks, surroundings_, pair_list_, active_, 0, forces);
    for (std::size_t k = 0; k < active_.size(); ++k) pair_list_.last(active_[k]) = forces[k];
    sum_all_forces();
    if (sleeping_) sleeping_->wake_all(blocks, t);  // once more: now the loads they rest under are known
}

void Simulation::blocks_were_placed(double t) {
    pair_list_.rebuild();
    largest_kinetic_ = 0;
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
            note_kinetic_energy();
            const double hold = dt * static_cast<double>(std::min(every, count - k));
            for (const auto& load : own_loads_)
                load->sample(blocks, begin + dt * static_cast<double>(k), hold);
            // With the new sample, and of those asleep too; contacts are those of the last step.
            if (sleeping_ || water_ != nullptr) sum_all_forces();
            if (water_ != nullptr) require_drag_within(dt);
            if (sleeping_) look_for_sleepers(begin + dt * static_cast<double>(k));
        }
        if (awake_.empty()) {  // all asleep: only the next look can change that
            if (rules_.cross_still) k = std::min(count, (k / every + 1) * every) - 1;
            time_ = k + 1 == count ? target : begin + dt * static_cast<double>(k + 1);
            continue;
        }
        const bool is_first = k % every == 0, is_last = (k + 1) % every == 0 || k + 1 == count;
        step(dt, k + 1 == count ? target : begin + dt * static_cast<double>(k + 1), is_first, is_last);
    }
    check_values();
    note_kinetic_energy();
}

/// What weight turns into motion and back changes hands like all other energy.
void Simulation::note_kinetic_energy() {
    double kinetic = 0;
    for (const auto i : awake_) kinetic += blocks.kinetic_energy(i);
    largest_kinetic_ = std::max(largest_kinetic_, kinetic);
}

// Velocity Verlet in one sweep over pairs and blocks, so that what is known of a block passes through the
// caches once a step: pairs are added up in their order, a block whose pairs are all added ends its step and,
// unless it is time to look around, begins the next one at once. Pairs of later blocks do not concern it.
void Simulation::step(double dt, double t, bool is_first, bool is_last) {
    if (is_first) begin_step(awake_, dt, t);
    time_ = t;
    if (pair_list_.update()) find_active();
    for (const auto& load : link_loads_) load->add(blocks, awake_, is_awake_, time_);
    for (const auto i : bordering_) change_[i] = {};
    if (!bordering_.empty()) note_pulls();
    add_contacts(dt, is_last);
    ++steps_;
    awake_block_steps_ += awake_.size();
    if (!bordering_.empty()) wake_disturbed(dt, is_last);
}

/// Who falls asleep and who wakes; blocks' sums are those of all, with the water sampled at t.
void Simulation::look_for_sleepers(double t) {
    if (sample_doubtful(t)) sum_all_forces();
    bool changed = false;
    dissipated_ += sleeping_->look(
        blocks, time_, [this](std::size_t i) { return reserve(i); }, changed);
    if (changed) find_awake();
    if (awake_.empty() || awake_.size() == movable_.size()) return;
    for (std::size_t k = 0; k < wires.size(); ++k)
        if (!is_awake_[wires.block_a[k]] || !is_awake_[wires.block_b[k]])
            pull_at_look_[k] = wires.pull_of(blocks, k);
}

/// What a block at rest could still take, N.
double Simulation::reserve(std::size_t block) const {
    std::vector<CarriedContact> contacts;
    for (const auto entry : pair_list_.pairs_of(block)) {
        const Pair& pair = pair_list_.pairs()[entry >> 1];
        if (pair.contacts > 0)
            contact_model_->carry(blocks, surroundings_, pair_list_, pair, (entry & 1) != 0, contacts);
    }
    const double gravity = gravity_.norm();
    if (gravity == 0) return 0;
    return reserve_of(contacts, contact_model_->friction(), -gravity_ / gravity,
                      blocks.shape_of(block).radius);
}

/// What wires pull at sleepers otherwise than at the last look.
void Simulation::note_pulls() {
    for (const auto k : wires_to_sleepers_) {
        const Vector change = wires.pull_of(blocks, k) - pull_at_look_[k];
        const auto a = wires.block_a[k], b = wires.block_b[k];
        if (!is_awake_[a]) {
            change_[a].force += change;
            change_[a].torque += blocks.arm(a, wires.sphere_a[k]).cross(change);
        }
        if (!is_awake_[b]) {
            change_[b].force -= change;
            change_[b].torque -= blocks.arm(b, wires.sphere_b[k]).cross(change);
        }
    }
}

/// What a contact does to a sleeper otherwise than at the last look.
void Simulation::note_change(const Pair& pair, const PairForces& now, const PairForces& at_look) {
    if (!is_awake_[pair.block]) {
        Change& change = change_[pair.block];
        change.force += now.force - at_look.force;
        change.torque += now.torque_on_block - at_look.torque_on_block;
        change.damping_force += now.damping_force;
        change.damping_torque += now.damping_torque;
    }
    if (pair_list_.is_block(pair.partner) && !is_awake_[pair.partner]) {
        Change& change = change_[pair.partner];
        change.force -= now.force - at_look.force;
        change.torque += now.offset.cross(now.force) - now.torque_on_block -
                         at_look.offset.cross(at_look.force) + at_look.torque_on_block;
        change.damping_force -= now.damping_force;
        change.damping_torque += now.offset.cross(now.damping_force) - now.damping_torque;
    }
}

/// Sleepers whose sums have changed enough end this step with the others and take part from the next one on.
void Simulation::wake_disturbed(double dt, bool is_last) {
    disturbed_.clear();
    for (const auto i : bordering_)
        if (sleeping_->is_disturbed(blocks, i, change_[i].force, change_[i].torque)) disturbed_.push_back(i);
    if (disturbed_.empty()) return;
    for (const auto i : disturbed_) {
        blocks.force[i] += change_[i].force;
        blocks.torque[i] += change_[i].torque;
        damping_force_[i] = change_[i].damping_force;
        damping_torque_[i] = change_[i].damping_torque;
        sleeping_->wake(blocks, i, time_);
        kick_half(blocks, i, 0.5 * dt);
        blocks.update_angular_velocity(i);
        dissipated_ -= dt * damping_power_of(i);
    }
    find_awake();
    if (!is_last) begin_step(disturbed_, dt, time_ + dt);
}

/// Blocks move, and the sums of what acts on them at t begin with all but contacts and links.
void Simulation::begin_step(std::span<const std::uint32_t> some, double dt, double t) {
    constexpr std::size_t chunk = 64;  // blocks that stay in the nearest cache between moving and loading
    for (std::size_t from = 0; from < some.size(); from += chunk) {
        const auto few = some.subspan(from, std::min(chunk, some.size() - from));
        for (const auto i : few) {
            kick_half(blocks, i, 0.5 * dt);
            pair_list_.note_motion(i, drift(blocks, i, dt));
        }
        begin_sums(few);
        for (const auto& load : own_loads_) load->add(blocks, few, is_awake_, t);
    }
}

void Simulation::begin_sums(std::span<const std::uint32_t> of) {
    for (const auto i : of) {
        blocks.force[i] =
            blocks.shape_of(i).mass * gravity_;  // (11), dry part: buoyancy comes with the water
        blocks.torque[i].setZero();
        damping_force_[i].setZero();
        damping_torque_[i].setZero();
    }
}

/// Evaluates and adds up all active pairs, and finishes the step of every block on the way. Pairs in their
/// order: every block adds its own up in the same order, whoever is listed and however many threads run. In
/// portions that stay in the cache between their evaluation and their adding up.
void Simulation::add_contacts(double dt, bool is_last) {
    constexpr std::size_t shortest_portion = 64, longest_portion = 4096;
    // Threads share a portion: with few pairs in it they would wait for each other more than they work.
    const std::size_t portion = omp_get_max_threads() > 1 ? longest_portion : shortest_portion;
    damping_power_ = 0;
    std::size_t finished = 0;
    for (std::size_t from = 0; from < active_.size(); from += portion) {
        const std::span<const std::uint32_t> some(active_.data() + from,
                                                  std::min(portion, active_.size() - from));
        portion_.resize(std::max(portion_.size(), some.size()));
        contact_model_->evaluate(blocks, surroundings_, pair_list_, some, dt, portion_);
        for (std::size_t k = 0; k < some.size(); ++k) {
            const Pair& pair = pair_list_.pairs()[some[k]];
            const bool is_touching = pair.contacts > 0;
            if (!bordering_.empty())
                note_change(pair, is_touching ? portion_[k] : PairForces{}, pair_list_.last(some[k]));
            if (!is_touching) {
                if (is_last) pair_list_.last(some[k]) = {};  // they parted
                continue;
            }
            const PairForces& forces = portion_[k];
            add_pair(pair, forces, is_awake_[pair.block],
                     pair_list_.is_block(pair.partner) && is_awake_[pair.partner]);
            dissipated_ += forces.dissipated;
            if (forces.largest_overlap > rules_.overlap_noted || forces.largest_overlap > largest_overlap_)
                note_overlap(pair, forces.largest_overlap);
            if (is_last) pair_list_.last(some[k]) = forces;
        }
        // The pairs to come belong to this block or later ones: the blocks before it have all their forces.
        const std::size_t next = from + some.size();
        const std::uint32_t bound = next < active_.size() ? pair_list_.pairs()[active_[next]].block
                                                          : std::numeric_limits<std::uint32_t>::max();
        const std::size_t first = finished;
        while (finished < awake_.size() && awake_[finished] < bound) ++finished;
        finish_step({awake_.data() + first, finished - first}, dt, is_last);
    }
    finish_step({awake_.data() + finished, awake_.size() - finished}, dt, is_last);
    dissipated_ -= dt * damping_power_;
}

double Simulation::damping_power_of(std::uint32_t block) const {
    return damping_force_[block].dot(blocks.velocity[block]) +
           damping_torque_[block].dot(blocks.angular_velocity[block]);
}

void Simulation::add_pair(const Pair& pair, const PairForces& forces, bool to_block, bool to_partner) {
    if (to_block) {
        blocks.force[pair.block] += forces.force;
        blocks.torque[pair.block] += forces.torque_on_block;
        damping_force_[pair.block] += forces.damping_force;
        damping_torque_[pair.block] += forces.damping_torque;
    }
    if (to_partner) {
        blocks.force[pair.partner] -= forces.force;
        blocks.torque[pair.partner] += forces.offset.cross(forces.force) - forces.torque_on_block;
        damping_force_[pair.partner] -= forces.damping_force;
        damping_torque_[pair.partner] += forces.offset.cross(forces.damping_force) - forces.damping_torque;
    }
}

/// The second half of the kick of blocks whose sums are complete; then, unless this was the last step before
/// a look around, the first half of their next step.
void Simulation::finish_step(std::span<const std::uint32_t> some, double dt, bool is_last) {
    constexpr std::size_t chunk = 64, ahead = 16;
    if (!some.empty()) {
        const std::size_t next = some.back() + 1, count = some.size() + ahead;
        blocks.fetch(next, count);
        fetch_ahead(damping_force_, next, count);
        fetch_ahead(damping_torque_, next, count);
        for (const auto& load : own_loads_) load->fetch(next, count);
    }
    for (std::size_t from = 0; from < some.size(); from += chunk) {
        const auto few = some.subspan(from, std::min(chunk, some.size() - from));
        for (const auto i : few) {
            kick_half(blocks, i, 0.5 * dt);
            blocks.update_angular_velocity(i);
            // The mean velocity of the two kicks around this instant makes this the very energy that the
            // dashpots take.
            damping_power_ += damping_power_of(i);
        }
        for (const auto& load : own_loads_) load->account(blocks, few, dt);
        if (!is_last) begin_step(few, dt, time_ + dt);
    }
}

/// The forces on all blocks, sleepers too, from the contacts as they were kept last.
void Simulation::sum_all_forces() {
    begin_sums(movable_);
    for (const auto& load : own_loads_) load->add(blocks, movable_, is_movable_, time_);
    for (const auto& load : link_loads_) load->add(blocks, movable_, is_movable_, time_);
    for (std::size_t k = 0; k < pair_list_.pairs().size(); ++k) {
        const Pair& pair = pair_list_.pairs()[k];
        if (pair.contacts > 0)
            add_pair(pair, pair_list_.last(k), is_movable_[pair.block],
                     pair_list_.is_block(pair.partner) && is_movable_[pair.partner]);
    }
}

/// Sleepers whose load of water may have changed enough to wake them are sampled; true when there were any.
bool Simulation::sample_doubtful(double t) {
    bool any = false;
    if (water_ == nullptr) return any;
    for (const auto i : movable_) {
        const double uncertainty = water_->uncertainty(i);
        if (uncertainty == 0 || !sleeping_->may_wake(blocks, i, uncertainty)) continue;
        water_->sample_block(blocks, i, t);
        any = true;
    }
    return any;
}

void Simulation::note_overlap(const Pair& pair, double overlap) {
    largest_overlap_ = std::max(largest_overlap_, overlap);
    if (overlap > rules_.overlap_noted) ++deep_contact_steps_;
    if (overlap > rules_.overlap_limit)
        throw common::RunError(
            fmt::format("t = {:.5f} s: block {} is {:.2g} m deep in {}, past the limit of {:.2g} m; a "
                        "shorter dem.time_step or stiffer "
                        "spheres are needed",
                        time_, pair.block + 1, overlap,
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
                fmt::format("t = {:.5f} s: the motion of block {} is no longer finite; shorten dem.time_step",
                            time_, i + 1));
    // Below a mound that was to hold it, a block would fall for ever.
    if (gravity_.norm() == 0) return;
    for (const auto& plane : surroundings_.planes)
        if (plane.normal.dot(gravity_) < -0.1 * gravity_.norm()) return;
    for (const auto i : awake_)
        if (blocks.position[i].z() < surroundings_.mound_floor - 4 * blocks.shape_of(i).radius)
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
    for (const auto& load : own_loads_) load->awake_changed(is_awake_);
    for (const auto& load : link_loads_) load->awake_changed(is_awake_);
    wires_to_sleepers_.clear();
    if (awake_.size() < movable_.size())
        for (std::uint32_t k = 0; k < wires.size(); ++k) {
            const auto a = wires.block_a[k], b = wires.block_b[k];
            if ((is_awake_[a] && sleeping_->is_asleep(b)) || (is_awake_[b] && sleeping_->is_asleep(a)))
                wires_to_sleepers_.push_back(k);
        }
    find_active();
}

void Simulation::find_active() {
    active_.clear();
    bordering_.clear();
    const bool anybody_asleep = awake_.size() < movable_.size();
    for (std::uint32_t k = 0; k < pair_list_.pairs().size(); ++k) {
        const Pair& pair = pair_list_.pairs()[k];
        if (!pair_list_.is_near(k)) continue;
        if (is_awake_[pair.block] || (pair_list_.is_block(pair.partner) && is_awake_[pair.partner]))
            active_.push_back(k);
        else
            continue;
        if (!anybody_asleep) continue;
        if (is_movable_[pair.block] && !is_awake_[pair.block]) bordering_.push_back(pair.block);
        if (pair_list_.is_block(pair.partner) && is_movable_[pair.partner] && !is_awake_[pair.partner])
            bordering_.push_back(pair.partner);
    }
    for (const auto k : wires_to_sleepers_)
        bordering_.push_back(is_awake_[wires.block_a[k]] ? wires.block_b[k] : wires.block_a[k]);
    std::sort(bordering_.begin(), bordering_.end());
    bordering_.erase(std::unique(bordering_.begin(), bordering_.end()), bordering_.end());
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
    budget.largest_kinetic = std::max(largest_kinetic_, budget.kinetic);
    if (water_ != nullptr) {
        budget.water_work = water_->work;
        budget.gross_water_work = water_->gross_work;
    }
    return budget;
}

Simulation::Memory Simulation::memory() const {
    Memory memory{.pairs = pair_list_.touching(),
                  .sleeping = {},
                  .time = time_,
                  .dissipated = dissipated_,
                  .water_work = water_ != nullptr ? water_->work : 0,
                  .gross_water_work = water_ != nullptr ? water_->gross_work : 0,
                  .largest_kinetic = largest_kinetic_,
                  .largest_overlap = largest_overlap_,
                  .waves_reach_blocks = water_ != nullptr ? water_->waves_reach_blocks : -1,
                  .steps = steps_,
                  .awake_block_steps = awake_block_steps_,
                  .deep_contact_steps = deep_contact_steps_};
    if (sleeping_) memory.sleeping = sleeping_->memory();
    return memory;
}

void Simulation::restore(const Memory& memory) {
    pair_list_.rebuild();
    pair_list_.restore(memory.pairs);
    time_ = memory.time;
    dissipated_ = memory.dissipated;
    largest_kinetic_ = memory.largest_kinetic;
    largest_overlap_ = memory.largest_overlap;
    steps_ = memory.steps;
    awake_block_steps_ = memory.awake_block_steps;
    deep_contact_steps_ = memory.deep_contact_steps;
    if (water_ != nullptr) {
        water_->work = memory.water_work;
        water_->gross_work = memory.gross_water_work;
        water_->waves_reach_blocks = memory.waves_reach_blocks;
        water_->forget_samples();
    }
    if (sleeping_ && memory.sleeping) sleeping_->restore(*memory.sleeping);
    find_awake();
}

}  // namespace dem
