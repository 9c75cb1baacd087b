/// run.json: what was run, with what, how long it took, and whether its invariants held.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/scene_file.hpp"

namespace common {

/// An optional effect, on or off, and why. A phase of the same name gives the share of time it took.
struct EffectRecord {
    std::string name;
    bool is_on;
    std::string reason;
};

/// A quantity the run computes about itself.
struct InvariantRecord {
    std::string name;
    double value;
    std::string unit;
    double bound;  ///< |value| must stay below it; infinity: reported only
};

/// Collects and writes run.json (atomically, at every window and at the end).
class RunRecord {
 public:
    RunRecord(std::filesystem::path folder, std::string stage);

    void describe_scene(const SceneFile& scene);
    /// Keeps the stage and scene that DIR/run.json of the windows read says, and those before it.
    void describe_input(const std::filesystem::path& folder);
    void set_digests(const std::string& scene_digest, const std::string& input_digest);
    void set_effects(std::vector<EffectRecord> effects);
    /// Sets (or replaces) an invariant by name.
    void set_invariant(const InvariantRecord& invariant);
    /// Any further figure: "particles", "steps", "nanoseconds_per_cell_step", ...
    void set_figure(const std::string& name, double value);
    /// Dotted names make nested objects ("damage.mean_offshore"); one part may stand in quotes to be taken as
    /// it is ("gauges.\"g10.5\".crest_mean").
    void set_note(const std::string& name, const std::string& text);
    void set_series(const std::string& name, const std::vector<double>& values);
    /// Adds seconds of wall time to a phase ("pressure solve").
    void add_phase_time(const std::string& phase, double seconds);
    void add_window() { ++windows_; }
    void set_windows(std::int64_t count) { windows_ = count; }

    /// status "running", with pid and host, so that followers know whom they wait for.
    void write_running();
    /// status "done", "failed" or "interrupted"; `message` says why.
    void write_ended(const std::string& status, const std::string& message = {});

 private:
    void write(const std::string& status, const std::string& message);
    struct Content;
    std::filesystem::path folder_;
    std::string stage_;
    std::shared_ptr<Content> content_;
    std::int64_t windows_ = 0;
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

/// Adds the time it lives to a phase: `PhaseTimer timer(record_seconds["solve"]);`
class PhaseTimer {
 public:
    explicit PhaseTimer(double& seconds) : seconds_(seconds) {}
    ~PhaseTimer() {
        seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
    }
    PhaseTimer(const PhaseTimer&) = delete;
    PhaseTimer& operator=(const PhaseTimer&) = delete;

 private:
    double& seconds_;
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

/// Status an upstream run.json shows.
struct UpstreamStatus {
    enum class State { absent, running, done, failed, interrupted, died } state;
    std::int64_t windows = 0;
    std::string message;
    std::string stage;  ///< the program that wrote it; empty when absent
};
/// Reads DIR/run.json; `died`: it says running on this host but the process is gone.
UpstreamStatus read_upstream_status(const std::filesystem::path& folder);

/// Peak resident memory of this process, bytes.
double peak_memory();

}  // namespace common
