#include "cmps/narrow_places.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace cmps {
namespace {

/// n.n' of two faces that stand opposite each other, at less than 12 degrees.
const double opposite = -std::cos(12.0 * 3.14159265358979 / 180.0);

/// Where the ray from `at` along `direction` first meets the surface: distance (m) and segment.
struct Hit {
    double distance;
    const SurfaceSegment* segment;
};
Hit first_hit(const Solid& solid, const Point& at, const Point& direction, double nearest, double farthest) {
    Hit hit{farthest, nullptr};
    const auto [left, right] = std::minmax({at[0], at[0] + farthest * direction[0]});
    solid.for_surface(left, right, [&](std::size_t index) {
        const SurfaceSegment& other = solid.surface()[index];
        const double across = direction[0] * other.normal[0] + direction[1] * other.normal[1];
        if (std::abs(across) < 1e-12) return;
        const double ex = other.from[0] - at[0], ez = other.from[1] - at[1];
        const double t = (ex * other.normal[0] + ez * other.normal[1]) / across;
        if (t < nearest || t >= hit.distance) return;
        const double x = at[0] + t * direction[0], z = at[1] + t * direction[1];
        const double dx = other.to[0] - other.from[0], dz = other.to[1] - other.from[1];
        const double s = ((x - other.from[0]) * dx + (z - other.from[1]) * dz) / (dx * dx + dz * dz);
        if (s > -1e-9 && s < 1 + 1e-9) hit = {t, &other};
    });
    return hit;
}

/// Calls visit(segment, at) for points at most half a spacing apart on every face below `top`.
template <class Visit>
void for_points_on_faces(const Solid& solid, double spacing, double top, const Visit& visit) {
    for (const SurfaceSegment& segment : solid.surface()) {
        const double dx = segment.to[0] - segment.from[0], dz = segment.to[1] - segment.from[1];
        const int count = std::max(1, static_cast<int>(std::ceil(std::hypot(dx, dz) / (0.5 * spacing))));
        for (int i = 0; i < count; ++i) {
            const double s = (i + 0.5) / count;
            const Point at = {segment.from[0] + s * dx, segment.from[1] + s * dz};
            if (at[1] < top) visit(segment, at);
        }
    }
}

/// The shortest way to a face opposite, along `sign` times the normal, of those from `least` to `limit` (m).
std::optional<NarrowPlace> narrowest(const Solid& solid, double spacing, double top, double sign,
                                     double least, double limit) {
    std::optional<NarrowPlace> found;
    for_points_on_faces(solid, spacing, top, [&](const SurfaceSegment& segment, const Point& at) {
        const Point direction = {sign * segment.normal[0], sign * segment.normal[1]};
        const Hit hit = first_hit(solid, at, direction, least, found ? found->width : limit);
        if (hit.segment &&
            segment.normal[0] * hit.segment->normal[0] + segment.normal[1] * hit.segment->normal[1] <
                opposite)
            found = {at, hit.distance, segment.body, hit.segment->body};
    });
    return found;
}

}  // namespace

std::optional<NarrowPlace> thinnest_body(const Solid& solid, double least, double spacing, double top) {
    const double limit = least * (1 - 1e-6);
    std::optional<NarrowPlace> found = narrowest(solid, spacing, top, -1, 1e-9, limit);
    // a body of edges only: nowhere a ball of the least thickness fits in
    std::map<std::int32_t, NarrowPlace> thickest;
    for_points_on_faces(solid, spacing, top, [&](const SurfaceSegment& segment, const Point& at) {
        auto& place = thickest.try_emplace(segment.body, NarrowPlace{at, 0.0, segment.body, segment.body})
                          .first->second;
        if (place.width >= limit) return;
        const double width = 2 * ball_behind(solid, at, segment.normal, 0.5 * limit);
        if (width > place.width) place.at = at, place.width = width;
    });
    for (const auto& [body, place] : thickest)
        if (body >= 0 && place.width < limit * (1 - 1e-6) && (!found || place.width < found->width))
            found = place;
    return found;
}

std::optional<NarrowPlace> narrowest_gap(const Solid& solid, double spacing, double top) {
    return narrowest(solid, spacing, top, 1, closed_gap * spacing, least_gap * spacing * (1 - 1e-6));
}

}  // namespace cmps
