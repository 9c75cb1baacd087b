#include "boussinesq/effects/breaking.hpp"

#include <algorithm>
#include <cmath>

namespace boussinesq {
namespace {

void note(BreakingRecord& record, double t, double x) {
    if (record.first_time < 0.0) {
        record.first_time = t;
        record.first_place = record.most_offshore = x;
    }
    record.most_offshore = std::min(record.most_offshore, x);
}

}  // namespace

void BoreCells::clear() {
    std::fill(cells_.begin(), cells_.end(), static_cast<unsigned char>(0));
}

void BoreCells::add(std::size_t k, double h) {
    const auto width = static_cast<std::size_t>(std::ceil(h / spacing_));
    const std::size_t first = ghost_cells + 1, last = cells_.size() - ghost_cells - 2;
    const std::size_t from = k > first + width ? k - width : first, to = std::min(k + width, last);
    std::fill(cells_.data() + from, cells_.data() + to + 1, static_cast<unsigned char>(1));
}

bool BoreCells::is_steep(const WaveState& state, std::size_t k) const {
    // Over half a depth: ripples of a few fine cells are no front.
    const auto half = std::max<std::size_t>(1, static_cast<std::size_t>(0.25 * state.depth[k] / spacing_));
    const std::size_t offshore = k > half ? k - half : 0, shoreward = std::min(k + half, cells_.size() - 1);
    const double fall =
        state.depth[offshore] + bed_.level(offshore) - state.depth[shoreward] - bed_.level(shoreward);
    return std::abs(fall) > steepest_front * spacing_ * static_cast<double>(shoreward - offshore);
}

bool BoreCells::sustains(const WaveState& state, std::size_t k) const {
    constexpr double least_depth_ratio = 1.4;  // (sqrt(1 + 8 Fr^2) - 1) / 2 at Fr = 1.3
    const auto level = [&](std::size_t i) { return state.depth[i] + bed_.level(i); };
    const std::size_t first = ghost_cells, last = cells_.size() - ghost_cells - 1;
    const bool falls_shoreward = level(k - 1) > level(k + 1);
    std::size_t low = k, high = k;
    if (falls_shoreward) {
        while (low < last && level(low + 1) < level(low)) ++low;
        while (high > first && level(high - 1) > level(high)) --high;
    } else {
        while (low > first && level(low - 1) < level(low)) --low;
        while (high < last && level(high + 1) > level(high)) ++high;
    }
    return level(high) - level(low) > (least_depth_ratio - 1.0) * state.depth[low];
}

void BoreCells::save(std::vector<double>& memory) const {
    memory.insert(memory.end(), cells_.begin(), cells_.end());
}

void BoreCells::restore(const double* memory) {
    for (std::size_t k = 0; k < cells_.size(); ++k) cells_[k] = memory[k] != 0.0 ? 1 : 0;
}

EddyViscosity::EddyViscosity(const Grid& grid, const Bed& bed, const FlowParameters& flow, std::size_t first,
                             EddyViscosityConstants constants)
    : grid_(grid),
      dry_depth_(flow.dry_depth),
      first_(first),
      constants_(constants),
      age_(grid.padded(), 0.0),
      viscosity_(grid.padded(), 0.0),
      new_age_(grid.padded(), 0.0),
      bores_(grid, bed) {}

void EddyViscosity::find_fronts(const WaveState& state, double t, double step) {
    const double* h = state.depth.data();
    const double* q = state.discharge.data();
    const double half = 0.5 / grid_.spacing;
    const std::size_t last = ghost_cells + grid_.cells - 1;
    any_ = false;
    new_age_[first_ - 1] = new_age_[last] = 0.0;
    if (constants_.becomes_bore) bores_.clear();
    for (std::size_t k = first_; k < last; ++k) {
        const double rise = (q[k - 1] - q[k + 1]) * half;
        viscosity_[k] = 0.0;
        new_age_[k] = 0.0;
        // The lowest threshold first: most cells stop here.
        if (!(rise * rise > constants_.end * constants_.end * gravity * h[k]) || rise <= 0.0 ||
            h[k] <= 10.0 * dry_depth_)
            continue;
        const double speed = std::sqrt(gravity * h[k]);
        const double age = std::max(age_[k], std::max(age_[k - 1], age_[k + 1]));
        const double share = std::min(age * speed / (constants_.transition * h[k]), 1.0);
        const double threshold = (constants_.start + share * (constants_.end - constants_.start)) * speed;
        const bool is_steep = constants_.becomes_bore && bores_.is_steep(state, k);
        if (is_steep && bores_.sustains(state, k)) bores_.add(k, h[k]);
        // A front that viscosity has just laid lower than its threshold is still the same front.
        if (age > 0.0) new_age_[k] = age + step;
        if (rise <= threshold) continue;
        new_age_[k] = age + step;
        viscosity_[k] =
            std::min(rise / threshold - 1.0, 1.0) * constants_.mixing * constants_.mixing * h[k] * rise;
        if (age == 0.0) note(record_, t, grid_.centre(k - ghost_cells));
        if (constants_.becomes_bore && share == 1.0 && !is_steep && bores_.sustains(state, k))
            bores_.add(k, h[k]);
        any_ = true;
    }
    std::swap(age_, new_age_);
}

void EddyViscosity::diffuse(WaveState& state, double step, std::size_t first, std::size_t last) {
    // h u - dt (nu h u_x)_x = q* for u on cells first..last, viscosity zero beyond them.
    const double* h = state.depth.data();
    double* q = state.discharge.data();
    const double scale = step / (grid_.spacing * grid_.spacing);
    const auto face = [&](std::size_t k) {
        return scale * 0.25 * (viscosity_[k - 1] + viscosity_[k]) * (h[k - 1] + h[k]);
    };
    double before = 0.0, ratio = 0.0, value = 0.0;
    for (std::size_t k = first; k <= last; ++k) {
        const double after = k < last ? face(k + 1) : 0.0;
        const double pivot = 1.0 / (std::max(h[k], dry_depth_) + before + after - before * ratio);
        ratio = after * pivot;
        value = (q[k] + before * value) * pivot;
        new_age_[k] = ratio;
        q[k] = value;
        before = after;
    }
    double above = 0.0;
    for (std::size_t k = last + 1; k-- > first;) {
        above = q[k] + new_age_[k] * above;
        q[k] = std::max(h[k], dry_depth_) * above;
    }
}

void EddyViscosity::apply(WaveState& state, double t, double step) {
    find_fronts(state, t, step);
    if (!any_) return;
    const std::size_t end = ghost_cells + grid_.cells - 1;
    for (std::size_t k = ghost_cells + 1; k < end; ++k) {
        if (viscosity_[k] == 0.0) continue;
        std::size_t last = k;
        while (last + 1 < end && viscosity_[last + 1] != 0.0) ++last;
        diffuse(state, step, k - 1, last + 1);  // faces of the front's outer cells take part
        k = last + 1;
    }
}

std::vector<double> EddyViscosity::memory() const {
    std::vector<double> values{record_.first_time, record_.first_place, record_.most_offshore};
    values.insert(values.end(), age_.begin(), age_.end());
    bores_.save(values);
    return values;
}

void EddyViscosity::recall(const std::vector<double>& values) {
    record_ = {.first_time = values.at(0), .first_place = values.at(1), .most_offshore = values.at(2)};
    std::copy_n(values.begin() + 3, age_.size(), age_.begin());
    bores_.restore(values.data() + 3 + age_.size());
}

HydrostaticBores::HydrostaticBores(const Grid& grid, const Bed& bed, const FlowParameters& flow,
                                   std::size_t first)
    : grid_(grid), dry_depth_(flow.dry_depth), first_(first), bores_(grid, bed) {
    fronts_.reserve(grid.cells);
}

void HydrostaticBores::apply(WaveState& state, double t, double) {
    const double* h = state.depth.data();
    const double* q = state.discharge.data();
    const double half = 0.5 / grid_.spacing;
    fronts_.clear();
    const std::size_t last = ghost_cells + grid_.cells - 1;
    for (std::size_t k = first_; k < last; ++k) {
        const double rise = (q[k - 1] - q[k + 1]) * half;
        if (rise <= 0.0 || h[k] <= 10.0 * dry_depth_) continue;
        const double speed = std::sqrt(gravity * h[k]);
        const bool is_old = bores_.contains(k - 1) || bores_.contains(k) || bores_.contains(k + 1);
        if (rise > (is_old ? 0.3 : 0.6) * speed && (!is_old || bores_.sustains(state, k))) {
            fronts_.push_back(k);
            if (!is_old) note(record_, t, grid_.centre(k - ghost_cells));
        }
    }
    bores_.clear();
    for (const std::size_t k : fronts_) bores_.add(k, h[k]);
}

std::vector<double> HydrostaticBores::memory() const {
    std::vector<double> values{record_.first_time, record_.first_place, record_.most_offshore};
    bores_.save(values);
    return values;
}

void HydrostaticBores::recall(const std::vector<double>& values) {
    record_ = {.first_time = values.at(0), .first_place = values.at(1), .most_offshore = values.at(2)};
    bores_.restore(values.data() + 3);
}

}  // namespace boussinesq
