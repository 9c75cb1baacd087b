/// An optional term that acts once a step, after the flow has moved. The list of them is built once, when the
/// run starts: a term that is off is not in the list, has no arrays and costs nothing.
#pragma once

#include <string>
#include <vector>

#include "boussinesq/wave_state.hpp"

namespace boussinesq {

class StepEffect {
 public:
    virtual ~StepEffect() = default;
    /// Name as in [effects] or of the zone; also the name of its time in run.json.
    virtual std::string name() const = 0;
    /// Changes `state` (at time t, s) by the term over the last `step` seconds.
    virtual void apply(WaveState& state, double t, double step) = 0;
    /// What the term carries from step to step, for going on after an interruption.
    virtual std::vector<double> memory() const { return {}; }
    virtual void recall(const std::vector<double>&) {}
};

}  // namespace boussinesq
