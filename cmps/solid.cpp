#include "cmps/solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace cmps {
namespace {

double cross(const Point& a, const Point& b) {
    return a[0] * b[1] - a[1] * b[0];
}
Point minus(const Point& a, const Point& b) {
    return {a[0] - b[0], a[1] - b[1]};
}
Point along(const Point& a, const Point& b, double s) {
    return {a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])};
}

/// Extents of a polygon's edges in x (0) or z (1).
std::vector<std::array<double, 2>> extents(const Polygon& polygon, std::size_t axis) {
    std::vector<std::array<double, 2>> extents;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const auto [low, high] = std::minmax(polygon[i][axis], polygon[(i + 1) % polygon.size()][axis]);
        extents.push_back({low, high});
    }
    return extents;
}

/// Numbers of edges that may meet [low, high], each once, in order.
std::vector<std::size_t> edges_near(const Strips& strips, double low, double high) {
    std::vector<std::size_t> edges;
    strips.for_near(low, high, [&](std::size_t i) { edges.push_back(i); });
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

double distance_to_segment(const SurfaceSegment& segment, double x, double z) {
    const Point d = minus(segment.to, segment.from), e = {x - segment.from[0], z - segment.from[1]};
    const double length2 = d[0] * d[0] + d[1] * d[1];
    const double s = std::clamp((e[0] * d[0] + e[1] * d[1]) / length2, 0.0, 1.0);
    return std::hypot(e[0] - s * d[0], e[1] - s * d[1]);
}

/// True where a-b and c-d cross at an inner point of both.
bool edges_cross(const Point& a, const Point& b, const Point& c, const Point& d) {
    const Point ab = minus(b, a), cd = minus(d, c);
    const double side_c = cross(ab, minus(c, a)), side_d = cross(ab, minus(d, a));
    const double side_a = cross(cd, minus(a, c)), side_b = cross(cd, minus(b, c));
    return side_c * side_d < 0 && side_a * side_b < 0;
}

/// Parameters on a-b where c-d meets it.
void add_cuts(const Point& a, const Point& b, const Point& c, const Point& d, std::vector<double>& cuts) {
    const Point ab = minus(b, a), cd = minus(d, c), ac = minus(c, a);
    const double length2 = ab[0] * ab[0] + ab[1] * ab[1];
    const double denominator = cross(ab, cd);
    if (std::abs(denominator) > 1e-12 * length2) {
        const double s = cross(ac, cd) / denominator, t = cross(ac, ab) / denominator;
        if (t > -1e-9 && t < 1 + 1e-9) cuts.push_back(s);
    } else {  // parallel: its ends may lie on a-b
        for (const Point& p : {c, d}) {
            const Point ap = minus(p, a);
            cuts.push_back((ap[0] * ab[0] + ap[1] * ab[1]) / length2);
        }
    }
}

}  // namespace

void Solid::add(Polygon polygon, std::int32_t body) {
    if (signed_area(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
    Part part{
        .points = std::move(polygon), .body = body, .x0 = 1e300, .x1 = -1e300, .z0 = 1e300, .z1 = -1e300};
    for (const Point& p : part.points) {
        part.x0 = std::min(part.x0, p[0]), part.x1 = std::max(part.x1, p[0]);
        part.z0 = std::min(part.z0, p[1]), part.z1 = std::max(part.z1, p[1]);
    }
    part.by_x = Strips(extents(part.points, 0)), part.by_z = Strips(extents(part.points, 1));
    parts_.push_back(std::move(part));
}

bool Solid::Part::holds(double x, double z) const {
    if (!(x >= x0 && x <= x1 && z >= z0 && z <= z1)) return false;
    bool is_inside = false;
    by_z.for_strip(by_z.strip(z), [&](std::size_t j) {  // one strip: no edge comes twice
        const Point &a = points[(j + 1) % points.size()], &b = points[j];
        if ((a[1] > z) != (b[1] > z) && x < (b[0] - a[0]) * (z - a[1]) / (b[1] - a[1]) + a[0])
            is_inside = !is_inside;
    });
    return is_inside;
}

bool Solid::contains(double x, double z) const {
    return std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) { return part.holds(x, z); });
}

/// A face that two polygons share, both on the same side of it, is that of the first.
bool Solid::is_face_of_earlier(const Part& part, const Point& behind) const {
    for (const Part* other = parts_.data(); other != &part; ++other)
        if (other->holds(behind[0], behind[1])) return true;
    return false;
}

