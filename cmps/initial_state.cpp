#include "cmps/initial_state.hpp"

#include <algorithm>
#include <cmath>

namespace cmps {
namespace {

/// One column of water between z0 and z1; `carry` is the fraction of a particle still owed.
void fill_column(double x, double width, double z0, double z1, double spacing, double& carry,
                 Particles& particles) {
    const double exact = (z1 - z0) * width / (spacing * spacing) + carry;
    const int count = static_cast<int>(std::lround(exact));
    if (count <= 0) {
        carry = exact;
        return;
    }
    carry = exact - count;
    const double step = (z1 - z0) / count;
    for (int k = 0; k < count; ++k)
        particles.add_fluid(x, z0 + (k + 0.5) * step, static_cast<std::int32_t>(particles.fluid));
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

void fill_water(const Solid& solid, double spacing, double x0, double x1, double bottom,
                const std::function<double(double)>& surface, Particles& particles) {
    const int columns = std::max(1, static_cast<int>(std::lround((x1 - x0) / spacing)));
    const double width = (x1 - x0) / columns;
    double carry = 0;
    for (int c = 0; c < columns; ++c) {
        const double x = x0 + (c + 0.5) * width, top = surface(x);
        for (const auto& [low, high] : solid.free_intervals(x, bottom, top))
            fill_column(x, width, low, high, spacing, carry, particles);
    }
}

void fill_polygons(const Solid& solid, double spacing, const std::vector<Polygon>& water,
                   const std::vector<Point>& velocity, Particles& particles) {
    for (std::size_t p = 0; p < water.size(); ++p) {
        const Polygon& polygon = water[p];
        const std::size_t first = particles.size();
        double x0 = 1e300, x1 = -1e300, z0 = 1e300, z1 = -1e300;
        for (const Point& corner : polygon) {
            x0 = std::min(x0, corner[0]), x1 = std::max(x1, corner[0]);
            z0 = std::min(z0, corner[1]), z1 = std::max(z1, corner[1]);
        }
        // the solid's faces may stand inside the polygon: columns follow what is left free
        const int columns = std::max(1, static_cast<int>(std::lround((x1 - x0) / spacing)));
        const double width = (x1 - x0) / columns;
        double carry = 0;
        for (int c = 0; c < columns; ++c) {
            const double x = x0 + (c + 0.5) * width;
            std::vector<double> cuts;
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const Point &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
                if ((a[0] > x) != (b[0] > x))
                    cuts.push_back(a[1] + (b[1] - a[1]) * (x - a[0]) / (b[0] - a[0]));
            }
            std::sort(cuts.begin(), cuts.end());
            for (std::size_t k = 0; k + 1 < cuts.size(); k += 2)
                for (const auto& [low, high] : solid.free_intervals(x, cuts[k], cuts[k + 1]))
                    fill_column(x, width, low, high, spacing, carry, particles);
        }
        if (velocity.empty()) continue;
        for (std::size_t i = first; i < particles.size(); ++i)
            particles.u[i] = velocity[p][0], particles.w[i] = velocity[p][1];
    }
}

}  // namespace cmps
