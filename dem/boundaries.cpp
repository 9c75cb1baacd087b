#include "dem/boundaries.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dem {

FixedSpheres::FixedSpheres(std::vector<Vector> centres, double diameter, double reach, double period)
    : centres_(std::move(centres)), diameter_(diameter), period_(period), cell_(reach) {
    if (centres_.empty()) return;
    std::vector<Entry> entries;
    std::vector<Vector> places;
    const auto add = [&](std::uint32_t sphere, double periods) {
        entries.push_back({sphere, static_cast<std::int32_t>(periods)});
        places.push_back(image_of(sphere, periods));
    };
    for (std::uint32_t i = 0; i < centres_.size(); ++i) {
        const double inside = -period_at(centres_[i].y());
        add(i, inside);
        if (period_ == 0) continue;
        // Those near one side are felt at the other.
        const double y = places.back().y();
        if (y < reach) add(i, inside + 1);
        if (y > period_ - reach) add(i, inside - 1);
    }

    Vector least = places[0], most = places[0];
    for (const auto& c : places) {
        least = least.cwiseMin(c);
        most = most.cwiseMax(c);
    }
    lowest_ = least.z();
    highest_ = most.z();
    // A border of one empty column on every side holds the points that are outside and yet within reach.
    constexpr double most_columns = 4e6;
    const double width = most.x() - least.x(), depth = most.y() - least.y();
    while ((width / cell_ + 4) * (depth / cell_ + 4) > most_columns) cell_ *= 2;
    origin_x_ = least.x() - 1.5 * cell_;
    origin_y_ = least.y() - 1.5 * cell_;
    count_x_ = static_cast<std::int64_t>(width / cell_) + 4;
    count_y_ = static_cast<std::int64_t>(depth / cell_) + 4;

    const auto cells = static_cast<std::size_t>(count_x_ * count_y_);
    begin_.assign(cells + 1, 0);
    for (const auto& c : places) ++begin_[static_cast<std::size_t>(cell_of(c.x(), c.y())) + 1];
    for (std::size_t i = 0; i < cells; ++i) begin_[i + 1] += begin_[i];
    order_.resize(places.size());
    in_order_.resize(places.size());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    std::vector<double> own_top(cells, -std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto cell = static_cast<std::size_t>(cell_of(places[i].x(), places[i].y()));
        const std::uint32_t to = next[cell]++;
        order_[to] = entries[i];
        in_order_[to] = places[i];
        own_top[cell] = std::max(own_top[cell], places[i].z());
    }
    // The border too: its columns are empty, but what stands beside them is felt from there.
    top_ = own_top;
    for (std::int64_t y = 0; y < count_y_; ++y)
        for (std::int64_t x = 0; x < count_x_; ++x) {
            auto& top = top_[static_cast<std::size_t>(y * count_x_ + x)];
            for (std::int64_t j = std::max<std::int64_t>(y - 1, 0); j <= std::min(y + 1, count_y_ - 1); ++j)
                for (std::int64_t i = std::max<std::int64_t>(x - 1, 0); i <= std::min(x + 1, count_x_ - 1);
                     ++i)
                    top = std::max(top, own_top[static_cast<std::size_t>(j * count_x_ + i)]);
        }
}

std::int64_t FixedSpheres::cell_of(double x, double y) const {
    const auto i = static_cast<std::int64_t>(std::floor((x - origin_x_) / cell_));
    const auto j = static_cast<std::int64_t>(std::floor((y - origin_y_) / cell_));
    if (i < 0 || j < 0 || i >= count_x_ || j >= count_y_) return -1;
    return j * count_x_ + i;
}

void FixedSpheres::find_near(const Vector& wherever, double distance, std::vector<Near>& found) const {
    if (centres_.empty()) return;
    const double periods = period_at(wherever.y());
    const Vector point = wherever - Vector(0, periods * period_, 0);
    const std::int64_t cell = cell_of(point.x(), point.y());
    if (cell < 0 || point.z() - distance > top_[static_cast<std::size_t>(cell)]) return;
    const std::int64_t column = cell % count_x_, row = cell / count_x_;
    const std::size_t first = found.size();
    for (std::int64_t y = std::max<std::int64_t>(row - 1, 0); y <= std::min(row + 1, count_y_ - 1); ++y) {
        // Columns that follow each other in x lie in one piece of the order.
        const auto from = static_cast<std::size_t>(y * count_x_ + std::max<std::int64_t>(column - 1, 0));
        const auto to = static_cast<std::size_t>(y * count_x_ + std::min(column + 1, count_x_ - 1));
        for (std::uint32_t k = begin_[from]; k < begin_[to + 1]; ++k)
            if ((in_order_[k] - point).squaredNorm() < distance * distance)
                found.push_back({order_[k].sphere, image_of(order_[k].sphere, periods + order_[k].periods)});
    }
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(),
              [](const Near& a, const Near& b) { return a.sphere < b.sphere; });
}

double FixedSpheres::highest_near(double x, double wherever, double distance) const {
    double top = -std::numeric_limits<double>::infinity();
    if (centres_.empty()) return top;
    const double y = wherever - period_at(wherever) * period_;
    const auto clamp = [](double value, std::int64_t count) {
        return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(value)), 0, count - 1);
    };
    for (std::int64_t j = clamp((y - distance - origin_y_) / cell_, count_y_);
         j <= clamp((y + distance - origin_y_) / cell_, count_y_); ++j)
        for (std::int64_t i = clamp((x - distance - origin_x_) / cell_, count_x_);
             i <= clamp((x + distance - origin_x_) / cell_, count_x_); ++i) {
            const auto cell = static_cast<std::size_t>(j * count_x_ + i);
            for (std::uint32_t k = begin_[cell]; k < begin_[cell + 1]; ++k) {
                const Vector& c = in_order_[k];
                if (std::hypot(c.x() - x, c.y() - y) <= distance) top = std::max(top, c.z());
            }
        }
    return top;
}

}  // namespace dem
