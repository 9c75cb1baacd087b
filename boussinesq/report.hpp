/// What a run says about itself: run.json, invariants, wave statistics, run-up and the envelope.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "boussinesq/effect_watch.hpp"
#include "boussinesq/envelope.hpp"
#include "boussinesq/gauge_record.hpp"
#include "boussinesq/scene.hpp"
#include "boussinesq/simulation.hpp"
#include "common/data_file.hpp"
#include "common/run_record.hpp"

namespace boussinesq {

/// Gauges of the scene that this stage records; over a level bed each with two more points a tenth and a
/// quarter of a wave length on, so that reflected waves can be told apart.
std::vector<GaugeRecord> gauges_of(const Scene& scene);

/// geometry.h5: the bed.
common::DataFile geometry_of(const Scene& scene, const Simulation& simulation);

class Report {
 public:
    Report(const std::filesystem::path& folder, const common::SceneFile& file, const Scene& scene,
           const Simulation& simulation);

    /// After every step.
    void look();
    /// Something the user should know; also into run.json.
    void note(const EffectChange& change);
    void window_done(std::int64_t windows);
    void end(const std::string& status, const std::string& message, const std::vector<GaugeRecord>& gauges);
    /// One line for the terminal.
    std::string summary() const;

    /// Adds what this object carries to the state to go on from, and takes it back.
    void save(common::DataFile& state);
    void restore(const common::DataFile& state);

 private:
    void record_changes();
    void fill_figures();
    void fill_invariants();
    void fill_statistics(const std::vector<GaugeRecord>& gauges);
    const Scene& scene_;
    const Simulation& simulation_;
    std::filesystem::path folder_;
    common::RunRecord record_;
    Envelope envelope_;
    Waterline waterline_;
    double water_at_start_, energy_at_start_, largest_energy_;
    std::int64_t first_step_ = 0;
    std::vector<std::string> notes_;
    std::string switched_on_;  ///< effects, by name, with blanks between
};

}  // namespace boussinesq
