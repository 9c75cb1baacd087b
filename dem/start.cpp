#include "dem/start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "dem/build_simulation.hpp"
#include "dem/put_back.hpp"

namespace dem {

namespace {

/// The blocks in still water, with these contacts and wires.
std::unique_ptr<Simulation> in_still_water(const Scene& scene, const Blocks& blocks,
                                           const std::vector<TouchingPair>& contacts, const Wires& wires) {
    auto simulation = build_simulation(scene, true);
    if (simulation->water() != nullptr)
        simulation->water()->set_motion(UniformWater{.element_diameter = scene.element.diameter});
    simulation->blocks = blocks;
    Simulation::Memory memory = simulation->memory();
    memory.pairs = contacts;
    memory.sleeping.reset();
    simulation->restore(memory);
    if (scene.effects.wires) simulation->mount_wires(wires);
    return simulation;
}

/// A run's books begin with it, as its energy balance does. On a clock set anew, the waves are yet to come.
void begin_books(Simulation::Memory& memory, bool is_clock_set) {
    memory.dissipated = memory.water_work = memory.gross_water_work = memory.largest_overlap = 0;
    memory.steps = memory.awake_block_steps = memory.deep_contact_steps = 0;
    if (is_clock_set) memory.waves_reach_blocks = -1;
}

/// Wires that broke while blocks settled did so before the run began.
void date_breaks(Wires& wires, const Wires& before, double begin) {
    for (std::size_t k = 0; k < wires.size(); ++k)
        if (before.is_intact[k] != 0 && wires.is_intact[k] == 0) wires.broken_at[k] = begin;
}

/// Mean and largest distance of blocks from where they were packed, m.
std::pair<double, double> distances(const Blocks& blocks, const PackedPoses& packed,
                                    const std::vector<std::uint32_t>& some) {
    double sum = 0, largest = 0;
    for (const auto i : some) {
        const double distance = (blocks.position[i] - packed.position[i]).norm();
        sum += distance;
        largest = std::max(largest, distance);
    }
    return {some.empty() ? 0.0 : sum / static_cast<double>(some.size()), largest};
}

}  // namespace

Start packed_start(const Scene& scene, common::Progress& progress) {
    Start start{.simulation = build_simulation(scene, true), .packed = {}};
    if (scene.packing.settle) {
        const auto packing = build_packing(scene);
        settle(*packing, scene.packing, "packing", [&](double t) { progress.update(t, "packing"); });
        take_over(*start.simulation, poses_of(packing->blocks), packing->memory().pairs);
        throw_held(start.simulation->blocks, scene);
    }
    start.packed = poses_of(start.simulation->blocks);
    return start;
}

Start start_from(const std::filesystem::path& from, const Scene& scene) {
    Snapshot snapshot = read_start(from, scene);
    Start start{.simulation = build_simulation(scene, true), .packed = snapshot.packed};
    start.without_springs = snapshot.without_springs;
    if (snapshot.is_packing) {
        take_over(*start.simulation, snapshot.packed, snapshot.memory.pairs);
        throw_held(start.simulation->blocks, scene);
        start.packed = poses_of(start.simulation->blocks);
        return start;
    }
    require_kept_rest_lengths(scene, snapshot.wires);
    start.t = snapshot.t;
    // On a clock set anew, or with blocks asleep by other rules, it begins afresh; so does a window's
    // instant.
    if (snapshot.rest_digest == rest_digest(scene) && !scene.restart_clock) start.state = snapshot;
    start.earlier_wires = std::move(snapshot.wires);
    begin_books(snapshot.memory, scene.restart_clock.has_value());
    restore(*start.simulation, snapshot);
    return start;
}

void calm_down(Start& start, const Scene& scene, double begin, common::Progress& progress) {
    if ((scene.wires.put_back.empty() && !scene.restart_calm) || !start.t) return;
    CalmRecord record;
    const auto let_settle = [&](Simulation& simulation, const std::string& when) {
        if (!scene.packing.settle) return;
        settle(simulation, scene.packing, when, [&](double t) { progress.update(begin + t, "settling"); });
        record.settling += simulation.time();
    };
    // The storm ends before the crane comes.
    const auto calm = in_still_water(scene, start.simulation->blocks, start.simulation->memory().pairs,
                                     *start.earlier_wires);
    let_settle(*calm, "settling before the run");
    date_breaks(calm->wires, *start.earlier_wires, begin);

    Blocks blocks = calm->blocks;
    const auto placed =
        put_back(blocks, calm->surroundings(), pressing_of(blocks, scene.material, scene.gravity.norm()),
                 scene.wires.put_back, start.packed);
    record.blocks = placed.size();
    std::tie(record.mean_placed, record.largest_placed) = distances(blocks, start.packed, placed);
    const Wires kept = kept_wires(blocks, scene, calm->wires);
    const auto settled = in_still_water(scene, blocks, contacts_without(calm->memory().pairs, placed), kept);
    if (!placed.empty()) let_settle(*settled, "settling after blocks were put back");
    date_breaks(settled->wires, kept, begin);
    std::tie(record.mean_settled, record.largest_settled) = distances(settled->blocks, start.packed, placed);

    // A fresh simulation, as after a packing: the run's time and its books of energy begin with all at rest.
    const double waves_reach_blocks = start.simulation->memory().waves_reach_blocks;
    start.simulation = build_simulation(scene, true);
    if (start.simulation->water() != nullptr)
        start.simulation->water()->waves_reach_blocks = waves_reach_blocks;
    take_over(*start.simulation, poses_of(settled->blocks), settled->memory().pairs);
    start.earlier_wires = settled->wires;
    start.state.reset();
    start.calm = record;
    if (scene.wires.put_back.empty())
        progress.say(fmt::format("blocks settled in {:.2f} s", record.settling));
    else
        progress.say(fmt::format(
            "{} blocks put back, {:.2g} mm from their packed places on average, {:.2g} mm at most; "
            "settling took {:.2f} s",
            record.blocks, 1e3 * record.mean_settled, 1e3 * record.largest_settled, record.settling));
}

}  // namespace dem
