/// The case all benchmarks of cmps measure: a tank whose surface swings, the same at every number of
/// particles.
#pragma once

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <memory>

#include "tests/support/cmps_tank.hpp"

namespace cmps_bench {

/// Water 0.3 m deep in a tank of 0.6 m, its surface tilted by 0.03 m at the start.
class SwingingTank {
 public:
    explicit SwingingTank(std::int64_t fluid_particles) {
        constexpr double depth = 0.3, length = 2 * depth;
        const double spacing = std::sqrt(depth * length / static_cast<double>(fluid_particles));
        const auto surface = [](double x) { return depth + 0.03 * std::cos(M_PI * x / length); };
        field = std::make_unique<cmps::NearField>(cmps_tank::settings(spacing, depth),
                                                  cmps_tank::particles(length, spacing, surface, 0.5));
        field->settle(20, depth);
    }
    void step() {
        const double step = field->largest_step();
        field->advance(time, step);
        time += step;
    }
    void run_to(double end) {
        while (time < end) step();
    }
    double particles() const { return static_cast<double>(field->particles.size()); }

    std::unique_ptr<cmps::NearField> field;
    double time = 0;  ///< s
};

/// A tank of `fluid_particles` after some steps, for what is measured at one instant.
inline std::unique_ptr<cmps::NearField> swinging_tank(std::int64_t fluid_particles) {
    SwingingTank tank(fluid_particles);
    for (int k = 0; k < (fluid_particles > 200000 ? 5 : 20); ++k) tank.step();
    return std::move(tank.field);
}

/// Time per particle, walls counted.
inline void report_particles(benchmark::State& state, const cmps::NearField& field, double steps = 1) {
    const auto work =
        static_cast<double>(state.iterations()) * steps * static_cast<double>(field.particles.size());
    state.counters["per_particle"] =
        benchmark::Counter(work, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["particles"] = static_cast<double>(field.particles.size());
}

}  // namespace cmps_bench
