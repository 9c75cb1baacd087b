#include "boussinesq/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/errors.hpp"
#include "common/run_record.hpp"

namespace boussinesq {

Simulation::Simulation(const Grid& grid, Bed bed, const FlowParameters& flow, FlowTerms terms, double courant,
                       WaveState initial, std::vector<std::unique_ptr<StepEffect>> effects)
    : grid_(grid),

      flow_(grid_, std::move(bed), flow, terms),
      courant_(courant),
      state_(std::move(initial)),
      effects_(std::move(effects)) {
    times_.effects.assign(effects_.size(), 0.0);
    // Water that falls from the highest level of the start to the deepest bed would run this fast; ten times
    // is no wave.
    double highest = 0;
    for (std::size_t k = ghost_cells; k < ghost_cells + grid_.cells; ++k)
        highest = std::max(highest, state_.depth[k] + flow_.bed().level(k));
    fastest_allowed_ = 10.0 * std::sqrt(2.0 * gravity * (highest + flow_.bed().largest_depth())) +
                       10.0 * flow_.survey(state_).fastest;
}

double Simulation::next_step() {
    common::PhaseTimer timer(times_.flow);
    const Survey survey = flow_.survey(state_);
    if (!std::isfinite(survey.fastest) || survey.fastest > fastest_allowed_ || survey.shallowest < 0.0) {
        std::size_t worst = ghost_cells;
        double worst_speed = -1.0;
        for (std::size_t k = ghost_cells; k < ghost_cells + grid_.cells; ++k) {
            const double speed =
                std::abs(state_.discharge[k] / std::max(state_.depth[k], flow_.parameters().dry_depth));
            if (!std::isfinite(speed) || !(state_.depth[k] >= 0.0)) {
                worst = k;
                worst_speed = speed;
                break;
            }
            if (speed > worst_speed) worst = k, worst_speed = speed;
        }
        throw common::RunError(
            fmt::format("unstable at t = {:.6g} s, step {}: depth {:.4g} m and velocity {:.4g} m/s in cell "
                        "{} (x = {:.6g} m); "
                        "the windows published so far are sound; try a smaller boussinesq.courant",
                        time_, steps_, state_.depth[worst], worst_speed, worst - ghost_cells,
                        grid_.centre(worst - ghost_cells)));
    }
    shallowest_ = survey.shallowest;
    step_ = courant_ * grid_.spacing / survey.fastest;
    largest_courant_ = std::max(largest_courant_, survey.fastest * step_ / grid_.spacing);
    return step_;
}

void Simulation::add_effect(std::unique_ptr<StepEffect> effect) {
    effects_.push_back(std::move(effect));
    times_.effects.push_back(0.0);
}

void Simulation::advance() {
    {
        common::PhaseTimer timer(times_.flow);
        flow_.advance(state_, step_);
    }
    begun_ = time_;
    time_ += step_;
    ++steps_;
    for (std::size_t e = 0; e < effects_.size(); ++e) {
        common::PhaseTimer timer(times_.effects[e]);
        effects_[e]->apply(state_, time_, step_);
    }
}

Simulation::Point Simulation::cell_at(double share, std::size_t cell) const {
    const std::size_t k = cell + ghost_cells;
    const double dry = flow_.parameters().dry_depth, film = 16.0 * dry * dry;
    double h = state_.depth[k], q = state_.discharge[k];
    if (share < 1.0) {
        const double h0 = flow_.before().depth[k], h1 = flow_.first_stage().depth[k];
        const double q0 = flow_.before().discharge[k], q1 = flow_.first_stage().discharge[k];
        h = std::max(h0 + share * (h1 - h0) + share * share * (h - h1), 0.0);
        q = q0 + share * (q1 - q0) + share * share * (q - q1);
    }
    return {h + bed().level(k), h > dry ? 2.0 * h * q / (h * h + std::max(h * h, film)) : 0.0};
}

void Simulation::sample(double t, Sample& sample) const {
    sample.elevation.resize(grid_.cells);
    sample.velocity.resize(grid_.cells);
    const double share = time_ > begun_ ? std::clamp((t - begun_) / (time_ - begun_), 0.0, 1.0) : 1.0;
    for (std::size_t cell = 0; cell < grid_.cells; ++cell) {
        const Point point = cell_at(share, cell);
        sample.elevation[cell] = point.elevation;
        sample.velocity[cell] = point.velocity;
    }
}

Simulation::Point Simulation::sample_at(double t, double x) const {
    const double share = time_ > begun_ ? std::clamp((t - begun_) / (time_ - begun_), 0.0, 1.0) : 1.0;
    const double place =
        std::clamp((x - grid_.offshore_end) / grid_.spacing - 0.5, 0.0, static_cast<double>(grid_.cells - 1));
    const auto i = std::min(static_cast<std::size_t>(place), grid_.cells - 2);
    const double s = place - static_cast<double>(i);
    const auto is_wet = [&](std::size_t cell) {
        return state_.depth[cell + ghost_cells] > flow_.parameters().dry_depth;
    };
    const auto sum = [&](std::size_t first, std::initializer_list<double> weights) {
        Point total{0.0, 0.0};
        for (const double weight : weights) {
            const Point point = cell_at(share, first++);
            total.elevation += weight * point.elevation;
            total.velocity += weight * point.velocity;
        }
        return total;
    };
    if (i >= 1 && i + 2 < grid_.cells && is_wet(i - 1) && is_wet(i) && is_wet(i + 1) && is_wet(i + 2))
        return sum(i - 1, {-s * (s - 1.0) * (s - 2.0) / 6.0, (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0,
                           -(s + 1.0) * s * (s - 2.0) / 2.0, (s + 1.0) * s * (s - 1.0) / 6.0});
    if (is_wet(i) == is_wet(i + 1)) return sum(i, {1.0 - s, s});
    return cell_at(share, s < 0.5 ? i : i + 1);
}

double Simulation::water() const {
    double sum = 0;
    for (std::size_t k = ghost_cells; k < ghost_cells + grid_.cells; ++k) sum += state_.depth[k];
    return sum * grid_.spacing;
}

double Simulation::energy() const {
    // Potential energy against still water, kinetic energy with that of the vertical motion (h^3 u_x^2 / 6).
    const bool dispersive = flow_.terms().dispersion;
    const double dry = flow_.parameters().dry_depth;
    double sum = 0;
    for (std::size_t k = ghost_cells; k < ghost_cells + grid_.cells; ++k) {
        const double h = state_.depth[k], b = bed().level(k), land = std::max(b, 0.0);
        sum += 0.5 * gravity * ((h + b) * (h + b) - land * land);
        if (h <= dry) continue;
        const double u = state_.discharge[k] / h;
        sum += 0.5 * h * u * u;
        if (dispersive && k > ghost_cells && k + 1 < ghost_cells + grid_.cells && state_.depth[k - 1] > dry &&
            state_.depth[k + 1] > dry) {
            const double stretch = (state_.discharge[k + 1] / state_.depth[k + 1] -
                                    state_.discharge[k - 1] / state_.depth[k - 1]) /
                                   (2.0 * grid_.spacing);
            sum += h * h * h * stretch * stretch / 6.0;
        }
    }
    return sum * grid_.spacing;
}

common::DataFile Simulation::save() const {
    common::DataFile file;
    const std::size_t n = grid_.padded();
    file.datasets["/depth"] = common::real64("m", {n}, {state_.depth.begin(), state_.depth.end()});
    file.datasets["/discharge"] =
        common::real64("m2/s", {n}, {state_.discharge.begin(), state_.discharge.end()});
    file.attributes["time"] = time_;
    file.attributes["begun"] = begun_;
    file.attributes["steps"] = steps_;
    file.attributes["water_made"] = flow_.water_made();
    file.attributes["water_through_ends"] = flow_.water_through_ends();
    file.attributes["largest_courant"] = largest_courant_;
    for (const auto& effect : effects_) {
        const auto memory = effect->memory();
        if (!memory.empty())
            file.datasets["/effects/" + effect->name()] = common::real64("1", {memory.size()}, memory);
    }
    return file;
}

void Simulation::restore(const common::DataFile& saved) {
    const auto& depth = saved.at("/depth").doubles();
    const auto& discharge = saved.at("/discharge").doubles();
    state_.depth.assign(depth.begin(), depth.end());
    state_.discharge.assign(discharge.begin(), discharge.end());
    time_ = saved.number("time");
    begun_ = time_;
    steps_ = saved.integer("steps");
    flow_.set_water(saved.number("water_made"), saved.number("water_through_ends"));
    largest_courant_ = saved.number("largest_courant");
    for (const auto& effect : effects_)
        if (saved.has("/effects/" + effect->name()))
            effect->recall(saved.at("/effects/" + effect->name()).doubles());
}

}  // namespace boussinesq
