/// A run's output folder: who may write, whether to start, go on or do nothing, and the state to go on from.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/data_file.hpp"
#include "common/folder_lock.hpp"
#include "common/window.hpp"

namespace common {

/// Names the run that writes into a folder.
struct RunIdentity {
    std::string stage, scene_digest, input_digest;
};

/// Opens DIR for one run at a time (a lock is held while it lives).
///
/// - a finished run with the same digests: nothing_to_do;
/// - `resume` and a state.h5 with the same digests: go_on, `state()` holds it; other digests: InputError;
/// - else start: windows, state and geometry of an earlier run are removed (only files named in the
/// contract).
class OutputFolder {
 public:
    enum class Start { fresh, go_on, nothing_to_do };

    OutputFolder(std::filesystem::path folder, RunIdentity identity, bool resume);
    /// Brings the ParaView index up to date.
    OutputFolder(const OutputFolder&) = delete;
    OutputFolder& operator=(const OutputFolder&) = delete;

    Start start() const { return start_; }
    /// The saved state when start() is go_on.
    const DataFile& state() const { return *state_; }
    /// First window to compute: 0, or the one after the saved state.
    std::int64_t next_window() const { return next_window_; }

    /// Publishes `window` (stage and digests are filled in), then saves `state` as the one to go on from. In
    /// this order: a run killed between the two computes the window again, to the same bytes.
    void publish(Window window, DataFile state);
    /// geometry.h5
    void write_geometry(DataFile geometry) const;

    const std::filesystem::path& path() const { return folder_; }

 private:
    std::filesystem::path folder_;
    RunIdentity identity_;
    Start start_ = Start::fresh;
    std::optional<DataFile> state_;
    std::int64_t next_window_ = 0;
    FolderLock lock_;
};

}  // namespace common
