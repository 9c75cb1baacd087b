/// Whether what a state or a window of an earlier run holds goes together: a file may be whole and yet wrong.
#pragma once

#include "common/data_file.hpp"
#include "dem/snapshot.hpp"

namespace dem {

/// Throws common::InputError naming the dataset of a state.h5 that has other rows than there are blocks,
/// wires or contacts, or values that are no numbers.
void require_sound_datasets(const common::DataFile& file);

/// Throws common::InputError where orientations are none, or wires and contacts name blocks or spheres that
/// are not there. `placed`: the scene's blocks.
void require_sound(const Snapshot& snapshot, const Blocks& placed);

}  // namespace dem
