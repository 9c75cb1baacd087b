/// What blocks can touch besides each other: fixed spheres (mound, walls) and planes.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "dem/vector.hpp"

namespace dem {

/// The half space behind a plane is solid; `normal` (unit) points to where blocks are.
struct Plane {
    Vector point, normal;
};

/// Spheres that never move, in a grid of vertical columns that is built once. In a periodic box each stands
/// for all its images, whole periods apart in y.
class FixedSpheres {
 public:
    FixedSpheres() = default;
    /// `diameter` of the spheres, m; `reach`: largest distance of centres that will be asked for, m;
    /// `period`: width of the periodic box in y, m; 0: none.
    FixedSpheres(std::vector<Vector> centres, double diameter, double reach, double period = 0);

    bool empty() const { return centres_.empty(); }
    std::size_t size() const { return centres_.size(); }
    double diameter() const { return diameter_; }
    const Vector& centre(std::size_t sphere) const { return centres_[sphere]; }
    const std::vector<Vector>& centres() const { return centres_; }
    /// Centre of the sphere, or of its image, that is nearest to `point`.
    Vector centre_near(std::size_t sphere, const Vector& point) const {
        return period_ > 0 ? image_of(sphere, std::round((point.y() - centres_[sphere].y()) / period_))
                           : centres_[sphere];
    }
    double lowest() const { return lowest_; }
    double highest() const { return highest_; }

    /// A sphere that was found, and where it (or the image found) stands.
    struct Near {
        std::uint32_t sphere;
        Vector centre;
    };
    /// Appends to `found` the spheres whose centres are within `distance` (<= reach) of `point`, in ascending
    /// order. An image's place is the same to the bit from wherever it was looked for.
    void find_near(const Vector& point, double distance, std::vector<Near>& found) const;
    /// Height of the highest sphere centre within `distance` (horizontally) of x, y; -infinity where there is
    /// none.
    double highest_near(double x, double y, double distance) const;

 private:
    std::int64_t cell_of(double x, double y) const;
    Vector image_of(std::size_t sphere, double periods) const {
        return centres_[sphere] + Vector(0, periods * period_, 0);
    }
    /// The period that y lies in.
    double period_at(double y) const { return period_ > 0 ? std::floor(y / period_) : 0; }

    std::vector<Vector> centres_;
    double diameter_ = 0, period_ = 0, cell_ = 1, origin_x_ = 0, origin_y_ = 0, lowest_ = 0, highest_ = 0;
    std::int64_t count_x_ = 0, count_y_ = 0;
    /// What a search looks through: a sphere, or its image `periods` further in y.
    struct Entry {
        std::uint32_t sphere;
        std::int32_t periods;
    };
    std::vector<std::uint32_t> begin_;  // of each column in the two below
    std::vector<Entry> order_;
    std::vector<Vector> in_order_;  // centres, so that a search reads memory in a row
    std::vector<double> top_;       // highest centre in the 3 x 3 columns around each column
};

}  // namespace dem
