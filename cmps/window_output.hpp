/// What a run records - flow grid, particles, forces, gauges - sampled within a window and handed over as
/// one. Steps take no notice of it: a sample is found on the line between the two steps around its time.
#pragma once

#include <optional>
#include <vector>

#include "cmps/face_pressure.hpp"
#include "cmps/flow_grid.hpp"
#include "cmps/near_field.hpp"
#include "cmps/running_mean.hpp"
#include "cmps/scene.hpp"
#include "cmps/series.hpp"
#include "cmps/solid.hpp"
#include "common/window.hpp"
#include "common/window_clock.hpp"

namespace cmps {

/// Between two samples of the forces on structures, s.
inline constexpr double force_interval = 0.02;

class WindowOutput {
 public:
    /// `particles`: those of the start.
    WindowOutput(const Scene& scene, const Solid& solid, const Particles& particles);

    /// Forgets the last window's samples, notes when those of window `index` are due, and takes those that
    /// the last step has passed already.
    void begin(const common::WindowClock& clock, std::int64_t index);
    /// True once the samples at the window's end are there.
    bool is_complete() const;
    /// Before a step from `time` to `next`: reads what has samples due within it. `overtopped`: particles
    /// that were taken out behind the structure.
    void before_step(double time, double next, const NearField& field, std::size_t overtopped);
    /// After a step of `step` s: takes its pressures into their running means.
    void add_step(double step, const NearField& field);
    /// After a step to `time`: reads again, and takes the samples that the step has passed.
    void after_step(double time, const NearField& field, std::size_t overtopped);
    /// The window's datasets.
    common::Window take();

    /// Running means, to go on bit for bit.
    std::vector<double> state() const { return pressures_.state(); }
    void restore(const std::vector<double>& state) { pressures_.restore(state); }

 private:
    void read_flow(const NearField& field, Reading& reading);
    void read_particles(const Particles& particles, Reading& reading) const;
    void read_forces(Reading& reading) const;
    void read_gauge(std::size_t index, const NearField& field, std::size_t overtopped,
                    Reading& reading) const;
    void sample_particles(double share);
    template <class Visit>
    void for_each_series(const Visit& visit);
    void read(const Series& series, const NearField& field, std::size_t overtopped, double time,
              Reading& reading);
    bool is_pressure(const Series& series) const;
    void take_samples(Series& series);

    const Scene& scene_;
    const Solid& solid_;
    std::size_t initial_fluid_;
    common::Window window_;
    std::optional<FlowGrid> flow_;
    WaterMotion motion_;
    std::optional<FacePressure> faces_;
    std::vector<common::Gauge> gauges_;
    std::vector<FacePressure::Sensor> sensors_;  // per gauge; empty unless it reads the pressure on a face
    RunningMean pressures_;                      // one channel a gauge, then two a structure: its force
    std::vector<std::size_t> beyond_at_start_;   // per gauge, particles that stood behind it at the start
    Series flow_series_, particle_series_, force_series_;
    // of the particles' pictures: places far from the origin do not fit into single precision, m
    std::vector<double> positions_;
    std::vector<Series> gauge_series_;
};

/// geometry.h5: structure polygons and the solid's surface.
common::DataFile geometry_file(const Scene& scene, const Solid& solid);

}  // namespace cmps
