/// The waves over one flume in time: steps of its own size, samples at any time in between.
///
/// Steps do not land on sample times: values between two steps come from a parabola through both states with
/// the rates at the first (third-order local error). So the solution does not depend on windows or sampling,
/// bit for bit.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "boussinesq/effects/step_effect.hpp"
#include "boussinesq/flow_step.hpp"
#include "boussinesq/grid.hpp"
#include "common/data_file.hpp"

namespace boussinesq {

/// Surface elevation (bed level where dry, m) and depth-averaged velocity (m/s) of every cell.
struct Sample {
    std::vector<double> elevation, velocity;
};

/// Wall time spent, s.
struct PhaseTimes {
    double flow = 0;
    std::vector<double> effects;
};

class Simulation {
 public:
    Simulation(const Grid& grid, Bed bed, const FlowParameters& flow, FlowTerms terms, double courant,
               WaveState initial, std::vector<std::unique_ptr<StepEffect>> effects);

    /// Start and end of the last step, s. Equal before the first.
    double begun() const { return begun_; }
    double time() const { return time_; }
    std::int64_t steps() const { return steps_; }

    /// Length of the step that would follow, s. Throws RunError when the state is no longer sane.
    double next_step();
    /// Takes it.
    void advance();

    /// State at t, begun() <= t <= time(). Valid until the next advance().
    void sample(double t, Sample& sample) const;
    /// Elevation and velocity at x at the same time: cubic through four cells, nearest beside dry cells.
    struct Point {
        double elevation, velocity;
    };
    Point sample_at(double t, double x) const;

    /// Everything needed to take the next step again, from before it is taken.
    common::DataFile save() const;
    void restore(const common::DataFile& saved);

    const Grid& grid() const { return grid_; }
    const Bed& bed() const { return flow_.bed(); }
    const WaveState& state() const { return state_; }
    FlowStep& flow() { return flow_; }
    const FlowStep& flow() const { return flow_; }
    const std::vector<std::unique_ptr<StepEffect>>& effects() const { return effects_; }
    void add_effect(std::unique_ptr<StepEffect> effect);
    /// Least depth at the start of the last step, m.
    double shallowest() const { return shallowest_; }
    const PhaseTimes& times() const { return times_; }

    double water() const;   ///< area of water in the flume, m2
    double energy() const;  ///< potential and kinetic over density, m4/s2, still water as zero
    double largest_courant() const { return largest_courant_; }

 private:
    Grid grid_;
    FlowStep flow_;
    double courant_;
    WaveState state_;
    std::vector<std::unique_ptr<StepEffect>> effects_;
    double begun_ = 0, time_ = 0, step_ = 0;
    std::int64_t steps_ = 0;
    double fastest_allowed_ = 0, largest_courant_ = 0, shallowest_ = 1e30;
    PhaseTimes times_;

    Point cell_at(double share, std::size_t cell) const;
};

}  // namespace boussinesq
