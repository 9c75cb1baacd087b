/// A recorded quantity: read at the ends of steps, sampled by straight lines between them.
///
/// Steps know nothing of what is recorded, so results depend neither on sampling intervals nor on windows.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace cmps {

/// What a quantity was at the end of a step.
struct Reading {
    double time = 0;
    bool is_made = false;
    bool is_solved = false;  ///< pressures are those of a step: before the first there is only a guess
    std::array<std::vector<double>, 3> fields;  ///< as many as the quantity has
};

/// Samples of one quantity within a window.
struct Series {
    std::vector<double> due;  ///< sample times of this window, s
    std::size_t next = 0;
    std::array<std::vector<float>, 3> values;  ///< of the samples so far, one after the other

    Reading before, after;  ///< on both ends of the last step that passed a sample time

    /// A step to `time` will pass a sample time.
    bool is_passed_by(double time) const { return next < due.size() && due[next] <= time; }
    bool is_complete() const { return next == due.size(); }
    /// Sample times so far.
    std::vector<double> times() const {
        return {due.begin(), due.begin() + static_cast<std::ptrdiff_t>(next)};
    }
};

/// Value at `share` of the way between two readings.
inline double between(double before, double after, double share) {
    return (1.0 - share) * before + share * after;
}

}  // namespace cmps
