#include "cmps/initial_state.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/perturbation.hpp"

namespace cmps {
namespace {

constexpr int lines_of_a_column = 8;

using Intervals = std::vector<std::array<double, 2>>;

double total(const Intervals& intervals) {
    double sum = 0;
    for (const auto& [low, high] : intervals) sum += high - low;
    return sum;
}

/// Area of a column, m2.
double area_of_column(double middle, double width, const FreeIntervals& free) {
    double sum = 0;
    for (int i = 0; i < lines_of_a_column; ++i)
        sum += total(free(middle + ((i + 0.5) / lines_of_a_column - 0.5) * width));
    return sum * width / lines_of_a_column;
}

/// Calls visit(middle, width) for columns from `from` to `to`, about a spacing wide and none across a
/// vertical face of the solid or one of `more`.
template <class Visit>
void for_columns(const Solid& solid, double spacing, double from, double to, const Polygon& more,
                 const Visit& visit) {
    const double same = 1e-6 * spacing;
    std::vector<double> faces = {from, to};
    const auto add = [&](const Point& a, const Point& b) {
        if (std::abs(a[0] - b[0]) < same && a[0] > from + same && a[0] < to - same) faces.push_back(a[0]);
    };
    for (const SurfaceSegment& segment : solid.surface()) add(segment.from, segment.to);
    for (std::size_t i = 0; i < more.size(); ++i) add(more[i], more[(i + 1) % more.size()]);
    std::sort(faces.begin(), faces.end());
    for (std::size_t k = 0; k + 1 < faces.size(); ++k) {
        const double length = faces[k + 1] - faces[k];
        if (length < same) continue;
        const int columns = std::max(1, static_cast<int>(std::lround(length / spacing)));
        const double width = length / columns;
        for (int c = 0; c < columns; ++c) visit(faces[k] + (c + 0.5) * width, width);
    }
}

/// Particles of a column; `carry` is the fraction of a particle still owed.
void fill_column(double spacing, double middle, double width, const FreeIntervals& free, double& carry,
                 Particles& particles) {
    const Intervals intervals = free(middle);
    const double length = total(intervals), area = area_of_column(middle, width, free);
    if (length == 0) {
        carry += area / (spacing * spacing);
        return;
    }
    for (const auto& [low, high] : intervals) {
        const double exact = area * (high - low) / length / (spacing * spacing) + carry;
        const int count = std::max(0, static_cast<int>(std::lround(exact)));
        carry = exact - count;
        const double step = (high - low) / count;
        for (int k = 0; k < count; ++k)
            particles.add_fluid(middle, low + (k + 0.5) * step, static_cast<std::int32_t>(particles.fluid));
    }
}

/// Extent of a polygon in x, and what of it the solid leaves.
std::array<double, 2> extent(const Polygon& polygon) {
    double x0 = 1e300, x1 = -1e300;
    for (const Point& p : polygon) x0 = std::min(x0, p[0]), x1 = std::max(x1, p[0]);
    return {x0, x1};
}
FreeIntervals outside(const Solid& solid, const Polygon& polygon) {
    return [&](double x) {
        Intervals free;
        for (const auto& [low, high] : intervals_within(polygon, x))
            for (const auto& interval : solid.free_intervals(x, low, high)) free.push_back(interval);
        return free;
    };
}

}  // namespace

Particles make_boundary(const std::vector<BoundaryParticle>& placed) {
    Particles particles;
    for (const bool with_pressure : {false, true})
        for (const BoundaryParticle& boundary : placed) {
            if (boundary.carries_pressure != with_pressure) continue;
            particles.for_each_array([](auto& array) { array.push_back({}); });
            particles.x.back() = boundary.x, particles.z.back() = boundary.z;
            particles.normal_x.back() = boundary.normal[0], particles.normal_z.back() = boundary.normal[1];
            particles.body.back() = boundary.body;
            ++(with_pressure ? particles.walls : particles.dummies);
        }
    return particles;
}

double free_area(const Solid& solid, double spacing, double x0, double x1, const FreeIntervals& free) {
    double area = 0;
    for_columns(solid, spacing, x0, x1, {},
                [&](double middle, double width) { area += area_of_column(middle, width, free); });
    return area;
}

double free_area(const Solid& solid, double spacing, const Polygon& polygon) {
    const auto [x0, x1] = extent(polygon);
    const FreeIntervals free = outside(solid, polygon);
    double area = 0;
    for_columns(solid, spacing, x0, x1, polygon,
                [&](double middle, double width) { area += area_of_column(middle, width, free); });
    return area;
}

void fill_water(const Solid& solid, double spacing, double x0, double x1, const FreeIntervals& free,
                Particles& particles) {
    double carry = 0;
    for_columns(solid, spacing, x0, x1, {}, [&](double middle, double width) {
        fill_column(spacing, middle, width, free, carry, particles);
    });
}

void fill_polygons(const Solid& solid, double spacing, const std::vector<Polygon>& water,
                   const std::vector<Point>& velocity, Particles& particles) {
    for (std::size_t p = 0; p < water.size(); ++p) {
        const Polygon& polygon = water[p];
        const std::size_t first = particles.size();
        const auto [x0, x1] = extent(polygon);
        const FreeIntervals free = outside(solid, polygon);
        double carry = 0;
        for_columns(solid, spacing, x0, x1, polygon, [&](double middle, double width) {
            fill_column(spacing, middle, width, free, carry, particles);
        });
        if (velocity.empty()) continue;
        for (std::size_t i = first; i < particles.size(); ++i)
            particles.u[i] = velocity[p][0], particles.w[i] = velocity[p][1];
    }
}

void perturb(Particles& particles, double spacing, std::int64_t seed) {
    if (seed == 0) return;
    constexpr double units = 2 * std::numeric_limits<double>::epsilon();
    const auto move = [&](double& coordinate, std::uint64_t index) {
        coordinate += (1e-12 * spacing + units * std::abs(coordinate)) * common::perturbation(seed, index);
    };
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i) {
        const auto identity = static_cast<std::uint64_t>(particles.identity[i]);
        move(particles.x[i], 2 * identity);
        move(particles.z[i], 2 * identity + 1);
    }
}

}  // namespace cmps
