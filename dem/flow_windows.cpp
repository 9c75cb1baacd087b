#include "dem/flow_windows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/data_file.hpp"
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

FlowGrid flow_grid_of(const common::Window& window, const std::optional<UniformWater>& still,
                      const std::string& path) {
    FlowHistory history;
    history.time = window.at("/flow/time").as_double();
    history.x = window.at("/flow/x").as_double();
    history.z = window.at("/flow/z").as_double();
    const auto velocity = window.at("/flow/velocity").as_double();
    const auto acceleration = window.at("/flow/acceleration").as_double();
    const auto wet = window.at("/flow/wet").as_double();
    for (std::size_t i = 0; i < wet.size(); ++i)
        if (!(wet[i] >= 0 && wet[i] <= 1))
            throw common::InputError(
                fmt::format("{}: /flow/wet is {:.6g} at element {}; expected 0 to 1", path, wet[i], i));
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
        return FlowGrid(std::move(history), still);
    } catch (const std::invalid_argument& error) {
        throw common::InputError(fmt::format("{}: /flow/x, /flow/z: {}", path, error.what()));
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

namespace {

/// Highest point of the polygons at x, m; -infinity beside them.
double top_at(const std::vector<std::vector<double>>& polygons, double x) {
    double top = -std::numeric_limits<double>::infinity();
    for (const auto& points : polygons)
        for (std::size_t i = 0; i + 1 < points.size(); i += 2) {
            const std::size_t j = (i + 2) % points.size();
            const double x0 = points[i], z0 = points[i + 1], x1 = points[j], z1 = points[j + 1];
            if (x < std::min(x0, x1) || x > std::max(x0, x1) || x0 == x1) continue;
            top = std::max(top, z0 + (z1 - z0) * (x - x0) / (x1 - x0));
        }
    return top;
}

}  // namespace

void require_same_mound(const std::filesystem::path& folder, const MoundProfile& mound,
                        const Blocks& blocks) {
    const auto path = folder / "geometry.h5";
    if (mound.empty() || !std::filesystem::exists(path)) return;
    std::vector<std::vector<double>> polygons;
    for (const auto& [name, dataset] : common::read_data_file(path).datasets)
        if (name.starts_with("/structure/")) polygons.push_back(dataset.as_double());
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (blocks.is_fixed[i]) continue;
        const double x = blocks.position[i].x(), own = mean_height(mound, x), theirs = top_at(polygons, x);
        // Half a block's height: a mound drawn more finely here than in the near field is still the same
        // mound.
        if (std::isfinite(theirs) && std::abs(theirs - own) > 0.5 * blocks.shape_of(i).height)
            throw common::InputError(
                fmt::format("{}: the flow of another scene: at block {} (x = {:.3f} m) its structure reaches "
                            "z = {:.3f} m, "
                            "dem.mound.profile {:.3f} m",
                            path.string(), i + 1, x, theirs, own));
    }
}

}  // namespace dem