void Solid::find_surface(const Point& low, const Point& high) {
    surface_.clear();
    for (const Part& part : parts_)
        for (std::size_t i = 0; i < part.points.size(); ++i) {
            const Point &a = part.points[i], &b = part.points[(i + 1) % part.points.size()];
            const Point d = minus(b, a);
            const double length = std::hypot(d[0], d[1]);
            if (length == 0) continue;
            const Point normal = {d[1] / length, -d[0] / length};  // polygons run anticlockwise
            std::vector<double> cuts = {0, 1};
            const double aside = 1e-6 * length;  // what add_cuts() takes for meeting is less
            const auto [left, right] = std::minmax(a[0], b[0]);
            for (const Part& other : parts_)
                for (const std::size_t k : edges_near(other.by_x, left - aside, right + aside))
                    add_cuts(a, b, other.points[k], other.points[(k + 1) % other.points.size()], cuts);
            const Polygon box = {low, {high[0], low[1]}, high, {low[0], high[1]}};
            for (std::size_t k = 0; k < 4; ++k) add_cuts(a, b, box[k], box[(k + 1) % 4], cuts);
            std::erase_if(cuts, [](double s) { return s < 0 || s > 1; });
            std::sort(cuts.begin(), cuts.end());
            for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
                if ((cuts[k + 1] - cuts[k]) * length < 1e-9) continue;
                const Point middle = along(a, b, 0.5 * (cuts[k] + cuts[k + 1]));
                const double off = 1e-7;  // m: beside the edge
                const double x = middle[0] + off * normal[0], z = middle[1] + off * normal[1];
                if (x < low[0] || x > high[0] || z < low[1] || z > high[1] || contains(x, z)) continue;
                if (is_face_of_earlier(part, {middle[0] - off * normal[0], middle[1] - off * normal[1]}))
                    continue;
                const Point from = along(a, b, cuts[k]), to = along(a, b, cuts[k + 1]);
                if (!surface_.empty() && k > 0 && surface_.back().normal == normal &&
                    std::hypot(surface_.back().to[0] - from[0], surface_.back().to[1] - from[1]) < 1e-9)
                    surface_.back().to = to;  // a cut that changed nothing
                else
                    surface_.push_back({.from = from, .to = to, .normal = normal, .body = part.body});
            }
        }
    std::vector<std::array<double, 2>> extents;
    for (const SurfaceSegment& segment : surface_) {
        const auto [left, right] = std::minmax(segment.from[0], segment.to[0]);
        extents.push_back({left, right});
    }
    surface_by_x_ = Strips(extents);
}

double Solid::distance(double x, double z, std::size_t& nearest) const {
    double least = std::numeric_limits<double>::infinity();
    const auto look_at = [&](std::size_t strip) {
        surface_by_x_.for_strip(strip, [&](std::size_t i) {
            const double d = distance_to_segment(surface_[i], x, z);
            if (d < least || (d == least && i < nearest)) least = d, nearest = i;
        });
    };
    if (surface_.empty()) return least;
    const std::size_t here = surface_by_x_.strip(x);
    look_at(here);
    for (std::size_t s = here; s > 0 && !(x - surface_by_x_.low_end(s) > least); --s) look_at(s - 1);
    for (std::size_t s = here + 1; s < surface_by_x_.count() && !(surface_by_x_.low_end(s) - x > least); ++s)
        look_at(s);
    return least;
}

std::vector<std::array<double, 2>> Solid::free_intervals(double x, double bottom, double top) const {
    std::vector<double> cuts = {bottom, top};
    for (const Part& part : parts_)
        part.by_x.for_strip(part.by_x.strip(x), [&](std::size_t i) {
            const Point &a = part.points[i], &b = part.points[(i + 1) % part.points.size()];
            if ((a[0] > x) == (b[0] > x)) return;
            const double z = a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]);
            if (z > bottom && z < top) cuts.push_back(z);
        });
    std::sort(cuts.begin(), cuts.end());
    std::vector<std::array<double, 2>> free;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
        if (cuts[k + 1] - cuts[k] < 1e-9 || contains(x, 0.5 * (cuts[k] + cuts[k + 1]))) continue;
        if (!free.empty() && free.back()[1] == cuts[k])
            free.back()[1] = cuts[k + 1];
        else
            free.push_back({cuts[k], cuts[k + 1]});
    }
    return free;
}

double ball_behind(const Solid& solid, const Point& at, const Point& normal, double most) {
    const auto fits = [&](double depth) {
        std::size_t nearest = 0;
        const double x = at[0] - depth * normal[0], z = at[1] - depth * normal[1];
        return solid.contains(x, z) && solid.distance(x, z, nearest) > depth * (1 - 1e-6);
    };
    if (fits(most)) return most;
    double low = 0, high = most;
    for (int i = 0; i < 30; ++i) {
        const double middle = 0.5 * (low + high);
        (fits(middle) ? low : high) = middle;
    }
    return low;
}

double signed_area(const Polygon& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    return 0.5 * twice;
}

