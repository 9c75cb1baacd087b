/// All that a run needs to go on bit for bit, as a file: state.h5.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "common/data_file.hpp"
#include "dem/step.hpp"

namespace dem {

/// Where blocks stood when packing ended: displacements and rest lengths are measured from here.
struct PackedPoses {
    std::vector<Vector> position;
    std::vector<Quaternion> orientation;
};

struct Snapshot {
    double t = 0;
    bool is_packing = false;       ///< written by `dem pack`: nothing but weight has acted yet
    std::string placement_digest;  ///< of shapes, places, mound and walls: states of other scenes are refused
    std::string rest_digest{};  ///< of what lets a sleeper lie: with other rules it is woken; of a state only
    Blocks blocks;              ///< without shapes
    PackedPoses packed;
    Wires wires;
    Simulation::Memory memory{};
    std::string
        without_springs{};  ///< why contacts come without their tangential springs; empty: they do not
};

/// Digest of shapes, placed blocks, fixed spheres and planes.
std::string placement_digest(const Blocks& placed, const Surroundings& surroundings);

/// Everything about a running simulation.
Snapshot take_snapshot(const Simulation& simulation, const PackedPoses& packed, const std::string& placement);
common::DataFile to_data_file(const Snapshot& snapshot);
/// Throws common::InputError naming the dataset at fault. `blocks` of the result carry no shapes: give them
/// those of the scene.
Snapshot snapshot_from(const common::DataFile& file);

/// Contacts and their tangential springs, as datasets of a window: /contacts/bodies (block, partner, image,
/// contacts of the pair), /contacts/spheres (of the two bodies), /contacts/springs (normal stiffness, N/m,
/// and tangential force, N, of each contact).
void store_contacts(const std::vector<TouchingPair>& pairs, std::map<std::string, common::Dataset>& datasets);
/// The same back. `sums`: forces of the pairs, or null. Throws common::InputError when they do not agree.
std::vector<TouchingPair> contacts_from(const common::Dataset& bodies, const common::Dataset& spheres,
                                        const common::Dataset& springs, const common::Dataset* sums);

/// Rows of three (or w, x, y, z) for files.
std::vector<double> flat(const std::vector<Vector>& vectors);
std::vector<double> flat(const std::vector<Quaternion>& quaternions);
std::vector<Vector> vectors_from(const common::Dataset& dataset);
std::vector<Quaternion> quaternions_from(const common::Dataset& dataset);

}  // namespace dem
