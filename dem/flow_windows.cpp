#include "dem/flow_windows.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"

namespace dem {

std::vector<common::ExpectedDataset> expected_flow() {
    return {{"/flow/time", "s", {"nt"}},
            {"/flow/x", "m", {"nx"}},
            {"/flow/z", "m", {"nz"}},
            {"/flow/velocity", "m/s", {"nt", "nz", "nx", "2"}},
            {"/flow/acceleration", "m/s2", {"nt", "nz", "nx", "2"}},
            {"/flow/wet", "-", {"nt", "nz", "nx"}}};
}

FlowGrid flow_grid_of(const common::Window& window, bool still_outside) {
    FlowHistory history;
    history.time = window.at("/flow/time").as_double();
    history.x = window.at("/flow/x").as_double();
    history.z = window.at("/flow/z").as_double();
    const auto velocity = window.at("/flow/velocity").as_double();
    const auto acceleration = window.at("/flow/acceleration").as_double();
    const auto wet = window.at("/flow/wet").as_double();
    history.values.resize(wet.size() * FlowGrid::fields);
    for (std::size_t i = 0; i < wet.size(); ++i) {
        float* out = history.values.data() + i * FlowGrid::fields;
        out[0] = static_cast<float>(velocity[2 * i]);
        out[1] = static_cast<float>(velocity[2 * i + 1]);
        out[2] = static_cast<float>(acceleration[2 * i]);
        out[3] = static_cast<float>(acceleration[2 * i + 1]);
        out[4] = static_cast<float>(wet[i]);
    }
    try {
        return FlowGrid(std::move(history), still_outside);
    } catch (const std::invalid_argument& error) {
        throw common::InputError(
            fmt::format("window {} of {}: /flow/x, /flow/z: {}", window.index, window.stage, error.what()));
    }
}

void require_cover(const FlowGrid& grid, const Blocks& blocks, const std::string& folder) {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (blocks.is_fixed[i]) continue;
        for (std::size_t k = 0; k < blocks.shape_of(i).spheres.size(); ++k) {
            const Vector centre = blocks.sphere_centre(i, k);
            if (grid.covers(centre.x(), centre.z())) continue;
            const auto& h = grid.history();
            throw common::InputError(fmt::format(
                "{}: the flow grid (x {} to {} m, z {} to {} m) does not cover block {} at x = {:.3f}, z = "
                "{:.3f} m; enlarge cmps.flow or set "
                "dem.flow_outside = \"still\"",
                folder, h.x.front(), h.x.back(), h.z.front(), h.z.back(), i + 1, centre.x(), centre.z()));
        }
    }
}

}  // namespace dem