namespace {

/// intervals_within() of a polygon whose edges are sorted by x.
std::vector<std::array<double, 2>> intervals_at(const Polygon& polygon, const Strips& edges, double x) {
    std::vector<double> cuts;
    edges.for_strip(edges.strip(x), [&](std::size_t i) {
        const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if ((a[0] > x) != (b[0] > x)) cuts.push_back(a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]));
    });
    std::sort(cuts.begin(), cuts.end());
    std::vector<std::array<double, 2>> intervals;
    for (std::size_t k = 0; k + 1 < cuts.size(); k += 2) intervals.push_back({cuts[k], cuts[k + 1]});
    return intervals;
}

}  // namespace

/// Between two ends of edges or crossings, side by side in x, no edges of a and b cross: a line at the middle
/// shows whether anything lies in both.
bool overlap(const Polygon& a, const Polygon& b) {
    std::vector<double> x;
    for (const Polygon* polygon : {&a, &b})
        for (const Point& p : *polygon) x.push_back(p[0]);
    const Strips edges_of_a(extents(a, 0)), edges_of_b(extents(b, 0));
    for (std::size_t i = 0; i < a.size(); ++i) {
        const Point &from = a[i], &to = a[(i + 1) % a.size()];
        const auto [left, right] = std::minmax(from[0], to[0]);
        for (const std::size_t k : edges_near(edges_of_b, left, right)) {
            std::vector<double> cuts;
            add_cuts(from, to, b[k], b[(k + 1) % b.size()], cuts);
            for (const double s : cuts)
                if (s > 0 && s < 1) x.push_back(along(from, to, s)[0]);
        }
    }
    std::sort(x.begin(), x.end());
    constexpr double sliver = 1e-9;  // m: rounding of borders that are the same
    for (std::size_t m = 0; m + 1 < x.size(); ++m) {
        if (x[m + 1] - x[m] < sliver) continue;
        const double middle = 0.5 * (x[m] + x[m + 1]);
        for (const auto& [low, high] : intervals_at(a, edges_of_a, middle))
            for (const auto& [bottom, top] : intervals_at(b, edges_of_b, middle))
                if (std::min(high, top) - std::max(low, bottom) > sliver) return true;
    }
    return false;
}

std::vector<std::array<double, 2>> intervals_within(const Polygon& polygon, double x) {
    std::vector<double> cuts;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if ((a[0] > x) != (b[0] > x)) cuts.push_back(a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]));
    }
    std::sort(cuts.begin(), cuts.end());
    std::vector<std::array<double, 2>> intervals;
    for (std::size_t k = 0; k + 1 < cuts.size(); k += 2) intervals.push_back({cuts[k], cuts[k + 1]});
    return intervals;
}

bool folds_back(const Polygon& polygon, std::size_t& where) {
    const std::size_t n = polygon.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Point in = minus(polygon[(i + 1) % n], polygon[i]),
                    out = minus(polygon[(i + 2) % n], polygon[(i + 1) % n]);
        const double size = std::hypot(in[0], in[1]) * std::hypot(out[0], out[1]);
        if (std::abs(cross(in, out)) > 1e-9 * size || in[0] * out[0] + in[1] * out[1] >= 0) continue;
        where = (i + 1) % n + 1;
        return true;
    }
    return false;
}

bool crosses_itself(const Polygon& polygon, std::array<std::size_t, 2>& where) {
    const std::size_t n = polygon.size();
    const std::vector<std::array<double, 2>> reach = extents(polygon, 0);
    const Strips edges(reach);
    for (std::size_t i = 0; i < n; ++i)
        for (const std::size_t k : edges_near(edges, reach[i][0], reach[i][1])) {
            if (k < i + 2 || (i == 0 && k == n - 1)) continue;  // neighbours, through the closing edge too
            const Point &a = polygon[i], &b = polygon[i + 1], &c = polygon[k], &d = polygon[(k + 1) % n];
            if (edges_cross(a, b, c, d)) {
                where = {i + 1, k + 1};
                return true;
            }
        }
    return false;
}

namespace {

/// Accepted particles by cell, to refuse new ones that come too near.
class Occupied {
 public:
    explicit Occupied(double cell) : cell_(cell) {}
    bool is_free(double x, double z, double distance) const {
        const auto i = index(x), k = index(z);
        for (std::int64_t di = -1; di <= 1; ++di)
            for (std::int64_t dk = -1; dk <= 1; ++dk) {
                const auto found = cells_.find(key(i + di, k + dk));
                if (found == cells_.end()) continue;
                for (const Point& p : found->second)
                    if (std::hypot(p[0] - x, p[1] - z) < distance) return false;
            }
        return true;
    }
    void add(double x, double z) { cells_[key(index(x), index(z))].push_back({x, z}); }

