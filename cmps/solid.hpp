/// What is not water: bed, structure, end walls, as polygons; their union's surface; wall particles in layers
/// behind it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "cmps/particles.hpp"
#include "cmps/strips.hpp"

namespace cmps {

using Point = std::array<double, 2>;  ///< x, z in m
using Polygon = std::vector<Point>;

/// A piece of the surface of the solid; the normal points out of it.
struct SurfaceSegment {
    Point from, to, normal;
    std::int32_t body;
};

/// Union of polygons.
class Solid {
 public:
    /// Adds a closed polygon (either orientation).
    void add(Polygon polygon, std::int32_t body);
    /// Finds the exposed surface that faces the box [low, high]; call once after the last add().
    void find_surface(const Point& low, const Point& high);

    bool contains(double x, double z) const;
    const std::vector<SurfaceSegment>& surface() const { return surface_; }
    /// Distance to the nearest exposed segment (m) and its index.
    double distance(double x, double z, std::size_t& nearest) const;
    /// Calls visit(segment's index) for all exposed segments that meet x = [low, high], and for some beside;
    /// for some more than once.
    template <class Visit>
    void for_surface(double low, double high, const Visit& visit) const {
        surface_by_x_.for_near(low, high, visit);
    }
    /// Free intervals [z0, z1] of the vertical line at x between `bottom` and `top`.
    std::vector<std::array<double, 2>> free_intervals(double x, double bottom, double top) const;

 private:
    struct Part {
        Polygon points;
        std::int32_t body;
        double x0, x1, z0, z1;
        Strips by_x = {}, by_z = {};  ///< edges, the i-th from point i to the next

        bool holds(double x, double z) const;
    };
    bool is_face_of_earlier(const Part& part, const Point& behind) const;
    std::vector<Part> parts_;
    std::vector<SurfaceSegment> surface_;
    Strips surface_by_x_;
};

/// Radius of the largest ball within the solid that touches the face at `at` from behind, up to `most`, m.
double ball_behind(const Solid& solid, const Point& at, const Point& normal, double most);

/// Area enclosed by a polygon, m2; positive when it runs anticlockwise.
double signed_area(const Polygon& polygon);

/// True where two polygons share more than their borders.
bool overlap(const Polygon& a, const Polygon& b);

/// What of the vertical line at x lies within the polygon: intervals [z0, z1], m.
std::vector<std::array<double, 2>> intervals_within(const Polygon& polygon, double x);

/// True where an edge of the closed polygon runs back along the one before it; `where` gets their point (from
/// 1).
bool folds_back(const Polygon& polygon, std::size_t& where);

/// True where the closed polygon crosses itself; `where` gets the two edges (from 1).
bool crosses_itself(const Polygon& polygon, std::array<std::size_t, 2>& where);

/// Places four layers of boundary particles, `spacing` apart, the first half a spacing behind the surface,
/// for x in [x0, x1]. Corners are mitred. The first layer becomes walls, the rest dummies.
struct BoundaryParticle {
    double x, z;
    Point normal;
    std::int32_t body;
    bool carries_pressure;
};
std::vector<BoundaryParticle> place_boundary(const Solid& solid, double spacing, double x0, double x1,
                                             double z1);

}  // namespace cmps
