/// A time step of sloshing water and its parts: processor time per particle-step, walls counted.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <vector>

#include "tests/bench/cmps/swinging_tank.hpp"

namespace {

using cmps_bench::report_particles;
using cmps_bench::swinging_tank;

/// Memory this process holds now, bytes.
double resident_memory() {
    std::ifstream file("/proc/self/statm");
    double all = 0, resident = 0;
    file >> all >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}
const double memory_at_start = resident_memory();

/// The same stretch of the same motion at every size. The first steps are left out: the pressure is not yet
/// that of the motion, and the finer the particles, the more iterations it takes to get there.
constexpr double settled = 0.02, end = 0.04;  // s
constexpr int fewest_steps = 100;

void whole_step(benchmark::State& state) {
    cmps_bench::SwingingTank tank(state.range(0));
    const cmps::StepCounts& counts = tank.field->counts;
    while (tank.time < settled || counts.steps < fewest_steps) tank.step();
    state.counters["bytes_per_particle"] = (resident_memory() - memory_at_start) / tank.particles();
    const cmps::StepCounts start = counts;
    const double until = std::max(end, tank.time + end - settled);
    for (auto _ : state)
        while (tank.time < until || counts.steps < start.steps + fewest_steps) tank.step();
    const auto steps = static_cast<double>(counts.steps - start.steps);
    report_particles(state, *tank.field, steps);
    state.counters["steps"] = steps;
    state.counters["iterations"] = static_cast<double>(counts.iterations - start.iterations) / steps;
    state.counters["list_builds"] = static_cast<double>(counts.list_builds - start.list_builds) / steps;
}

void neighbour_lists(benchmark::State& state) {
    const auto field = swinging_tank(state.range(0));
    for (auto _ : state) {
        field->search.invalidate();
        field->search.update(field->particles, {});
    }
    report_particles(state, *field);
}

void pair_geometry(benchmark::State& state) {
    const auto field = swinging_tank(state.range(0));
    const cmps::WendlandKernel kernel{field->settings.kernel_radius_ratio * field->settings.spacing};
    for (auto _ : state)
        cmps::compute_interactions(kernel, field->particles, field->search.lists(), field->equation.extras(),
                                   field->interactions);
    report_particles(state, *field);
}

void free_surface(benchmark::State& state) {
    const auto field = swinging_tank(state.range(0));
    for (auto _ : state)
        cmps::find_free_surface(field->particles, field->search.lists(), field->interactions,
                                field->lattice.number_density, field->place);
    report_particles(state, *field);
}

void assembly(benchmark::State& state) {
    const auto field = swinging_tank(state.range(0));
    for (auto _ : state)
        field->equation.assemble(field->particles, field->search.lists(), field->interactions, field->place,
                                 1e-3, 1e-3);
    report_particles(state, *field);
}

void gradient(benchmark::State& state) {
    const auto field = swinging_tank(state.range(0));
    cmps::GradientTerm term(cmps::Gradient::corrected, field->lattice.number_density);
    std::vector<double> x, z;
    for (auto _ : state) term.evaluate(field->particles, field->search.lists(), field->interactions, x, z);
    report_particles(state, *field);
}

BENCHMARK(whole_step)
    ->Arg(1000)
    ->Arg(10000)
    ->Arg(20000)
    ->Arg(100000)
    ->Arg(1000000)
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(neighbour_lists)->Arg(5000)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK(pair_geometry)->Arg(5000)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK(free_surface)->Arg(5000)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK(assembly)->Arg(5000)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK(gradient)->Arg(5000)->Arg(100000)->Unit(benchmark::kMicrosecond);

}  // namespace
