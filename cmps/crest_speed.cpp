#include "cmps/crest_speed.hpp"

#include <algorithm>
#include <cmath>

#include "cmps/linear_waves.hpp"

namespace cmps {
namespace {

constexpr double column_width = 2.0, cell_height = 1.5;  // spacings: three particles in a full cell
constexpr int fewest = 2;                                // particles that make a cell water, not spray
constexpr double least_crest = 1.5;                      // spacings above still water
constexpr double least_depth = 6.0;                      // spacings: a wave of fewer is not resolved

}  // namespace

Crest CrestSpeed::fastest(const Particles& particles, double x0, double x1) {
    Crest found;
    double low = 1e300, high = -1e300;
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
        low = std::min(low, particles.z[i]), high = std::max(high, particles.z[i]);
    if (!(x1 > x0) || !(high > low)) return found;
    const double width = column_width * spacing_, height = cell_height * spacing_;
    const auto columns = static_cast<std::size_t>((x1 - x0) / width) + 1;
    // spray far above is no crest: the grid ends a depth above the still water
    const double top = std::min(high, still_level_ + std::max(still_level_ - low, height));
    const auto rows = static_cast<std::size_t>(std::max(top - low, 0.0) / height) + 1;
    cells_.assign(columns * rows, {});
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i) {
        const double x = particles.x[i] - x0, z = particles.z[i];
        if (x < 0 || x > x1 - x0 || z > top) continue;
        Cell& cell =
            cells_[static_cast<std::size_t>(x / width) * rows + static_cast<std::size_t>((z - low) / height)];
        ++cell.count, cell.u += particles.u[i], cell.w += particles.w[i];
        cell.lowest = std::min(cell.lowest, z), cell.highest = std::max(cell.highest, z);
    }
    for (std::size_t c = 0; c < columns; ++c) {
        const Cell* const column = &cells_[c * rows];
        std::size_t bottom = 0;
        while (bottom < rows && column[bottom].count < fewest) ++bottom;
        std::size_t end = bottom;  // what stands without a gap on the ground: drops in flight are no crest
        while (end < rows && column[end].count >= fewest) ++end;
        if (end == bottom) continue;
        const Cell& crest = column[end - 1];
        const double surface = crest.highest + 0.5 * spacing_;
        const double depth = surface - column[bottom].lowest + 0.5 * spacing_;
        if (surface < still_level_ + least_crest * spacing_ || depth < least_depth * spacing_) continue;
        const double speed = std::hypot(crest.u, crest.w) / crest.count;
        const double celerity =
            period_ > 0 ? phase_speed(period_, depth, gravity_) : std::sqrt(gravity_ * depth);
        if (speed > found.speed_over_celerity * celerity)
            found = {speed / celerity, x0 + (static_cast<double>(c) + 0.5) * width};
    }
    return found;
}

}  // namespace cmps
