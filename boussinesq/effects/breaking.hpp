/// Wave breaking.
///
/// A front breaks where the surface rises faster than a threshold, eta_t > s sqrt(g h). Two ways to take the
/// energy out:
///
/// - EddyViscosity (Kennedy, Chen, Kirby and Dalrymple 2000): (h u)_t = ... + (nu h u_x)_x with
///   nu = B mixing^2 h eta_t, B = clamp(eta_t / eta_t* - 1, 0, 1); eta_t* falls from `start` to `end` times
///   sqrt(g h) over 5 sqrt(h/g), counted from when that front began to break (the age travels with the
///   front). Solved implicitly: first order in time, stable for any step; conserves water and momentum.
/// - HydrostaticBores (Tonelli and Petti 2009, Tissier et al. 2012): the front runs as a shallow-water bore,
/// without
///   dispersion, from eta_t > 0.6 sqrt(g h) until below 0.3.
#pragma once

#include <cstddef>
#include <vector>

#include "boussinesq/effects/step_effect.hpp"
#include "boussinesq/flow_step.hpp"

namespace boussinesq {

/// What a breaking model reports, both kinds.
struct BreakingRecord {
    double first_time = -1;    ///< s; negative: nothing broke
    double first_place = 0;    ///< x of the first breaking, m
    double most_offshore = 0;  ///< smallest x that ever broke, m
};

struct EddyViscosityConstants {
    double start = 0.45;      ///< eta_t over sqrt(g h) at which a front begins to break
    double end = 0.10;        ///< and below which an old one stops
    double transition = 5.0;  ///< of sqrt(h/g)
    double mixing = 2.0;      ///< mixing length over depth; Kennedy et al. 1.2 for (nu (h u)_x)_x (README)
};

class EddyViscosity : public StepEffect {
 public:
    EddyViscosity(const Grid& grid, const FlowParameters& flow, EddyViscosityConstants constants);
    std::string name() const override { return "breaking"; }
    void apply(WaveState& state, double t, double step) override;
    std::vector<double> memory() const override;
    void recall(const std::vector<double>& values) override;
    const BreakingRecord& record() const { return record_; }

 private:
    void find_fronts(const WaveState& state, double t, double step);
    void diffuse(WaveState& state, double step, std::size_t first, std::size_t last);
    Grid grid_;
    double dry_depth_;
    EddyViscosityConstants constants_;
    BreakingRecord record_;
    std::vector<double> age_, new_age_, viscosity_;  ///< padded; s, s, m2/s
    std::vector<double> ratio_, value_;
    bool any_ = false;
};

class HydrostaticBores : public StepEffect {
 public:
    HydrostaticBores(const Grid& grid, const FlowParameters& flow);
    std::string name() const override { return "breaking"; }
    void apply(WaveState& state, double t, double step) override;
    std::vector<double> memory() const override;
    void recall(const std::vector<double>& values) override;
    const BreakingRecord& record() const { return record_; }
    /// Padded; non-zero where the flow is hydrostatic.
    const unsigned char* bores() const { return bores_.data(); }

 private:
    Grid grid_;
    double dry_depth_;
    BreakingRecord record_;
    std::vector<unsigned char> bores_, fronts_;
};

}  // namespace boussinesq
