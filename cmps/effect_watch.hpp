/// Effects that "auto" left out are watched for: when one turns out to be needed the run says so and switches
/// it on; where the user's word is "off" the run says so once.
///
/// Watched: turbulence (a crest breaks after all) and overtopping_basin (water comes over a crest that was
/// out of reach). Nothing that happens in a run can call for the others: viscosity and start follow from the
/// scene alone, and relaxation_zone, absorption and wall_overflow are off by the user's word.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cmps/crest_speed.hpp"
#include "cmps/near_field.hpp"
#include "cmps/scene.hpp"
#include "cmps/solid.hpp"
#include "common/data_file.hpp"
#include "common/run_record.hpp"

namespace cmps {

struct EffectChange {
    std::string effect;   ///< to be switched on; empty: none, the user's word is "off"
    std::string message;  ///< in words
};

class EffectWatch {
 public:
    /// Steps between looks: at the Courant limit a wave moves that many times 0.4 l0, half a depth at most.
    static constexpr std::size_t interval = 20;

    EffectWatch(const Scene& scene, const Solid& solid);
    /// Looks at the water at `time` (s), the offshore wall at `wall` (m). Returns what turns out to be
    /// needed.
    std::vector<EffectChange> look(const NearField& field, double time, double wall);

    /// Effects switched on so far, in that order: to be added again before a state is restored.
    const std::vector<std::string>& switched_on() const { return switched_on_; }
    void save(common::DataFile& state) const;
    void restore(const common::DataFile& state);
    /// Notes and effects of run.json.
    void describe(common::RunRecord& record) const;

 private:
    void note(std::vector<EffectChange>& changes, EffectChange change);
    bool passes_structure(const Particles& particles) const;
    const Scene& scene_;
    CrestSpeed crests_;
    double end_of_water_, rear_;  // m
    bool watches_turbulence_, watches_basin_;
    std::vector<std::string> notes_, switched_on_;
};

}  // namespace cmps
