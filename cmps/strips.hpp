/// Which of many intervals on a line lie at a place: what makes questions about 10,000 edges cheap.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cmps {

/// Intervals by strips of equal width.
class Strips {
 public:
    Strips() = default;
    explicit Strips(const std::vector<std::array<double, 2>>& intervals);

    /// Calls visit(interval's number) for all that meet [low, high], for some more beside, and for one that
    /// lies in several strips more than once; nothing in order.
    template <class Visit>
    void for_near(double low, double high, const Visit& visit) const {
        if (members_.empty()) return;
        for (std::size_t s = strip(low); s <= strip(high); ++s) for_strip(s, visit);
    }
    /// Strips, and the one at `x`, for those who go from strip to strip.
    std::size_t count() const { return start_.empty() ? 0 : start_.size() - 1; }
    std::size_t strip(double x) const;
    double low_end(std::size_t strip) const { return low_ + static_cast<double>(strip) * width_; }
    template <class Visit>
    void for_strip(std::size_t strip, const Visit& visit) const {
        for (std::size_t m = start_[strip]; m < start_[strip + 1]; ++m) visit(members_[m]);
    }

 private:
    double low_ = 0, width_ = 1;
    std::vector<std::size_t> start_;
    std::vector<std::uint32_t> members_;
};

}  // namespace cmps
