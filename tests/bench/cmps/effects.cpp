/// What each effect adds to a step, per particle; `none` is the step without any. The boundaries' effects
/// (relaxation_zone, absorption, wall_overflow) and overtopping_basin need waves and structures: run.json
/// gives their share of a run's time.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>

#include "cmps/crest_speed.hpp"
#include "cmps/effects/overtopping_basin.hpp"
#include "cmps/effects/turbulence.hpp"
#include "cmps/effects/viscosity.hpp"
#include "tests/support/cmps_tank.hpp"

namespace {

/// Steps of a tank of `count` particles whose surface swings, with the effect that `make` gives.
template <class Make>
void step_with(benchmark::State& state, const Make& make) {
    constexpr double depth = 0.3, length = 2 * depth;
    const double spacing = std::sqrt(depth * length / static_cast<double>(state.range(0)));
    cmps::NearField field(
        cmps_tank::settings(spacing, depth),
        cmps_tank::particles(
            length, spacing, [](double x) { return depth + 0.03 * std::cos(M_PI * x / length); }, 0.5));
    field.settle(20, depth);
    if (std::unique_ptr<cmps::Effect> effect = make()) field.effects.push_back(std::move(effect));
    double time = 0;
    for (auto _ : state) {
        const double step = field.largest_step();
        field.advance(time, step);
        time += step;
    }
    const auto work = static_cast<double>(state.iterations()) * static_cast<double>(field.particles.size());
    state.counters["per_particle"] =
        benchmark::Counter(work, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

using Made = std::unique_ptr<cmps::Effect>;
const auto none = [] { return Made(); };
const auto viscosity = [] { return Made(std::make_unique<cmps::Viscosity>(1e-6)); };
const auto turbulence = [] { return Made(std::make_unique<cmps::Turbulence>(0.15)); };
const auto basin = [] { return Made(std::make_unique<cmps::OvertoppingBasin>(10.0)); };

BENCHMARK_CAPTURE(step_with, none, none)->Arg(5000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(step_with, viscosity, viscosity)->Arg(5000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(step_with, turbulence, turbulence)->Arg(5000)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(step_with, overtopping_basin, basin)->Arg(5000)->Unit(benchmark::kMillisecond);

/// A look at the crests, which EffectWatch takes every 20 steps, per particle.
void look_at_crests(benchmark::State& state) {
    constexpr double depth = 0.3, length = 2 * depth;
    const double spacing = std::sqrt(depth * length / static_cast<double>(state.range(0)));
    const cmps::Particles particles = cmps_tank::particles(
        length, spacing, [](double x) { return depth + 0.03 * std::cos(M_PI * x / length); }, 0.5);
    cmps::CrestSpeed crests(spacing, depth, 1.0);
    for (auto _ : state) benchmark::DoNotOptimize(crests.fastest(particles, 0.0, length));
    const auto work = static_cast<double>(state.iterations()) * static_cast<double>(particles.size());
    state.counters["per_particle"] =
        benchmark::Counter(work, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}
BENCHMARK(look_at_crests)->Arg(5000)->Unit(benchmark::kMicrosecond);

}  // namespace
