/// From a scene to blocks that are ready to move: simulation, packing, wires, restarts.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

#include "dem/scene.hpp"
#include "dem/snapshot.hpp"

namespace dem {

/// Blocks at their placed poses, with the water the scene gives (uniform, until a flow grid takes its place)
/// and, unless off, sleeping. No wires yet.
std::unique_ptr<Simulation> build_simulation(const Scene& scene, bool with_water);
/// The scene's blocks as packing begins, in still water: those that start with a velocity do not take part,
/// they are held where the scene places them until the run starts.
std::unique_ptr<Simulation> build_packing(const Scene& scene);
/// Blocks that were held are free, with the scene's velocity.
void throw_held(Blocks& blocks, const Scene& scene);

/// Lets the blocks settle in still water. `progress` is called now and then with the time.
/// Throws common::RunError, beginning with `when`, when they do not come to rest in time.
void settle(Simulation& simulation, const PackingRules& rules, const std::string& when,
            const std::function<void(double)>& progress);

/// Takes up settled poses and their contacts, at rest.
void take_over(Simulation& simulation, const PackedPoses& packed, const std::vector<TouchingPair>& contacts);

/// Mounts the layout. Wires that `earlier` (may be null) already has between the same spheres keep rest
/// length and damage, unless one of their blocks was put back; new ones take the present distance.
void mount_layout(Simulation& simulation, const Scene& scene, const Wires* earlier);

/// Throws common::InputError where a rest length that the layout gives is so short that its wire, mounted
/// where blocks stand now, would break at once. Not of wires that are kept from `earlier` (may be null).
/// `margin`: so much farther apart they may be, where blocks have yet to settle, m.
void require_holding_wires(const Blocks& blocks, const Scene& scene, const Wires* earlier, double margin = 0);

/// Throws common::InputError where the layout gives another rest length than a wire has that is kept.
void require_kept_rest_lengths(const Scene& scene, const Wires& earlier);

/// Of the layout, the wires that are kept from an earlier run.
Wires kept_wires(const Blocks& blocks, const Scene& scene, const Wires& earlier);

/// A state or a window of an earlier run (`dem.restart.time` chooses the instant of a window).
/// Throws common::InputError when it belongs to another scene.
Snapshot read_start(const std::filesystem::path& from, const Scene& scene);

/// Digest of the rules by which a block at rest stays at rest: material, contacts, weight, water, sleeping.
std::string rest_digest(const Scene& scene);

/// Puts poses, speeds and contacts of a snapshot into the simulation.
void restore(Simulation& simulation, const Snapshot& snapshot);

PackedPoses poses_of(const Blocks& blocks);

}  // namespace dem
