#include "dem/sound_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/errors.hpp"

namespace dem {

namespace {

void require_finite(const std::string& name, const common::Dataset& dataset) {
    const auto* values = std::get_if<std::vector<double>>(&dataset.values);
    if (values == nullptr) return;
    const auto bad = std::find_if(values->begin(), values->end(), [](double v) { return !std::isfinite(v); });
    if (bad != values->end())
        throw common::InputError(
            fmt::format("dataset {} is not finite at element {}", name, bad - values->begin()));
}

/// Datasets of a group that have another first extent than `rows`.
void require_rows(const common::DataFile& file, const std::string& group, std::size_t rows) {
    for (const auto& [name, dataset] : file.datasets)
        if (name.starts_with(group) && (dataset.shape.empty() || dataset.shape[0] != rows))
            throw common::InputError(fmt::format("dataset {} has {} rows, expected {}", name,
                                                 dataset.shape.empty() ? 0 : dataset.shape[0], rows));
}

void require_sphere(const Blocks& placed, std::uint32_t block, std::uint32_t sphere, const char* what) {
    if (block >= placed.size() || sphere >= placed.shape_of(block).spheres.size())
        throw common::InputError(
            fmt::format("{} name sphere {} of block {}, which is not there", what, sphere, block));
}

void require_turns(const std::vector<Quaternion>& orientations, const char* dataset) {
    constexpr double rounding = 1e-6;  // far above that of a quaternion carried along, far below a wrong one
    for (std::size_t i = 0; i < orientations.size(); ++i)
        if (!(std::abs(orientations[i].norm() - 1) < rounding))
            throw common::InputError(fmt::format("dataset {} is no unit quaternion at block {}", dataset, i));
}

}  // namespace

void require_sound_datasets(const common::DataFile& file) {
    const std::size_t blocks = file.at("/blocks/shape").size();
    for (const char* group : {"/blocks/", "/packed/", "/sleeping/"}) require_rows(file, group, blocks);
    require_rows(file, "/wires/", file.at("/wires/rest_length").size());
    for (const auto& [name, dataset] : file.datasets) require_finite(name, dataset);
}

void require_sound(const Snapshot& snapshot, const Blocks& placed) {
    if (snapshot.blocks.size() != placed.size())
        throw common::InputError(
            fmt::format("it holds {} blocks, the scene {}", snapshot.blocks.size(), placed.size()));
    require_turns(snapshot.blocks.orientation, "/blocks/orientation");
    require_turns(snapshot.packed.orientation, "/packed/orientation");
    const Wires& wires = snapshot.wires;
    for (std::size_t k = 0; k < wires.size(); ++k) {
        require_sphere(placed, wires.block_a[k], wires.sphere_a[k], "wires");
        require_sphere(placed, wires.block_b[k], wires.sphere_b[k], "wires");
    }
    for (const auto& pair : snapshot.memory.pairs)
        for (const auto& contact : pair.contacts) {
            require_sphere(placed, pair.block, contact.a, "contacts");
            if (pair.partner < placed.size()) require_sphere(placed, pair.partner, contact.b, "contacts");
        }
}

}  // namespace dem
