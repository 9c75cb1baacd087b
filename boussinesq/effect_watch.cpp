#include "boussinesq/effect_watch.hpp"

#include <fmt/format.h>

#include <cmath>

#include "boussinesq/build_simulation.hpp"
#include "common/errors.hpp"

namespace boussinesq {
namespace {

/// Steps between looks at the fronts: at the Courant limit a wave moves that many cells, a fraction of a
/// length.
constexpr std::int64_t interval = 16;

/// Largest eta_t / sqrt(g h), and where (x, m).
struct FastestRise {
    double ratio, place;
};

/// Of the cells from `first` (padded) on.
FastestRise fastest_rise(const Simulation& simulation, std::size_t first) {
    const double* h = simulation.state().depth.data();
    const double* q = simulation.state().discharge.data();
    const double dry = 10.0 * simulation.flow().parameters().dry_depth,
                 half = 0.5 / simulation.grid().spacing;
    FastestRise front{0.0, 0.0};
    for (std::size_t k = first; k + 1 < ghost_cells + simulation.grid().cells; ++k) {
        if (h[k] <= dry) continue;
        const double ratio = (q[k - 1] - q[k + 1]) * half / std::sqrt(gravity * h[k]);
        if (ratio > front.ratio) front = {ratio, simulation.grid().centre(k - ghost_cells)};
    }
    return front;
}

}  // namespace

void EffectWatch::start_breaking(Simulation& simulation) {
    add_breaking(simulation, scene_);
    breaking_started_ = true;
}

std::optional<EffectChange> EffectWatch::look(Simulation& simulation) {
    if (!simulation.flow().terms().shoreline && simulation.shallowest() < shoreline_margin(scene_)) {
        if (!scene_.shoreline_is_automatic)
            throw common::RunError(
                fmt::format("t = {:.6g} s: the least depth fell to {:.3g} m and effects.shoreline is "
                            "\"off\"; use \"auto\" or \"on\"",
                            simulation.time(), simulation.shallowest()));
        FlowTerms terms = simulation.flow().terms();
        terms.shoreline = shoreline_started_ = true;
        simulation.flow().set_terms(terms);
        return EffectChange{
            "shoreline", fmt::format("t = {:.4g} s: the least depth fell to {:.3g} m: shoreline switched on",
                                     simulation.time(), simulation.shallowest())};
    }
    if (!simulation.flow().terms().dispersion || scene_.has_breaking || breaking_started_ || breaking_told_ ||
        simulation.steps() % interval != 0)
        return {};
    const FastestRise front = fastest_rise(simulation, first_breaking_cell(scene_));
    if (front.ratio <= scene_.breaking.start) return {};
    if (scene_.breaking_is_automatic) {
        start_breaking(simulation);
        return EffectChange{
            "breaking",
            fmt::format(
                "t = {:.4g} s: a front at x = {:.4g} m rises at {:.2f} sqrt(g h): breaking switched on",
                simulation.time(), front.place, front.ratio)};
    }
    breaking_told_ = true;
    return EffectChange{
        "",
        fmt::format("t = {:.4g} s: a front at x = {:.4g} m rises at {:.2f} sqrt(g h) and would break, but "
                    "effects.breaking is \"off\"",
                    simulation.time(), front.place, front.ratio)};
}

void EffectWatch::save(common::DataFile& state) const {
    state.attributes["shoreline_started"] = static_cast<std::int64_t>(shoreline_started_);
    state.attributes["breaking_started"] = static_cast<std::int64_t>(breaking_started_);
    state.attributes["breaking_told"] = static_cast<std::int64_t>(breaking_told_);
}

void EffectWatch::restore(Simulation& simulation, const common::DataFile& state) {
    breaking_told_ = state.integer("breaking_told") != 0;
    if (state.integer("breaking_started") != 0) start_breaking(simulation);
    if (state.integer("shoreline_started") != 0) {
        FlowTerms terms = simulation.flow().terms();
        terms.shoreline = shoreline_started_ = true;
        simulation.flow().set_terms(terms);
    }
}

}  // namespace boussinesq
