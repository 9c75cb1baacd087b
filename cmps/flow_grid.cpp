#include "cmps/flow_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cmps/kernel.hpp"

namespace cmps {
namespace {

constexpr int fields = 4;                         // u, w, Du/Dt, Dw/Dt
constexpr int moments = 6;                        // of the fluid's weights
constexpr int stride = moments + 3 * fields + 1;  // + solid weight

}  // namespace

double linear_fit(const double m[6], const double v[3], double scale) {
    if (m[0] <= 0) return 0.0;
    // normalised so that thresholds do not depend on the kernel or the spacing
    const double mean = v[0] / m[0];
    const double ax = m[1] / m[0], az = m[2] / m[0];
    const double xx = m[3] / m[0] - ax * ax, xz = m[4] / m[0] - ax * az, zz = m[5] / m[0] - az * az;
    const double determinant = xx * zz - xz * xz;
    constexpr double enough =
        1e-3;  // variance of the neighbours' places over l0^2; below it no slope is known
    if (determinant < enough * enough * scale * scale) return mean;
    // How far the point lies outside its neighbours, in their standard deviations squared: what noise is
    // magnified by. A flat surface has about 9; drops and thin jets far more, and gave 20 to 190 m/s.
    constexpr double farthest = 16;
    const double outside = (zz * ax * ax - 2 * xz * ax * az + xx * az * az) / determinant;
    if (outside > farthest) return mean;
    const double cx = v[1] / m[0] - ax * mean, cz = v[2] / m[0] - az * mean;
    const double slope_x = (zz * cx - xz * cz) / determinant, slope_z = (xx * cz - xz * cx) / determinant;
    return mean - slope_x * ax - slope_z * az;
}

FlowGrid::FlowGrid(const FlowGridSettings& settings, const Solid& solid, double particle_spacing)
    : particle_spacing_(particle_spacing), reach_(std::max(2.1 * particle_spacing, 1.5 * settings.spacing)) {
    const auto axis = [&](double from, double to) {
        const int cells = std::max(1, static_cast<int>(std::lround((to - from) / settings.spacing)));
        std::vector<double> nodes;
        for (int i = 0; i <= cells; ++i) nodes.push_back(from + (to - from) * i / cells);
        return nodes;
    };
    x = axis(settings.x0, settings.x1), z = axis(settings.z0, settings.z1);
    const std::size_t nodes = x.size() * z.size();
    velocity.resize(2 * nodes), acceleration.resize(2 * nodes), wet.resize(nodes);
    sums_.resize(stride * nodes);
    full_weight_ = 3.14159265358979 * reach_ * reach_ / 7.0 /
                   (particle_spacing * particle_spacing);  // integral of w / l0^2

    std::vector<char> is_solid(nodes);
    for (std::size_t k = 0; k < z.size(); ++k)
        for (std::size_t i = 0; i < x.size(); ++i) is_solid[k * x.size() + i] = solid.contains(x[i], z[k]);
    source_.resize(nodes), normal_.assign(nodes, Point{0, 0});
    for (std::size_t k = 0; k < z.size(); ++k)
        for (std::size_t i = 0; i < x.size(); ++i) {
            const std::size_t node = k * x.size() + i;
            source_[node] = static_cast<std::int32_t>(node);
            std::size_t face = 0;
            const bool is_on_face = solid.distance(x[i], z[k], face) < 1e-6 * settings.spacing;
            if (is_on_face || is_solid[node]) normal_[node] = solid.surface()[face].normal;
            if (!is_solid[node]) continue;
            source_[node] = -1;
            source_[node] = nearest_free(is_solid, i, k);
        }
}

/// The nearest node outside the solid, ring after ring; -1 when all is solid.
std::int32_t FlowGrid::nearest_free(const std::vector<char>& is_solid, std::size_t i, std::size_t k) const {
    const auto columns = static_cast<std::ptrdiff_t>(x.size()), rows = static_cast<std::ptrdiff_t>(z.size());
    const auto at_i = static_cast<std::ptrdiff_t>(i), at_k = static_cast<std::ptrdiff_t>(k);
    const double dx = columns > 1 ? x[1] - x[0] : 1.0, dz = rows > 1 ? z[1] - z[0] : 1.0;
    double least = std::numeric_limits<double>::infinity();
    std::int32_t nearest = -1;
    for (std::ptrdiff_t ring = 1; ring < std::max(columns, rows); ++ring) {
        if (static_cast<double>(ring) * std::min(dx, dz) > least) break;  // no nearer one can follow
        for (std::ptrdiff_t kk = std::max<std::ptrdiff_t>(0, at_k - ring);
             kk <= std::min(rows - 1, at_k + ring); ++kk) {
            const bool is_edge = std::abs(kk - at_k) == ring;
            for (std::ptrdiff_t ii = at_i - ring; ii <= at_i + ring; ii += is_edge ? 1 : 2 * ring) {
                if (ii < 0 || ii >= columns || is_solid[kk * columns + ii]) continue;
                const double d =
                    std::hypot(static_cast<double>(ii - at_i) * dx, static_cast<double>(kk - at_k) * dz);
                if (d < least) least = d, nearest = static_cast<std::int32_t>(kk * columns + ii);
            }
        }
    }
    return nearest;
}

void FlowGrid::evaluate(const Particles& particles, const WaterMotion& motion) {
    std::fill(sums_.begin(), sums_.end(), 0.0);
    const WendlandKernel kernel{reach_};
    const double dx = x.size() > 1 ? x[1] - x[0] : 1.0, dz = z.size() > 1 ? z[1] - z[0] : 1.0;
    const auto last = [](const std::vector<double>& axis) {
        return static_cast<std::ptrdiff_t>(axis.size()) - 1;
    };
    for (std::size_t j = 0; j < particles.size(); ++j) {
        const double px = particles.x[j], pz = particles.z[j];
        if (px < x.front() - reach_ || px > x.back() + reach_ || pz < z.front() - reach_ ||
            pz > z.back() + reach_)
            continue;
        const std::ptrdiff_t i0 =
            std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(std::ceil((px - reach_ - x[0]) / dx)));
        const std::ptrdiff_t i1 =
            std::min(last(x), static_cast<std::ptrdiff_t>(std::floor((px + reach_ - x[0]) / dx)));
        const std::ptrdiff_t k0 =
            std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(std::ceil((pz - reach_ - z[0]) / dz)));
        const std::ptrdiff_t k1 =
            std::min(last(z), static_cast<std::ptrdiff_t>(std::floor((pz + reach_ - z[0]) / dz)));
        const bool is_fluid = particles.is_fluid(j);
        const double value[fields] = {motion.u[j], motion.w[j], motion.du_dt[j], motion.dw_dt[j]};
        for (std::ptrdiff_t k = k0; k <= k1; ++k)
            for (std::ptrdiff_t i = i0; i <= i1; ++i) {
                const double rx = px - x[i], rz = pz - z[k], w = kernel.weight(rx * rx + rz * rz);
                double* const sum = &sums_[stride * (static_cast<std::size_t>(k) * x.size() + i)];
                if (!is_fluid) {
                    sum[stride - 1] += w;
                    continue;
                }
                sum[0] += w, sum[1] += w * rx, sum[2] += w * rz;
                sum[3] += w * rx * rx, sum[4] += w * rx * rz, sum[5] += w * rz * rz;
                for (int f = 0; f < fields; ++f) {
                    double* const v = sum + moments + 3 * f;
                    v[0] += w * value[f], v[1] += w * value[f] * rx, v[2] += w * value[f] * rz;
                }
            }
    }
    const double scale = particle_spacing_ * particle_spacing_;
    for (std::size_t node = 0; node < wet.size(); ++node) {
        const std::int32_t source = source_[node];
        double result[fields] = {}, share = 0;
        if (source >= 0) {
            const double* const sum = &sums_[stride * static_cast<std::size_t>(source)];
            const double solid = std::min(sum[stride - 1] / full_weight_, 0.9);
            // the kernel's share is smeared over its reach: 0.1 .. 0.9 becomes 0 .. 1
            share = std::clamp((sum[0] / full_weight_ / (1.0 - solid) - 0.1) / 0.8, 0.0, 1.0);
            if (share > 0)
                for (int f = 0; f < fields; ++f) result[f] = linear_fit(sum, sum + moments + 3 * f, scale);
        }
        const Point& normal = normal_[node];
        for (int f = 0; f < fields; f += 2) {
            const double across = result[f] * normal[0] + result[f + 1] * normal[1];
            result[f] -= across * normal[0], result[f + 1] -= across * normal[1];
        }
        wet[node] = static_cast<float>(share);
        for (int c = 0; c < 2; ++c) {
            velocity[2 * node + c] = static_cast<float>(result[c]);
            acceleration[2 * node + c] = static_cast<float>(result[2 + c]);
        }
    }
}

}  // namespace cmps
