/// How far a stage has come, read off its folder.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/run_summary.hpp"
#include "common/shared_sections.hpp"

namespace coupler {

/// Follows one stage's folder while the stage writes it.
class StageProgress {
 public:
    StageProgress(std::string stage, std::filesystem::path folder, common::TimeSection time);

    /// Reads run.json, and once the first window.
    void look();
    /// End of the last finished window, s; nothing before the first.
    std::optional<double> simulated_until() const;
    /// What run.json said at the last look.
    const std::optional<common::RunSummary>& summary() const { return summary_; }
    /// "t = 12.50 of 40.00 s, 25 windows, 3.1 s/s, 9 s left"
    std::string describe() const;

 private:
    std::string stage_;
    std::filesystem::path folder_;
    common::TimeSection time_;
    std::optional<common::RunSummary> summary_;
    std::optional<double> begin_;       // t_begin of the first window
    std::optional<double> first_seen_;  // simulated time and wall time when speed was first measurable
    double first_wall_time_ = 0;
};

}  // namespace coupler
