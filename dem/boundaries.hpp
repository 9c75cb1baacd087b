/// What blocks can touch besides each other: fixed spheres (mound, walls) and planes.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "dem/vector.hpp"

namespace dem {

/// The half space behind a plane is solid; `normal` (unit) points to where blocks are.
struct Plane {
    Vector point, normal;
};

/// Spheres that never move, in a grid of vertical columns that is built once.
class FixedSpheres {
 public:
    FixedSpheres() = default;
    /// `diameter` of the spheres, m; `reach`: largest distance of centres that will be asked for, m.
    FixedSpheres(std::vector<Vector> centres, double diameter, double reach);

    bool empty() const { return centres_.empty(); }
    std::size_t size() const { return centres_.size(); }
    double diameter() const { return diameter_; }
    const Vector& centre(std::size_t sphere) const { return centres_[sphere]; }
    const std::vector<Vector>& centres() const { return centres_; }
    double lowest() const { return lowest_; }
    double highest() const { return highest_; }

    /// A sphere that was found.
    struct Near {
        std::uint32_t sphere;
        Vector centre;
    };
    /// Appends to `found` the spheres whose centres are within `distance` (<= reach) of `point`, in ascending
    /// order.
    void find_near(const Vector& point, double distance, std::vector<Near>& found) const;
    /// Height of the highest sphere centre within `distance` (horizontally) of x, y; -infinity where there is
    /// none.
    double highest_near(double x, double y, double distance) const;

 private:
    std::int64_t cell_of(double x, double y) const;
    std::vector<Vector> centres_;
    double diameter_ = 0, cell_ = 1, origin_x_ = 0, origin_y_ = 0, lowest_ = 0, highest_ = 0;
    std::int64_t count_x_ = 0, count_y_ = 0;
    std::vector<std::uint32_t> begin_, order_;  // spheres of each column
    std::vector<Vector> in_order_;              // their centres, so that a search reads memory in a row
    std::vector<double> top_;                   // highest centre in the 3 x 3 columns around each column
};

}  // namespace dem
