/// Collects the samples of one window while the simulation goes on.
#pragma once

#include <vector>

#include "boussinesq/gauge_record.hpp"
#include "boussinesq/simulation.hpp"
#include "common/window.hpp"
#include "common/window_clock.hpp"

namespace boussinesq {

/// Samples of the window in hand, and the gauges' whole records.
class WindowOutput {
 public:
    WindowOutput(const Simulation& simulation, const common::WindowClock& clock, double output_interval,
                 std::vector<GaugeRecord> gauges);

    /// Starts window `index`.
    void begin(std::int64_t index);
    /// Takes every sample the last step has reached.
    void collect();
    /// True once the sample at the window's end is there.
    bool is_complete() const { return next_ == times_.size(); }
    /// End of the window, s.
    double end() const { return times_.back(); }
    /// The finished window.
    common::Window take();

    std::vector<GaugeRecord>& gauges() { return gauges_; }
    const std::vector<GaugeRecord>& gauges() const { return gauges_; }

 private:
    const Simulation& simulation_;
    const common::WindowClock& clock_;
    double interval_;
    std::vector<GaugeRecord> gauges_;
    std::int64_t index_ = 0;
    std::vector<double> times_;
    std::size_t next_ = 0;
    std::vector<std::vector<double>> gauge_times_;
    std::vector<std::size_t> gauge_next_;
    std::vector<float> elevation_, velocity_;
    Sample sample_;
};

}  // namespace boussinesq
