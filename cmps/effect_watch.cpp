#include "cmps/effect_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cmps/scene_geometry.hpp"

namespace cmps {
namespace {

constexpr double breaking = 0.85;  // of the celerity (Derakhti et al. 2020)

std::string note_name(std::size_t index) {
    return fmt::format("effect_watch.{}", index);
}

}  // namespace

EffectWatch::EffectWatch(const Scene& scene, const Solid& solid)
    : scene_(scene),
      crests_(scene.settings.spacing, highest_water(scene),
              scene.drive == Drive::piston ? scene.piston.period : scene.wave_period,
              -scene.settings.gravity_z),
      end_of_water_(end_of_water(scene, solid)),
      rear_(rear_of_structure(scene, solid)),
      watches_turbulence_(scene.drive != Drive::none && scene.settings.gravity_z < 0 &&
                          !scene.has_effect("turbulence")),
      watches_basin_(scene.crest_is_out_of_reach && !scene.has_effect("overtopping_basin")) {}

void EffectWatch::note(std::vector<EffectChange>& changes, EffectChange change) {
    notes_.push_back(change.message);
    if (!change.effect.empty()) switched_on_.push_back(change.effect);
    changes.push_back(std::move(change));
}

bool EffectWatch::passes_structure(const Particles& particles) const {
    const auto first = particles.x.begin() + static_cast<std::ptrdiff_t>(particles.first_fluid());
    return std::any_of(first, particles.x.end(), [&](double x) { return x > rear_; });
}

std::vector<EffectChange> EffectWatch::look(const NearField& field, double time, double wall) {
    std::vector<EffectChange> changes;
    if (watches_turbulence_) {
        const Crest crest = crests_.fastest(field.particles, wall, end_of_water_);
        if (crest.speed_over_celerity > breaking) {
            watches_turbulence_ = false;
            const std::string seen = fmt::format(
                "t = {:.4g} s: water at a crest at x = {:.4g} m moves at "
                "{:.2f} of its celerity",
                time, crest.x, crest.speed_over_celerity);
            if (scene_.turbulence_is_automatic)
                note(changes, {"turbulence", seen + ": turbulence switched on"});
            else
                note(changes, {"", seen + " and breaks, but effects.turbulence is \"off\""});
        }
    }
    if (watches_basin_ && passes_structure(field.particles)) {
        watches_basin_ = false;
        note(changes, {"overtopping_basin",
                       fmt::format("t = {:.4g} s: water comes over the structure at x = {:.4g} m: "
                                   "overtopping_basin switched on",
                                   time, rear_)});
    }
    return changes;
}

void EffectWatch::save(common::DataFile& state) const {
    std::string names;
    for (const std::string& name : switched_on_) names += name + " ";
    state.attributes["switched_on"] = names;
    state.attributes["watches_turbulence"] = static_cast<std::int64_t>(watches_turbulence_);
    state.attributes["watches_basin"] = static_cast<std::int64_t>(watches_basin_);
    state.attributes["effect_watch"] = static_cast<std::int64_t>(notes_.size());
    for (std::size_t i = 0; i < notes_.size(); ++i) state.attributes[note_name(i)] = notes_[i];
}

void EffectWatch::restore(const common::DataFile& state) {
    const std::string names = state.text("switched_on");
    switched_on_.clear(), notes_.clear();
    for (std::size_t from = 0, to; (to = names.find(' ', from)) != std::string::npos; from = to + 1)
        switched_on_.push_back(names.substr(from, to - from));
    watches_turbulence_ = state.integer("watches_turbulence") != 0;
    watches_basin_ = state.integer("watches_basin") != 0;
    const auto count = static_cast<std::size_t>(state.integer("effect_watch"));
    for (std::size_t i = 0; i < count; ++i) notes_.push_back(state.text(note_name(i)));
}

void EffectWatch::describe(common::RunRecord& record) const {
    for (std::size_t i = 0; i < notes_.size(); ++i) record.set_note(note_name(i), notes_[i]);
    std::vector<common::EffectRecord> effects = scene_.effects;
    for (auto& effect : effects)
        if (std::find(switched_on_.begin(), switched_on_.end(), effect.name) != switched_on_.end()) {
            effect.is_on = true;
            effect.reason += "; switched on while running (notes.effect_watch)";
        }
    record.set_effects(effects);
}

}  // namespace cmps
