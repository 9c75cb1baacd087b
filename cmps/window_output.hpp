/// What a run records - flow grid, particles, forces, gauges - sampled within a window and handed over as
/// one.
#pragma once

#include <optional>
#include <vector>

#include "cmps/face_pressure.hpp"
#include "cmps/flow_grid.hpp"
#include "cmps/near_field.hpp"
#include "cmps/scene.hpp"
#include "cmps/solid.hpp"
#include "common/window.hpp"
#include "common/window_clock.hpp"

namespace cmps {

/// Between two samples of the forces on structures, s.
inline constexpr double force_interval = 0.02;

/// Samples of one quantity within a window.
struct Series {
    std::vector<double> due;  ///< sample times of this window, s
    std::size_t next = 0;
    std::vector<double> time;
    std::vector<float> values, more, third;
};

class WindowOutput {
 public:
    /// Gauges in [scene.offshore, x1] are recorded. `particles`: those of the start.
    WindowOutput(const Scene& scene, const Solid& solid, const Particles& particles, double x1);

    /// Forgets the last window's samples and notes when those of window `index` are due.
    void begin(const common::WindowClock& clock, std::int64_t index);
    /// The next instant at which something is due, at most `end`, s.
    double next_due(double end) const;
    /// Records what is due at `time`; `overtopped`: particles that were taken out behind the structure.
    void record(double time, const NearField& field, std::size_t overtopped);
    /// The window's datasets.
    common::Window take();

 private:
    void record_flow(const NearField& field);
    void record_particles(const Particles& particles);
    void record_gauge(const common::Gauge& gauge, const NearField& field, std::size_t overtopped,
                      Series& series);
    template <class Visit>
    void for_each_series(const Visit& visit);

    const Scene& scene_;
    const Solid& solid_;
    std::size_t initial_fluid_;
    common::Window window_;
    std::optional<FlowGrid> flow_;
    std::optional<FacePressure> faces_;
    std::vector<common::Gauge> gauges_;
    Series flow_series_, particle_series_, force_series_;
    std::vector<Series> gauge_series_;
};

/// geometry.h5: structure polygons and the solid's surface.
common::DataFile geometry_file(const Scene& scene, const Solid& solid);

}  // namespace cmps
