/// One time step of the equations on the whole flume: SSP-RK3 (Shu and Osher 1988), third order in time, each
/// stage in two sweeps: tiles from both ends to the middle (fluxes, bed slope, dispersive system,
/// elimination), then back outward (dispersive acceleration). Stable for Courant numbers up to 1; positive
/// depth beside dry cells up to 0.5.
#pragma once

#include <memory>
#include <vector>

#include "boussinesq/dispersion.hpp"
#include "boussinesq/grid.hpp"
#include "boussinesq/wave_state.hpp"

namespace boussinesq {

/// Which optional parts of the right-hand side take part; chosen when the run starts.
struct FlowTerms {
    bool dispersion = true;  ///< off: shallow water
    bool shoreline = true;   ///< off: every cell stays wet
};

/// What a look over the state finds.
struct Survey {
    double fastest;     ///< largest |u| + sqrt(g h), m/s; not finite when any value is not
    double shallowest;  ///< smallest depth, m
};

/// Advances depth and discharge.
class FlowStep {
 public:
    FlowStep(const Grid& grid, Bed bed, const FlowParameters& flow, FlowTerms terms);

    /// state <- state after `step` seconds. `before` and `first_stage` are left for dense_output.
    void advance(WaveState& state, double step);

    /// State at the start of the last step, and that start plus step times its rates.
    const WaveState& before() const { return before_; }
    const WaveState& first_stage() const { return first_; }

    Survey survey(const WaveState& state) const;

    /// Water that rounding made where the depth came out below zero, m2 in total since the start.
    double water_made() const { return water_made_; }
    /// Water that came in through open ends, m2 in total since the start.
    double water_through_ends() const { return water_through_ends_; }
    void set_water(double made, double through_ends) {
        water_made_ = made, water_through_ends_ = through_ends;
    }

    /// Cells (padded, non-zero) whose flow is hydrostatic because they break, as they stand when a step
    /// begins. Kept by the caller.
    void set_bores(const std::vector<unsigned char>& bores) { bores_ = &bores; }
    const Bed& bed() const { return bed_; }
    FlowTerms terms() const { return terms_; }
    void set_terms(FlowTerms terms) { terms_ = terms; }
    const FlowParameters& parameters() const { return flow_; }

 private:
    /// out = start_share * start + stage_share * (in + step * rates(in))
    void stage(const WaveState& start, double start_share, WaveState& in, double stage_share, double step,
               WaveState& out);
    template <bool with_dispersion, bool with_shoreline>
    void stage_of(const WaveState& start, double start_share, WaveState& in, double stage_share, double step,
                  WaveState& out);
    template <bool with_dispersion, bool with_shoreline>
    void sweep_tile(Tile& tile, const WaveState& start, double start_share, const WaveState& in,
                    double stage_share, double step, WaveState& out);
    void fill_ghosts(WaveState& state) const;
    void mark_hydrostatic_cells();
    void mark_hydrostatic_tiles();

    Grid grid_;
    Bed bed_;
    FlowParameters flow_;
    FlowTerms terms_;
    WaveState before_, first_, second_;
    DispersionSystem system_;
    std::unique_ptr<Tile> left_tile_, right_tile_;
    std::vector<unsigned char> fixed_hydrostatic_;     ///< padded cells, non-zero: at bed steps and open ends
    std::vector<unsigned char> hydrostatic_;           ///< these and the bores
    std::vector<unsigned char> tile_has_hydrostatic_;  ///< tiles with such cells in them or beside them
    const std::vector<unsigned char>* bores_ = nullptr;
    double water_made_ = 0, water_through_ends_ = 0;
    double step_share_ = 0;  ///< of the stage in hand in the whole step: 1/6, 1/6, 2/3
};

}  // namespace boussinesq
