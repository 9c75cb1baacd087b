/// How a run begins: from a packing of its own, a stored one, or an instant of an earlier run with changes.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>

#include "common/progress.hpp"
#include "dem/scene.hpp"
#include "dem/snapshot.hpp"

namespace dem {

/// What went before a run that goes on in calm water; distances from packed places, m.
struct CalmRecord {
    std::size_t blocks = 0;                        ///< put back: those chosen that had left their packed pose
    double mean_placed = 0, largest_placed = 0;    ///< where they were set down
    double mean_settled = 0, largest_settled = 0;  ///< where they stand when the run starts
    double settling = 0;                           ///< s of simulated time, before and after
};

/// Blocks ready to go, where their displacement is measured from, and when the run starts.
struct Start {
    std::unique_ptr<Simulation> simulation;
    PackedPoses packed;
    std::optional<double> t{};             ///< of an earlier run; a packing has none
    std::optional<Wires> earlier_wires{};  ///< those of an earlier run
    std::optional<Snapshot> state{};   ///< of an earlier run, when this one may go on from it as it stands
    std::optional<CalmRecord> calm{};  ///< when blocks have settled, and some may have been put back
    std::string
        without_springs{};  ///< why contacts begin without their tangential springs; empty: they do not
};

/// Packs the scene.
Start packed_start(const Scene& scene, common::Progress& progress);

/// Takes up a stored packing or an instant of an earlier run. Throws common::InputError.
Start start_from(const std::filesystem::path& from, const Scene& scene);

/// Where the scene asks for a calm start, or the layout puts blocks back: outside the run's time and energy
/// all settle in still water as in a packing (a wave may have held blocks up, or pressed them into a gap),
/// the blocks are put back, and all settle again. The earlier run's wires hold meanwhile; from the putting
/// back on those between blocks that are left alone and that the layout keeps. `begin`: when the run starts,
/// s. Nothing after a packing. Throws common::RunError when the blocks do not come to rest, or one does not
/// fit.
void calm_down(Start& start, const Scene& scene, double begin, common::Progress& progress);

}  // namespace dem
