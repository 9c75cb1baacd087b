/// The near field's windows as water motion.
#pragma once

#include <filesystem>
#include <vector>

#include "common/window.hpp"
#include "common/window_channel.hpp"
#include "dem/blocks.hpp"
#include "dem/mound.hpp"
#include "dem/water_motion.hpp"

namespace dem {

/// What this stage needs to find in a window of cmps.
std::vector<common::ExpectedDataset> expected_flow();

/// The flow grid of one window, with the water outside it where that is known. Throws common::InputError
/// naming `path` and the dataset (axes not uniform, too few samples, wet fractions outside 0 to 1).
FlowGrid flow_grid_of(const common::Window& window, const std::optional<UniformWater>& still,
                      const std::string& path);

/// Throws common::InputError unless the grid covers every sphere of every block that can move.
void require_cover(const FlowGrid& grid, const Blocks& blocks, const std::string& folder);

/// Throws InputError when the structure of the near field (geometry.h5 of its folder, where there is one) and
/// the mound of this scene differ under a block that is free to move: then the flow is that of another scene.
/// `mound`: mean profile [x, z], may be empty.
void require_same_mound(const std::filesystem::path& folder, const MoundProfile& mound, const Blocks& blocks);

}  // namespace dem
