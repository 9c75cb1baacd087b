/// Times of windows and of samples, on one clock for the whole chain.
#pragma once

#include <cstdint>
#include <vector>

namespace common {

/// Windows [start + k length, start + (k+1) length], the last one cut at `end`. All times in s, and whole
/// nanoseconds, so that the same instant has the same bits whatever the window length.
class WindowClock {
 public:
    WindowClock(double start, double end, double length);

    std::int64_t window_count() const { return count_; }
    double begin_of(std::int64_t index) const;
    double end_of(std::int64_t index) const;

    /// Sample times of one window: both ends, and every multiple of `interval` (counted from time zero, so
    /// that samples do not depend on the window length) between them.
    std::vector<double> samples_in(std::int64_t index, double interval) const;

 private:
    double start_, end_, length_;
    std::int64_t count_;
};

}  // namespace common
