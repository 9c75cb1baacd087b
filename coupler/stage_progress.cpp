#include "coupler/stage_progress.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/window_channel.hpp"
#include "coupler/board.hpp"

namespace coupler {

StageProgress::StageProgress(std::string stage, std::filesystem::path folder, common::TimeSection time)
    : stage_(std::move(stage)), folder_(std::move(folder)), time_(time) {}

void StageProgress::look() {
    summary_ = common::read_run_summary(folder_);
    if (!summary_ || summary_->windows == 0) return;
    if (!begin_) begin_ = common::read_window(common::window_path(folder_, 0), stage_, {}).t_begin;
    if (!first_seen_) {
        first_seen_ = simulated_until();
        first_wall_time_ = summary_->wall_time;
    }
}

std::optional<double> StageProgress::simulated_until() const {
    if (!begin_) return {};
    return std::min(time_.end, *begin_ + static_cast<double>(summary_->windows) * time_.window);
}

std::string StageProgress::describe() const {
    const auto now = simulated_until();
    if (!now) return {};
    std::string text = fmt::format("t = {:6.2f} of {:.2f} s", *now, time_.end);
    const double spent = summary_->wall_time - first_wall_time_;
    if (spent <= 0 || *now <= *first_seen_ || *now >= time_.end) return text;
    const double speed = (*now - *first_seen_) / spent;
    return text + fmt::format(", {:.2g} s/s, {} left", speed, duration_text((time_.end - *now) / speed));
}

}  // namespace coupler
