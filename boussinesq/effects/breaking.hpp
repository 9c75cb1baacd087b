/// Wave breaking.
///
/// A front breaks where the surface rises faster than a threshold, eta_t > s sqrt(g h). Ways to take the
/// energy out:
///
/// - EddyViscosity (Kennedy, Chen, Kirby and Dalrymple 2000): (h u)_t = ... + (nu h u_x)_x with
///   nu = B mixing^2 h eta_t, B = clamp(eta_t / eta_t* - 1, 0, 1); eta_t* falls from `start` to `end` times
///   sqrt(g h) over 5 sqrt(h/g), counted from when that front began to break (the age travels with the
///   front). Solved implicitly: first order in time, stable for any step; conserves water and momentum.
///   With `becomes_bore` a front that has broken for that long, or stands steeper than 30 degrees (Tissier et
///   al. 2012), runs on as a shallow-water bore: by then viscosity has smoothed it, so that the change does
///   not disturb the waves around it, and a bore loses what its jump asks for, which viscosity in a
///   dispersive front does not reach (README).
/// - HydrostaticBores (Tonelli and Petti 2009, Tissier et al. 2012): the front runs as a bore, without
///   dispersion, from eta_t > 0.6 sqrt(g h) until below 0.3.
///
/// Either bore ends where its Froude number falls below 1.3 (Tissier et al. 2012), the depth behind it below
/// 1.4 times the depth ahead: from there on waves are undular and do not break.
#pragma once

#include <cstddef>
#include <utility>
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
    double mixing = 1.2;      ///< mixing length over depth
    bool becomes_bore = true;
};

/// Cells in which the flow is hydrostatic because fronts run through them as bores.
class BoreCells {
 public:
    BoreCells(const Grid& grid, Bed bed)
        : spacing_(grid.spacing), bed_(std::move(bed)), cells_(grid.padded(), 0) {}
    void clear();
    /// The whole width of a front at cell k (padded) in water of depth h: a depth to both sides.
    void add(std::size_t k, double h);
    /// Whether the surface stands steeper around cell k than a front that has not broken.
    bool is_steep(const WaveState& state, std::size_t k) const;
    /// Whether the front through cell k is high enough to be a bore.
    bool sustains(const WaveState& state, std::size_t k) const;
    /// Padded; non-zero: hydrostatic.
    const std::vector<unsigned char>& cells() const { return cells_; }
    bool contains(std::size_t k) const { return cells_[k] != 0; }
    void save(std::vector<double>& memory) const;
    void restore(const double* memory);

 private:
    double spacing_;
    Bed bed_;
    std::vector<unsigned char> cells_;
};

class EddyViscosity : public StepEffect {
 public:
    /// Waves break in cells from `first` (padded) on: where they are made they are drawn to the incident
    /// wave.
    EddyViscosity(const Grid& grid, const Bed& bed, const FlowParameters& flow, std::size_t first,
                  EddyViscosityConstants constants);
    std::string name() const override { return "breaking"; }
    void apply(WaveState& state, double t, double step) override;
    std::vector<double> memory() const override;
    void recall(const std::vector<double>& values) override;
    const BreakingRecord& record() const { return record_; }
    const BoreCells& bores() const { return bores_; }

 private:
    void find_fronts(const WaveState& state, double t, double step);
    void diffuse(WaveState& state, double step, std::size_t first, std::size_t last);
    Grid grid_;
    double dry_depth_;
    std::size_t first_;
    EddyViscosityConstants constants_;
    BreakingRecord record_;
    std::vector<double> age_, viscosity_;  ///< padded; s, m2/s
    std::vector<double> new_age_;          ///< padded, s; room for the elimination between steps
    BoreCells bores_;
    bool any_ = false;
};

class HydrostaticBores : public StepEffect {
 public:
    HydrostaticBores(const Grid& grid, const Bed& bed, const FlowParameters& flow, std::size_t first);
    std::string name() const override { return "breaking"; }
    void apply(WaveState& state, double t, double step) override;
    std::vector<double> memory() const override;
    void recall(const std::vector<double>& values) override;
    const BreakingRecord& record() const { return record_; }
    const BoreCells& bores() const { return bores_; }

 private:
    Grid grid_;
    double dry_depth_;
    std::size_t first_;
    BreakingRecord record_;
    BoreCells bores_;
    std::vector<std::size_t> fronts_;  ///< padded cells
};

}  // namespace boussinesq
