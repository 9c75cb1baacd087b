/// A flume for tests: the flow alone, from an initial shape to a time, without files.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "boussinesq/flow_step.hpp"

namespace boussinesq_test {

using Polyline = std::vector<std::array<double, 2>>;
using Shape = std::function<double(double)>;

struct Flume {
    boussinesq::Grid grid;
    boussinesq::FlowStep flow;
    boussinesq::WaveState state;
    double time = 0;
    int steps = 0;

    Flume(const Polyline& bed, double spacing, boussinesq::FlowParameters parameters,
          boussinesq::FlowTerms terms)
        : grid{.offshore_end = bed.front()[0],
               .spacing = spacing,
               .cells = static_cast<std::size_t>(std::lround((bed.back()[0] - bed.front()[0]) / spacing))},
          flow(grid, boussinesq::Bed(grid, bed), with_spacing(parameters, spacing), terms),
          state(grid) {}

    static boussinesq::FlowParameters with_spacing(boussinesq::FlowParameters parameters, double spacing) {
        parameters.spacing = spacing;
        return parameters;
    }

    /// Cell averages of elevation and velocity by three-point Gauss quadrature of depth and discharge.
    void start(const Shape& elevation, const Shape& velocity) {
        const double node = std::sqrt(0.6) * 0.5 * grid.spacing;
        for (std::size_t i = 0; i < grid.cells; ++i) {
            const std::size_t k = i + boussinesq::ghost_cells;
            double depth = 0, discharge = 0;
            for (int j = -1; j <= 1; ++j) {
                const double x = grid.centre(i) + j * node, weight = j == 0 ? 8.0 / 18.0 : 5.0 / 18.0;
                const double h = std::max(elevation(x) - flow.bed().level(k), 0.0);
                depth += weight * h;
                discharge += weight * h * velocity(x);
            }
            state.depth[k] = depth;
            state.discharge[k] = discharge;
        }
    }

    void run_until(double end, double courant = 0.5, const std::function<void()>& each = {}) {
        while (time < end * (1 - 1e-12)) {
            const double step = std::min(courant * grid.spacing / flow.survey(state).fastest, end - time);
            flow.advance(state, step);
            time += step;
            ++steps;
            if (each) each();
        }
    }

    double depth(std::size_t cell) const { return state.depth[cell + boussinesq::ghost_cells]; }
    double discharge(std::size_t cell) const { return state.discharge[cell + boussinesq::ghost_cells]; }
    double elevation(std::size_t cell) const {
        return depth(cell) + flow.bed().level(cell + boussinesq::ghost_cells);
    }
    double largest_speed() const {
        double largest = 0;
        for (std::size_t i = 0; i < grid.cells; ++i)
            if (depth(i) > flow.parameters().dry_depth)
                largest = std::max(largest, std::abs(discharge(i) / depth(i)));
        return largest;
    }
    double water() const {
        double sum = 0;
        for (std::size_t i = 0; i < grid.cells; ++i) sum += depth(i);
        return sum * grid.spacing;
    }
};

/// Parameters scaled to a depth, as scene.cpp scales them.
inline boussinesq::FlowParameters scaled(double depth, double alpha = 1.153) {
    return {.spacing = 1.0,
            .alpha = alpha,
            .dry_depth = 1e-4 * depth,
            .discharge_scale = 1e-2 * depth * std::sqrt(boussinesq::gravity * depth),
            .elevation_scale = 1e-2 * depth};
}

}  // namespace boussinesq_test
