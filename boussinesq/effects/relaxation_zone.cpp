#include "boussinesq/effects/relaxation_zone.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace boussinesq {

ZoneRates cubic_rates(const Grid& grid, double inner, double outer, double largest) {
    ZoneRates zone;
    const double low = std::min(inner, outer), high = std::max(inner, outer);
    for (std::size_t cell = 0; cell < grid.cells; ++cell) {
        const double x = grid.centre(cell);
        if (x < low || x > high) continue;
        if (zone.rate.empty()) zone.first = cell;
        const double share = (x - inner) / (outer - inner);
        zone.rate.push_back(largest * share * share * share);
    }
    return zone;
}

GenerationZone::GenerationZone(const Grid& grid, const Bed& bed, ZoneRates rates,
                               std::unique_ptr<IncidentWave> wave, double ramp)
    : rates_(std::move(rates)), wave_(std::move(wave)), ramp_(ramp), spacing_(grid.spacing) {
    for (std::size_t i = 0; i < rates_.rate.size(); ++i) {
        x_.push_back(grid.centre(rates_.first + i));
        bed_.push_back(bed.level(ghost_cells + rates_.first + i));
    }
    elevation_.resize(x_.size());
    velocity_.resize(x_.size());
}

void GenerationZone::apply(WaveState& state, double t, double step) {
    wave_->at(t, x_, elevation_, velocity_);
    const double share = ramp_ > 0 ? std::clamp(t / ramp_, 0.0, 1.0) : 1.0;
    const double amplitude = 0.5 - 0.5 * std::cos(std::numbers::pi * share);
    double* h = state.depth.data() + ghost_cells + rates_.first;
    double* q = state.discharge.data() + ghost_cells + rates_.first;
    double added = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
        const double strength = rates_.rate[i] * step, keep = 1.0 / (1.0 + strength);
        const double wave_depth = std::max(amplitude * elevation_[i] - bed_[i], 0.0);
        const double depth = keep * (h[i] + strength * wave_depth);
        const double velocity = keep * (q[i] / h[i] + strength * amplitude * velocity_[i]);
        added += depth - h[i];
        h[i] = depth;
        q[i] = depth * velocity;
    }
    water_added_ += added * spacing_;
}

void Sponge::apply(WaveState& state, double, double step) {
    double* q = state.discharge.data() + ghost_cells + rates_.first;
    for (std::size_t i = 0; i < rates_.rate.size(); ++i) q[i] /= 1.0 + rates_.rate[i] * step;
}

}  // namespace boussinesq
