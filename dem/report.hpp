/// What the run says about itself: run.json.
#pragma once

#include <filesystem>
#include <map>

#include "common/run_record.hpp"
#include "dem/scene.hpp"
#include "dem/snapshot.hpp"
#include "dem/start.hpp"

namespace dem {

class Report {
 public:
    Report(const std::filesystem::path& folder, const common::SceneFile& file, const Scene& scene,
           const std::string& scene_digest, const std::string& input_digest);
    /// Keeps the scene that the flow was computed from.
    void describe_input(const std::filesystem::path& flow) { record_.describe_input(flow); }
    /// Later balances are held against the energies of now.
    void begin_books(const Simulation& simulation);
    /// Looks at the stability limit of the present contacts and at the energy budget (at every sample).
    /// Throws common::RunError when the step stays past the limit or the budget does not close: the run is
    /// unstable.
    void look(const Simulation& simulation);
    /// Figures and invariants at the end of a window.
    void window_done(const Simulation& simulation, const PackedPoses& packed, std::int64_t windows);
    /// Something the user may want to know, on the terminal and as a note in run.json.
    void say(const std::string& name, const std::string& message);
    /// Something the user must know, the same way; a run taken up again keeps it.
    void warn(const std::string& name, const std::string& message);
    /// How blocks came to rest before the run, and those put back.
    void began_calm(const CalmRecord& record);
    void end(const std::string& status, const std::string& message = {});
    /// Wall time of a phase: "packing", "flow", "steps", "output".
    void add_time(const std::string& phase, double seconds);
    /// What later reports depend on, kept in state.h5.
    void store(common::DataFile& state) const;
    void restore(const common::DataFile& state);

 private:
    void keep_warning(const std::string& name, const std::string& message);
    common::RunRecord record_;
    const Scene& scene_;
    std::optional<CalmRecord> calm_;
    std::map<std::string, std::string> warnings_;
    EnergyBudget first_energy_;
    double smallest_limit_, stepping_seconds_ = 0;
    int past_limit_ = 0;                   ///< samples in a row
    std::uint64_t first_block_steps_ = 0;  ///< of the run this one goes on from
};

/// Energy that changed hands since `first`: through contacts and water, into motion and back, and what was
/// stored to start with, J; at least `trifle`.
double exchanged_energy(const EnergyBudget& energy, const EnergyBudget& first, double trifle = 0);

/// Energy that rounding alone may give or take, J: a balance is not judged by it.
double trifling_energy(const Scene& scene, const EnergyBudget& energy);

/// Error of the energy balance over the energy exchanged; 0 where none was.
double closure_error(const EnergyBudget& energy, const EnergyBudget& first, double trifle = 0);

}  // namespace dem
