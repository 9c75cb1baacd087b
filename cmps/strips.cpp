#include "cmps/strips.hpp"

#include <algorithm>
#include <limits>

namespace cmps {

Strips::Strips(const std::vector<std::array<double, 2>>& intervals) {
    if (intervals.empty()) return;
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const auto& [from, to] : intervals) low = std::min(low, from), high = std::max(high, to);
    low_ = low;
    constexpr std::size_t most_entries = 16;  // a member, in the mean: long ones are in many strips
    for (std::size_t strips = intervals.size();; strips = (strips + 1) / 2) {
        width_ = high > low ? (high - low) / static_cast<double>(strips) : 1.0;
        start_.assign(strips + 1, 0);
        std::size_t entries = 0;
        for (const auto& [from, to] : intervals) entries += strip(to) - strip(from) + 1;
        if (strips > 1 && entries > most_entries * intervals.size()) continue;
        for (const auto& [from, to] : intervals)
            for (std::size_t s = strip(from); s <= strip(to); ++s) ++start_[s + 1];
        for (std::size_t s = 0; s < strips; ++s) start_[s + 1] += start_[s];
        members_.resize(entries);
        std::vector<std::size_t> next(start_.begin(), start_.end() - 1);
        for (std::size_t i = 0; i < intervals.size(); ++i)
            for (std::size_t s = strip(intervals[i][0]); s <= strip(intervals[i][1]); ++s)
                members_[next[s]++] = static_cast<std::uint32_t>(i);
        return;
    }
}

std::size_t Strips::strip(double x) const {
    const double last = static_cast<double>(start_.size() - 2);
    return static_cast<std::size_t>(std::clamp((x - low_) / width_, 0.0, last));
}

}  // namespace cmps
