/// One started program: what it says, when and how it ends, and what it cost.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace coupler {

/// How a program ended.
struct Ending {
    int status = 0;           ///< exit status; 0 when a signal ended it
    int signal = 0;           ///< the signal that killed it, or 0
    double wall_seconds = 0;  ///< s
    double cpu_seconds = 0;   ///< s, user and system
    double peak_memory = 0;   ///< bytes, largest resident set

    bool is_done() const { return status == 0 && signal == 0; }
    /// "exit status 1", "killed by signal 9 (Killed)"
    std::string describe() const;
};

/// A child process whose stdout and stderr are read through pipes. It is asked to stop (SIGTERM) if this
/// process dies, and killed if it still runs when the object goes.
class StageProcess {
 public:
    /// Starts `command` (program path and arguments). Throws RunError when that fails.
    explicit StageProcess(const std::vector<std::string>& command);
    ~StageProcess();
    StageProcess(const StageProcess&) = delete;
    StageProcess& operator=(const StageProcess&) = delete;

    /// Reads what the program has written and looks whether it has ended. Never waits.
    void poll();
    bool has_ended() const { return ending_.has_value(); }
    /// Only when has_ended().
    const Ending& ending() const { return *ending_; }
    double wall_seconds() const;

    /// Complete stderr lines since the last call.
    std::vector<std::string> take_messages();
    /// All of stdout so far.
    const std::string& output() const { return output_; }

    /// Passes a signal on; nothing when the program has ended.
    void send(int signal) const;
    pid_t process() const { return process_; }

 private:
    void read_pipes();

    pid_t process_ = -1;
    int output_pipe_ = -1, message_pipe_ = -1;
    std::string output_, pending_messages_;
    std::optional<Ending> ending_;
    std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

/// Polls until `process` ends; throws Interrupted after Ctrl-C.
void wait_for_end(StageProcess& process);

}  // namespace coupler
