#include "dem/effects/reserve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dem {

namespace {

using Point = Eigen::Vector2d;

double cross(const Point& a, const Point& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Corners of the convex hull, counterclockwise (Andrew's monotone chain).
std::vector<Point> hull_of(std::vector<Point> points) {
    std::sort(points.begin(), points.end(), [](const Point& a, const Point& b) {
        return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
    });
    std::vector<Point> hull;
    const auto add_chain = [&](auto first, auto last) {
        const std::size_t begin = hull.size();
        for (auto p = first; p != last; ++p) {
            while (hull.size() > begin + 1 &&
                   cross(hull.back() - hull[hull.size() - 2], *p - hull.back()) <= 0)
                hull.pop_back();
            hull.push_back(*p);
        }
        hull.pop_back();  // the other chain begins there
    };
    add_chain(points.begin(), points.end());
    add_chain(points.rbegin(), points.rend());
    return hull;
}

/// Distance of `inside` from the nearest edge; none of a polygon without an inside.
double distance_from_edge(const Point& inside, const std::vector<Point>& hull) {
    if (hull.size() < 3) return 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < hull.size(); ++k) {
        const Point edge = hull[(k + 1) % hull.size()] - hull[k];
        least = std::min(least, cross(edge, inside - hull[k]) / edge.norm());
    }
    return std::max(least, 0.0);
}

}  // namespace

double reserve_of(std::span<const CarriedContact> contacts, double friction, const Vector& up,
                  double radius) {
    constexpr double least_slope = 0.2;     // of a normal against gravity, to carry: below, it is a side
    constexpr double least_share = 0.01;    // of what friction can hold: contacts that settled at their limit
    constexpr double least_tipping = 1e-3;  // of the same: below, the block stands on a line
    const Vector along = up.unitOrthogonal(), across = up.cross(along);
    double capacity = 0, left = 0, carried = 0;
    Point centre = Point::Zero();
    std::vector<Point> supports;
    for (const auto& contact : contacts) {
        if (-contact.normal.dot(up) < least_slope) continue;
        capacity += friction * contact.normal_force;
        left += friction * contact.normal_force - contact.spring.norm();
        const double share = up.dot(contact.spring - contact.normal_force * contact.normal);
        const Point place(contact.place.dot(along), contact.place.dot(across));
        carried += share;
        centre += share * place;
        supports.push_back(place);
    }
    if (supports.size() < 3 || carried <= 0) return 0;
    const double tipping =
        carried * distance_from_edge(centre / carried, hull_of(std::move(supports))) / (2 * radius);
    return tipping < least_tipping * capacity ? 0 : std::min(std::max(left, least_share * capacity), tipping);
}

}  // namespace dem