 private:
    std::int64_t index(double a) const { return static_cast<std::int64_t>(std::floor(a / cell_)); }
    static std::int64_t key(std::int64_t i, std::int64_t k) { return i * 1'000'003 + k; }
    double cell_;
    std::unordered_map<std::int64_t, std::vector<Point>> cells_;
};

/// Where a particle of the layer whose depth is `depth` stands behind a face whose ball has the radius
/// `ball`: two sides that come nearer than two layers of each share the one between them.
double shared_depth(double depth, double ball, double spacing) {
    const double half_gap = 0.42 * spacing;  // of two layers side by side; they lean to each other at an edge
    if (ball < depth + 0.5 * half_gap) return ball;
    return std::min(depth, ball - half_gap);
}

/// Normal of a particle at (x, z), which stands `distance` behind the face `nearest`. Where two faces of a
/// sharp edge are as near it stands for both: across the edge, so that water slides along it on either side.
Point normal_between(const Solid& solid, double x, double z, double distance, std::size_t nearest) {
    const Point& own = solid.surface()[nearest].normal;
    constexpr double sharp = -0.3;  // n.n' of faces at less than 73 degrees
    const SurfaceSegment* first = nullptr;
    solid.for_surface(x - 1.02 * distance, x + 1.02 * distance, [&](std::size_t i) {
        const SurfaceSegment& other = solid.surface()[i];
        if ((first && &other > first) || own[0] * other.normal[0] + own[1] * other.normal[1] > sharp ||
            distance_to_segment(other, x, z) > 1.02 * distance)
            return;
        first = &other;
    });
    if (!first) return own;
    const Point across = minus(own, first->normal);
    const double length = std::hypot(across[0], across[1]);
    return {across[0] / length, across[1] / length};
}

}  // namespace

std::vector<BoundaryParticle> place_boundary(const Solid& solid, double spacing, double x0, double x1,
                                             double z1) {
    constexpr int layers = 4;
    // below it two particles would stand for one; what the depths ask for must pass
    const double nearest_allowed = 0.7 * spacing * (1 - 1e-6);
    std::vector<BoundaryParticle> placed;
    Occupied occupied(spacing);
    const auto place = [&](double x, double z) {
        if (x < x0 || x > x1 || z > z1 || !solid.contains(x, z)) return false;
        std::size_t nearest = 0;
        const double distance = solid.distance(x, z, nearest);
        if (distance > layers * spacing || !occupied.is_free(x, z, nearest_allowed)) return false;
        occupied.add(x, z);
        placed.push_back({.x = x,
                          .z = z,
                          .normal = normal_between(solid, x, z, distance, nearest),
                          .body = solid.surface()[nearest].body,
                          .carries_pressure = distance < 0.85 * spacing});
        return true;
    };
    const auto place_behind = [&](const SurfaceSegment& segment, const Point& at, int layer) {
        const double depth = (layer + 0.5) * spacing;
        const double ball = ball_behind(solid, at, segment.normal, depth + 0.5 * spacing);
        const double behind = shared_depth(depth, ball, spacing);
        if (layer > 0 && behind < depth - 0.3 * spacing) return false;
        return place(at[0] - behind * segment.normal[0], at[1] - behind * segment.normal[1]);
    };
    for (int layer = 0; layer < layers; ++layer)
        for (const bool is_mitre : {false, true})
            for (const SurfaceSegment& segment : solid.surface()) {
                const Point d = minus(segment.to, segment.from);
                const double length = std::hypot(d[0], d[1]);
                const Point t = {d[0] / length, d[1] / length};
                const int count = std::max(1, static_cast<int>(std::lround(length / spacing)));
                const double step = length / count, depth = (layer + 0.5) * spacing;
                for (int i = is_mitre ? -layers : 0; i < count + (is_mitre ? layers : 0); ++i) {
                    const bool is_behind = i >= 0 && i < count;
                    if (is_mitre == is_behind) continue;
                    // past the ends the lattice goes on with the true spacing
                    const double s = i < 0       ? (i + 0.5) * spacing
                                     : is_behind ? (i + 0.5) * step
                                                 : length + (i - count + 0.5) * spacing;
                    const auto at = [&](double along) {
                        return Point{segment.from[0] + along * t[0], segment.from[1] + along * t[1]};
                    };
                    if (is_behind) {
                        if (place_behind(segment, at(s), layer) || layer > 0) continue;
                        // the other side of an edge has other steps: a little beside there may be room
                        for (const double beside : {0.15, -0.15, 0.3, -0.3})
                            if (place_behind(segment, at(s + beside * step), layer)) break;
                        continue;
                    }
                    const double x = at(s)[0] - depth * segment.normal[0],
                                 z = at(s)[1] - depth * segment.normal[1];
                    std::size_t nearest = 0;
                    if (solid.distance(x, z, nearest) >= depth - 0.3 * spacing) place(x, z);
                }
            }
    return placed;
}

}  // namespace cmps
