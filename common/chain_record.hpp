/// chain.json: which stages a chain ran, with what, how they ended and what they cost.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace common {

/// One stage of the chain.
struct ChainStage {
    std::string name;                  ///< "boussinesq"
    std::string folder;                ///< "waves", inside the chain's folder
    std::vector<std::string> command;  ///< as started
    /// "waiting", "running", "done", "unchanged" (finished before), "failed", "stopped" (because another
    /// failed), "interrupted"
    std::string status = "waiting";
    std::string message;  ///< why it failed
    int exit_status = 0;
    int signal = 0;          ///< that killed it, or 0
    double wall_time = 0;    ///< s
    double cpu_time = 0;     ///< s
    double peak_memory = 0;  ///< bytes
};

/// The whole chain.
struct ChainRecord {
    std::string status = "running";  ///< "running", "done", "failed", "interrupted"
    std::string message;
    std::string scene, wires;  ///< files, absolute; `wires` empty without a layout
    std::vector<std::string> overrides;
    double end = 0;        ///< of the scene's time, s
    double window = 0;     ///< length of the scene's windows, s
    double wall_time = 0;  ///< s
    std::vector<ChainStage> stages;
};

/// Writes DIR/chain.json atomically. Throws RunError.
void write_chain_record(const std::filesystem::path& folder, const ChainRecord& record);

/// Throws InputError when DIR/chain.json is absent or not a chain record.
ChainRecord read_chain_record(const std::filesystem::path& folder);

}  // namespace common
