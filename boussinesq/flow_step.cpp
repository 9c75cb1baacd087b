#include "boussinesq/flow_step.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "boussinesq/shallow_water.hpp"

namespace boussinesq {
namespace {

/// The cells of the tile that this sweep comes to next, asked for while the one in hand is computed: array by
/// array between its parts, since the processor takes only so many requests at once. Without it the sweeps of
/// a long flume wait for memory (README).
struct Ahead {
    /// `is_left`: the sweep goes shoreward. The flume holds `padded` cells.
    Ahead(const Tile& tile, bool is_left, std::size_t padded)
        : first(is_left ? std::min(tile.first + tile_cells, padded)
                        : tile.first - std::min(tile.first, tile_cells)),
          last(padded < short_flume ? first
               : is_left            ? std::min(first + tile_cells, padded)
                                    : tile.first) {}

    void fetch(const CellArray& values) const {
        for (std::size_t k = first; k < last; k += line) __builtin_prefetch(&values[k], 0);
    }
    void fetch_to_write(const CellArray& values) const {
        for (std::size_t k = first; k < last; k += line) __builtin_prefetch(&values[k], 1);
    }

 private:
    static constexpr std::size_t short_flume = 8192;  // padded cells that stay in the second-level cache
    static constexpr std::size_t line = 64 / sizeof(double);
    std::size_t first, last;  // padded cells [first, last)
};

}  // namespace

FlowStep::FlowStep(const Grid& grid, Bed bed, const FlowParameters& flow, FlowTerms terms)
    : grid_(grid),
      bed_(std::move(bed)),
      flow_(flow),
      terms_(terms),
      before_(grid),
      first_(grid),
      second_(grid),
      system_(grid),
      left_tile_(std::make_unique<Tile>()),
      right_tile_(std::make_unique<Tile>()) {
    mark_hydrostatic_cells();
}

void FlowStep::mark_hydrostatic_cells() {
    const std::size_t first = ghost_cells, last = ghost_cells + grid_.cells;  // inner cells [first, last)
    fixed_hydrostatic_.assign(grid_.padded(), 0);
    // The fourth-order values of the dispersive part reach two cells to either side: none of them may look
    // across a step. A high one takes the flow a quarter of its height to turn.
    for (std::size_t k = first; k <= last; ++k) {
        const double rise = std::abs(bed_.level(k) - bed_.level(k - 1));
        if (rise <= steepest_slope * grid_.spacing) continue;
        const std::size_t reach =
            std::max<std::size_t>(2, static_cast<std::size_t>(0.25 * rise / grid_.spacing));
        std::fill(fixed_hydrostatic_.data() + (k > reach ? k - reach : 0),
                  fixed_hydrostatic_.data() + std::min(k + reach, fixed_hydrostatic_.size()), 1);
    }
    // On land water runs as a film: dispersion made energy of its tip.
    for (std::size_t k = 0; k < fixed_hydrostatic_.size(); ++k)
        if (bed_.level(k) >= 0.0) fixed_hydrostatic_[k] = 1;
    // At an open end long waves leave by their own characteristics; nothing carries short ones out.
    constexpr std::size_t outlet = 4;
    if (flow_.offshore == End::open)
        std::fill(fixed_hydrostatic_.begin(), fixed_hydrostatic_.begin() + first + outlet, 1);
    if (flow_.shoreward == End::open)
        std::fill(fixed_hydrostatic_.end() - ghost_cells - outlet, fixed_hydrostatic_.end(), 1);
    hydrostatic_ = fixed_hydrostatic_;
    tile_has_hydrostatic_.assign((grid_.cells + tile_cells - 1) / tile_cells, 0);
    mark_hydrostatic_tiles();
}

void FlowStep::mark_hydrostatic_tiles() {
    for (std::size_t tile = 0; tile < grid_.cells; tile += tile_cells) {
        const std::size_t end = std::min(tile + tile_cells, grid_.cells) + 2 * ghost_cells;
        unsigned char marks = 0;
        for (std::size_t k = tile; k < end; ++k) marks |= hydrostatic_[k];
        tile_has_hydrostatic_[tile / tile_cells] = marks;
    }
}

void FlowStep::fill_ghosts(WaveState& state) const {
    double* h = state.depth.data();
    double* q = state.discharge.data();
    const std::size_t first = ghost_cells, last = ghost_cells + grid_.cells - 1;
    for (std::size_t k = 0; k < ghost_cells; ++k) {
        const std::size_t mirror = std::min(k, grid_.cells - 1);
        h[first - 1 - k] = h[first + mirror];
        q[first - 1 - k] = -q[first + mirror];
        h[last + 1 + k] = h[last - mirror];
        q[last + 1 + k] = -q[last - mirror];
    }
    const auto open = [&](std::size_t inner, double direction, auto ghost_at) {
        const double still = std::max(-bed_.level(inner), 0.0);
        const double speed = direction * 2.0 * (std::sqrt(gravity * h[inner]) - std::sqrt(gravity * still));
        // The surface goes on level: of equal depths it would follow a sloping bed, and still water would
        // run.
        const bool is_wet = h[inner] > flow_.dry_depth;
        for (std::size_t k = 0; k < ghost_cells; ++k) {
            const double rise = is_wet ? bed_.level(ghost_at(k)) - bed_.level(inner) : 0.0;
            h[ghost_at(k)] = std::max(h[inner] - rise, 0.0);
            q[ghost_at(k)] = h[inner] * speed;
        }
    };
    if (flow_.offshore == End::open) open(first, -1.0, [&](std::size_t k) { return first - 1 - k; });
    if (flow_.shoreward == End::open) open(last, 1.0, [&](std::size_t k) { return last + 1 + k; });
}

Survey FlowStep::survey(const WaveState& state) const {
    const double* h = state.depth.data();
    const double* q = state.discharge.data();
    const double thin = flow_.dry_depth, film = 16.0 * thin * thin;
    double fastest = 0, shallowest = h[ghost_cells], total = 0;
    for (std::size_t k = ghost_cells; k < ghost_cells + grid_.cells; ++k) {
        const double speed = std::abs(2.0 * h[k] * q[k] / (h[k] * h[k] + std::max(h[k] * h[k], film))) +
                             std::sqrt(gravity * std::max(h[k], 0.0));
        fastest = std::max(fastest, speed);
        shallowest = std::min(shallowest, h[k]);
        total += speed;  // not a number if any is: std::max would pass over it
    }
    return {.fastest = std::isfinite(total) ? fastest : total, .shallowest = shallowest};
}

void FlowStep::advance(WaveState& state, double step) {
    if (bores_ != nullptr) {
        for (std::size_t k = 0; k < hydrostatic_.size(); ++k)
            hydrostatic_[k] = fixed_hydrostatic_[k] | (*bores_)[k];
        mark_hydrostatic_tiles();
    }
    std::swap(before_, state);
    step_share_ = 1.0 / 6.0;
    stage(before_, 0.0, before_, 1.0, step, first_);
    stage(before_, 0.75, first_, 0.25, step, second_);
    step_share_ = 2.0 / 3.0;
    stage(before_, 1.0 / 3.0, second_, 2.0 / 3.0, step, state);
}

void FlowStep::stage(const WaveState& start, double start_share, WaveState& in, double stage_share,
                     double step, WaveState& out) {
    fill_ghosts(in);
    if (terms_.dispersion)
        terms_.shoreline ? stage_of<true, true>(start, start_share, in, stage_share, step, out)
                         : stage_of<true, false>(start, start_share, in, stage_share, step, out);
    else
        terms_.shoreline ? stage_of<false, true>(start, start_share, in, stage_share, step, out)
                         : stage_of<false, false>(start, start_share, in, stage_share, step, out);
}

template <bool with_dispersion, bool with_shoreline>
void FlowStep::stage_of(const WaveState& start, double start_share, WaveState& in, double stage_share,
                        double step, WaveState& out) {
    const std::size_t tiles = (grid_.cells + tile_cells - 1) / tile_cells;
    const std::size_t left_tiles = (tiles + 1) / 2;
    const auto count_of = [&](std::size_t tile) {
        return std::min(tile_cells, grid_.cells - tile * tile_cells);
    };
    const auto sweep = [&](Tile& tile, std::size_t index) {
        tile.first = index * tile_cells;
        tile.count = count_of(index);
        sweep_tile<with_dispersion, with_shoreline>(tile, start, start_share, in, stage_share, step, out);
    };
    ChainEnds ends;
    for (std::size_t pair = 0; pair < left_tiles; ++pair) {
        const std::size_t other = tiles - 1 - pair;
        const bool has_other = other >= left_tiles;
        sweep(*left_tile_, pair);
        if (has_other) sweep(*right_tile_, other);
        if constexpr (with_dispersion)
            eliminate(left_tile_.get(), has_other ? right_tile_.get() : nullptr, system_, ends);
    }
    if constexpr (with_dispersion)
        subtract_accelerations(system_, std::min(left_tiles * tile_cells, grid_.cells), grid_.cells,
                               stage_share * step, in.depth.data(), out.discharge.data());
}

template <bool with_dispersion, bool with_shoreline>
void FlowStep::sweep_tile(Tile& tile, const WaveState& start, double start_share, const WaveState& in,
                          double stage_share, double step, WaveState& out) {
    const bool with_start = start_share != 0.0;
    const Ahead ahead(tile, &tile == left_tile_.get(), grid_.padded());
    ahead.fetch(in.depth);
    load_tile(tile, in.depth.data(), in.discharge.data(), bed_.face_level.data(), flow_, with_shoreline);
    ahead.fetch(in.discharge);
    const bool wet = !with_shoreline || is_deep(tile, flow_);
    if (wet)
        wet_fluxes(tile, flow_);
    else
        shoreline_fluxes(tile, flow_, step);
    ahead.fetch(bed_.face_level);
    ahead.fetch_to_write(out.depth);
    if constexpr (with_dispersion) {
        ahead.fetch_to_write(system_.ratio);
        const unsigned char* hydrostatic = hydrostatic_.data();
        if (!wet)
            assemble_shoreline_dispersion(tile, flow_, hydrostatic);
        else if (tile_has_hydrostatic_[tile.first / tile_cells])
            assemble_wet_dispersion(tile, flow_, hydrostatic);
        else
            assemble_wet_dispersion(tile, flow_);
        // D is odd at a wall, even at an open end.
        const std::size_t last = tile.end() - 1;
        if (tile.first == 0) {
            const double wall = tile.off_diagonal[tile.begin()];
            tile.diagonal[tile.begin()] += flow_.offshore == End::wall ? -wall : wall;
            tile.off_diagonal[tile.begin()] = 0.0;
        }
        if (tile.first + tile.count == grid_.cells) {
            const double wall = tile.off_diagonal[last + 1];
            tile.diagonal[last] += flow_.shoreward == End::wall ? -wall : wall;
            tile.off_diagonal[last + 1] = 0.0;
        }
    }
    ahead.fetch_to_write(out.discharge);
    if constexpr (with_dispersion) ahead.fetch_to_write(system_.value);
    if (with_start) ahead.fetch(start.depth);
    if (tile.first == 0) water_through_ends_ += step_share_ * step * tile.depth_flux[tile.begin()];
    if (tile.first + tile.count == grid_.cells)
        water_through_ends_ -= step_share_ * step * tile.depth_flux[tile.end()];
    const double inverse = 1.0 / flow_.spacing;
    const std::size_t first = tile.first;
    const double* h_start = start.depth.data() + first;
    const double* q_start = start.discharge.data() + first;
    const double* q_in = in.discharge.data() + first;
    double* h_out = out.depth.data() + first;
    double* q_out = out.discharge.data() + first;
    const auto update = [&](auto discharge_rate) {
        const std::size_t from = tile.begin(), to = tile.end();
#pragma omp simd
        for (std::size_t t = from; t < to; ++t) {
            double rate = discharge_rate(t);
            if constexpr (with_dispersion) rate += tile.depth[t] * tile.elevation_slope[t];
            h_out[t] = start_share * h_start[t] +
                       stage_share * (tile.depth[t] + step * depth_rate(tile, t, inverse));
            q_out[t] = start_share * q_start[t] + stage_share * (q_in[t] + step * rate);
        }
    };
    if (with_start) ahead.fetch(start.discharge);
    if (wet) {
        update([&](std::size_t t) { return wet_discharge_rate(tile, t, inverse); });
    } else {
        update([&](std::size_t t) { return shoreline_discharge_rate(tile, t, inverse); });
        for (std::size_t t = tile.begin(); t < tile.end(); ++t)
            if (h_out[t] < 0.0) {
                water_made_ -= h_out[t] * flow_.spacing;
                h_out[t] = 0.0;
            }
    }
}

}  // namespace boussinesq
