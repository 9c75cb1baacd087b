/// One progress line: simulated time, speed, time left.
#pragma once

#include <chrono>
#include <string>

namespace common {

/// On a terminal one line that is rewritten; otherwise a plain line now and then; nothing when quiet.
class Progress {
 public:
    Progress(std::string stage, double begin, double end, bool quiet);
    ~Progress();
    /// Cheap when called often: looks at the clock and returns. `detail` is a short phrase ("12034
    /// particles").
    void update(double time, const std::string& detail = {});
    /// A line of its own, above the progress line.
    void say(const std::string& message);
    void finish(const std::string& summary);

 private:
    std::string stage_;
    double begin_, end_;
    bool quiet_, terminal_;
    std::chrono::steady_clock::time_point started_, last_;
};

}  // namespace common
