/// What a run says about itself: run.json, invariants, wave statistics, run-up, the envelope, and `check`.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "boussinesq/gauge_record.hpp"
#include "boussinesq/scene.hpp"
#include "boussinesq/simulation.hpp"
#include "common/data_file.hpp"
#include "common/run_record.hpp"

namespace boussinesq {

/// Gauges of the scene that this stage records.
std::vector<GaugeRecord> gauges_of(const Scene& scene);

/// geometry.h5: the bed.
common::DataFile geometry_of(const Scene& scene, const Simulation& simulation);

/// Prints effects with reasons and the forecast; with `all` also the scene with every default filled in.
void print_check(const common::SceneFile& file, const Scene& scene, bool all);

class Report {
 public:
    Report(const std::filesystem::path& folder, const common::SceneFile& file, const Scene& scene,
           const Simulation& simulation);

    /// After every step.
    void look();
    void window_done(std::int64_t windows, const std::vector<GaugeRecord>& gauges);
    void end(const std::string& status, const std::string& message, const std::vector<GaugeRecord>& gauges);
    /// One line for the terminal.
    std::string summary() const;

    /// Adds what this object carries to the state to go on from, and takes it back.
    common::DataFile save(common::DataFile state) const;
    void restore(const common::DataFile& state);

 private:
    void fill(const std::vector<GaugeRecord>& gauges);
    const Scene& scene_;
    const Simulation& simulation_;
    common::RunRecord record_;
    double water_at_start_, energy_at_start_;
    std::int64_t first_step_ = 0;
};

}  // namespace boussinesq
