/// Effects that "auto" left out are watched for: when one turns out to be needed the run says so and switches
/// it on; where the user's word is "off" the run says so once, and stops where it cannot go on without.
#pragma once

#include <optional>
#include <string>

#include "boussinesq/scene.hpp"
#include "boussinesq/simulation.hpp"

namespace boussinesq {

struct EffectChange {
    std::string effect;   ///< switched on; empty: none, the user's word is "off"
    std::string message;  ///< in words
};

class EffectWatch {
 public:
    explicit EffectWatch(const Scene& scene) : scene_(scene) {}
    /// After a step. Returns what changed. Throws RunError where a cell dries and shoreline is
    /// "off".
    std::optional<EffectChange> look(Simulation& simulation);
    /// Switches on again what had been switched on before an interruption; call before Simulation::restore.
    void restore(Simulation& simulation, const common::DataFile& state);
    void save(common::DataFile& state) const;

 private:
    void start_breaking(Simulation& simulation);
    const Scene& scene_;
    bool shoreline_started_ = false, breaking_started_ = false, breaking_told_ = false;
};

}  // namespace boussinesq
