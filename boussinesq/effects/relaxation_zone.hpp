/// Zones at the ends of the flume that make waves and take them in.
///
/// Once a step, value <- (value + sigma dt target) / (1 + sigma dt): unconditionally stable, first order in
/// time, and its strength does not depend on the step. sigma rises with the cube of the distance into the
/// zone.
#pragma once

#include <memory>

#include "boussinesq/effects/step_effect.hpp"
#include "boussinesq/waves/incident_wave.hpp"

namespace boussinesq {

/// Cells [first, first + rate.size()) and how fast each gives way, 1/s.
struct ZoneRates {
    std::size_t first = 0;
    std::vector<double> rate;
};
/// Rates that rise from 0 at x = inner to `largest` at x = outer (the flume's end), either way round.
ZoneRates cubic_rates(const Grid& grid, double inner, double outer, double largest);

/// Draws elevation and velocity towards the incident wave: makes it, and takes in what comes back from the
/// structure. The amplitude rises over `ramp` seconds.
class GenerationZone : public StepEffect {
 public:
    GenerationZone(const Grid& grid, const Bed& bed, ZoneRates rates, std::unique_ptr<IncidentWave> wave,
                   double ramp);
    std::string name() const override { return "wave generation"; }
    void apply(WaveState& state, double t, double step) override;
    std::vector<double> memory() const override { return {water_added_}; }
    void recall(const std::vector<double>& values) override { water_added_ = values.at(0); }
    /// Water the zone has added since the start, m2.
    double water_added() const { return water_added_; }

 private:
    ZoneRates rates_;
    std::unique_ptr<IncidentWave> wave_;
    double ramp_, spacing_;
    double water_added_ = 0;
    std::vector<double> x_, bed_, elevation_, velocity_;
};

/// Takes waves in by damping their momentum only: no water is added or lost, so the mean level of the flume
/// is kept.
class Sponge : public StepEffect {
 public:
    explicit Sponge(ZoneRates rates) : rates_(std::move(rates)) {}
    std::string name() const override { return "sponge"; }
    void apply(WaveState& state, double t, double step) override;

 private:
    ZoneRates rates_;
};

}  // namespace boussinesq
