/// The progress board: a line a stage, on stderr.
#pragma once

#include <chrono>
#include <string>
#include <vector>

namespace coupler {

/// On a terminal the lines are redrawn in place; otherwise they are printed now and then; nothing when quiet.
class Board {
 public:
    explicit Board(bool is_quiet);
    /// True when it is time to show the lines again; cheap to ask often.
    bool is_due() const;
    void show(const std::vector<std::string>& lines);
    /// A line of its own, above the board; also when quiet.
    void say(const std::string& message);
    /// The last state, which stays.
    void finish(const std::vector<std::string>& lines);

 private:
    void erase();
    void print(const std::vector<std::string>& lines);
    bool is_quiet_, is_terminal_;
    std::vector<std::string> shown_;
    std::chrono::steady_clock::time_point last_;
};

/// "12 s", "3 min", "1.5 h"
std::string duration_text(double seconds);
/// "34 MB"
std::string memory_text(double bytes);

}  // namespace coupler
