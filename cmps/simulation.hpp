/// A near field built from a scene, and what it records: samples, windows, state.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cmps/effects/containment.hpp"
#include "cmps/effects/moving_wall.hpp"
#include "cmps/effects/overtopping_basin.hpp"
#include "cmps/effects/wall_overflow.hpp"
#include "cmps/flow_grid.hpp"
#include "cmps/near_field.hpp"
#include "cmps/scene.hpp"
#include "cmps/wave_field.hpp"
#include "common/run_record.hpp"
#include "common/window.hpp"
#include "common/window_clock.hpp"

namespace cmps {

/// Samples of one quantity within a window.
struct Series {
    std::vector<double> due;  ///< sample times of this window, s
    std::size_t next = 0;
    std::vector<double> time;
    std::vector<float> values, more;
    std::vector<float> third;
};

class Simulation {
 public:
    /// `waves`: present when the scene is driven by waves; must outlive this.
    Simulation(const Scene& scene, WaveField* waves, double start);

    /// Advances to `end`, recording what is due.
    common::Window advance_window(const common::WindowClock& clock, std::int64_t index,
                                  const std::function<void(double)>& on_step);

    common::DataFile state() const;
    void restore(const common::DataFile& state);
    common::DataFile geometry() const;
    void describe(common::RunRecord& record) const;

    NearField& field() { return *field_; }
    const NearField& field() const { return *field_; }
    double time() const { return time_; }

 private:
    void compose_effects(double start);
    void record_due(double time);
    void record_flow(Series& series);
    void record_particles(Series& series);
    void record_gauge(const common::Gauge& gauge, Series& series);
    void record_invariants();
    double energy() const;

    Scene scene_;
    Solid solid_;
    WaveField* waves_;
    std::unique_ptr<NearField> field_;
    std::optional<FlowGrid> flow_;
    Containment* containment_ = nullptr;  // owned by field_->effects
    MovingWall* wall_ = nullptr;          // owned by field_->effects
    OvertoppingBasin* basin_ = nullptr;   // owned by field_->effects
    WallOverflow* overflow_ = nullptr;    // owned by field_->effects
    double time_ = 0, start_ = 0;
    std::size_t initial_fluid_ = 0;
    double initial_volume_ = 0, largest_volume_drift_ = 0, volume_drift_ = 0;
    double initial_energy_ = 0, energy_gain_ = 0, largest_energy_gain_ = 0;
    std::size_t in_solid_ = 0;
    std::vector<common::Gauge> gauges_;

    Series flow_series_, particle_series_, force_series_;
    std::vector<Series> gauge_series_;
};

/// Particles over the scene's geometry at the start; surface and velocity from the waves when they are given.
Particles initial_particles(const Scene& scene, const Solid& solid, WaveField* waves);

}  // namespace cmps
