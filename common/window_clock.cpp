#include "common/window_clock.hpp"

#include <algorithm>
#include <cmath>

namespace common {

namespace {
/// The same instant must have the same bits however it was counted (41 x 0.05 or 82 x 0.025): whole
/// nanoseconds.
constexpr double nanosecond = 1e-9;
double to_nanosecond(double t) {
    return std::round(t * 1e9) / 1e9;
}
}  // namespace

WindowClock::WindowClock(double start, double end, double length)
    : start_(start), end_(to_nanosecond(end)), length_(length) {
    // A remainder below rounding is no window of its own.
    const double rounding = std::max(1e-9, nanosecond / length);
    count_ =
        std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil((end - start) / length - rounding)));
}

double WindowClock::begin_of(std::int64_t index) const {
    return to_nanosecond(start_ + static_cast<double>(index) * length_);
}

double WindowClock::end_of(std::int64_t index) const {
    return index + 1 >= count_ ? end_ : begin_of(index + 1);
}

std::vector<double> WindowClock::samples_in(std::int64_t index, double interval) const {
    const double begin = begin_of(index), end = end_of(index);
    // No two samples at one instant, whatever the interval rounds to.
    const double sliver = std::max(1e-6 * interval, 0.5 * nanosecond);
    std::vector<double> samples{begin};
    for (auto k = static_cast<std::int64_t>(std::floor(begin / interval));
         static_cast<double>(k) * interval < end - sliver; ++k) {
        const double t = to_nanosecond(static_cast<double>(k) * interval);
        if (t > begin + sliver && t < end - sliver) samples.push_back(t);
    }
    samples.push_back(end);
    return samples;
}

}  // namespace common
