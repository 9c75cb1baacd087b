/// Means of several channels over the last `duration` seconds of steps of any length, exact across windows
/// and restarts.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace cmps {

class RunningMean {
 public:
    /// `duration`: s; 0: the last step alone.
    RunningMean(double duration, std::size_t channels) : duration_(duration), channels_(channels) {}

    /// The place for the channels' values in a step of `step` s that ends now. What has become too old is
    /// forgotten; memory grows until it holds the steps of one duration, and no further.
    std::span<double> add_step(double step);
    /// Over the `duration` that ends with the last step; since the beginning where that is shorter. Of the
    /// first step only the share that lies within counts.
    double mean(std::size_t channel) const;
    bool is_empty() const { return count_ == 0; }

    /// Steps' lengths and values, oldest first.
    std::vector<double> state() const;
    void restore(const std::vector<double>& state);

 private:
    std::size_t slot(std::size_t age) const { return (next_ + steps_.size() - 1 - age) % steps_.size(); }
    double duration_;
    std::size_t channels_;
    std::vector<double> steps_, values_;  // a ring: `next_` is written next, `count_` before it are held
    std::size_t next_ = 0, count_ = 0;
};

}  // namespace cmps
