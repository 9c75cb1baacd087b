#include "common/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>

namespace common {

namespace {
using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
}

std::string duration_text(double seconds) {
    if (seconds < 100) return fmt::format("{:.0f} s", seconds);
    if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
    return fmt::format("{:.1f} h", seconds / 3600);
}
}  // namespace

Progress::Progress(std::string stage, double begin, double end, bool quiet)
    : stage_(std::move(stage)),
      begin_(begin),
      end_(end),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) != 0),
      started_(Clock::now()),
      last_(started_) {}

Progress::~Progress() {
    if (!quiet_ && terminal_) fmt::print(stderr, "\r\x1b[K");
}

void Progress::update(double time, const std::string& detail) {
    if (quiet_) return;
    const double between = terminal_ ? 0.2 : 10.0;
    if (seconds_since(last_) < between) return;
    last_ = Clock::now();
    const double spent = seconds_since(started_), done = time - begin_;
    const double speed = spent > 0 ? done / spent : 0;
    const std::string left = speed > 0 ? duration_text((end_ - time) / speed) + " left" : "";
    fmt::print(stderr, "{}{}: t = {:.2f} of {:.2f} s, {:.2g} s/s, {}{}{}{}", terminal_ ? "\r\x1b[K" : "",
               stage_, time, end_, speed, left, detail.empty() ? "" : ", ", detail, terminal_ ? "" : "\n");
    std::fflush(stderr);
}

void Progress::say(const std::string& message) {
    if (quiet_) return;
    fmt::print(stderr, "{}{}: {}\n", terminal_ ? "\r\x1b[K" : "", stage_, message);
}

void Progress::finish(const std::string& summary) {
    if (quiet_) return;
    say(fmt::format("{} ({})", summary, duration_text(seconds_since(started_))));
}

}  // namespace common
