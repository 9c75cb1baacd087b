/// Hot paths of a time step: ns per particle-step on still and sloshing water.
#include <benchmark/benchmark.h>

#include <cmath>
#include <memory>

#include "tests/support/cmps_tank.hpp"

namespace {

/// A tank 2 h long whose surface swings; `count` fluid particles.
std::unique_ptr<cmps::NearField> swinging_tank(std::int64_t count) {
    constexpr double depth = 0.3, length = 2 * depth;
    const double spacing = std::sqrt(depth * length / static_cast<double>(count));
    auto field = std::make_unique<cmps::NearField>(
        cmps_tank::settings(spacing, depth),
        cmps_tank::particles(
            length, spacing, [](double x) { return depth + 0.03 * std::cos(M_PI * x / length); }, 0.5));
    field->settle(20, depth);
    double time = 0;
    for (int k = 0; k < 20; ++k) {
        const double step = field->largest_step();
        field->advance(time, step);
        time += step;
    }
    return field;
}

void report(benchmark::State& state, const cmps::NearField& field) {
    const auto work = static_cast<double>(state.iterations()) * static_cast<double>(field.particles.size());
    state.counters["ns_per_particle"] =
        benchmark::Counter(work * 1e-9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["particles"] = static_cast<double>(field.particles.size());
}

void whole_step(benchmark::State& state) {
    const auto field = swinging_tank(state.range(0));
    double time = 1;
    for (auto _ : state) {
        const double step = field->largest_step();
        field->advance(time, step);
        time += step;
    }
    report(state, *field);
    state.counters["iterations"] =
        static_cast<double>(field->counts.iterations) / static_cast<double>(field->counts.steps);
}

void neighbour_lists(benchmark::State& state) {
    const auto field = swinging_tank(state.range(0));
    for (auto _ : state) {
        field->search.invalidate();
        field->search.update(field->particles, {});
    }
    report(state, *field);
}

void pair_geometry(benchmark::State& state) {
    const auto field = swinging_tank(state.range(0));
    const cmps::WendlandKernel kernel{field->settings.kernel_radius_ratio * field->settings.spacing};
    for (auto _ : state)
        cmps::compute_interactions(kernel, field->particles, field->search.lists(), field->equation.extras(),
                                   field->interactions);
    report(state, *field);
}

void assembly(benchmark::State& state) {
    const auto field = swinging_tank(state.range(0));
    for (auto _ : state)
        field->equation.assemble(field->particles, field->search.lists(), field->interactions, field->place,
                                 1e-3);
    report(state, *field);
}

void gradient(benchmark::State& state) {
    const auto field = swinging_tank(state.range(0));
    cmps::GradientTerm term(cmps::Gradient::corrected, field->lattice.number_density);
    std::vector<double> x, z;
    for (auto _ : state) term.evaluate(field->particles, field->search.lists(), field->interactions, x, z);
    report(state, *field);
}

/// Product with the matrix: bytes moved per second, for a roofline against the machine's triad bandwidth.
void matrix_product(benchmark::State& state) {
    const auto field = swinging_tank(state.range(0));
    const cmps::SparseMatrix& matrix = field->equation.matrix;
    std::vector<double> x(matrix.rows(), 1.0), y(matrix.rows());
    for (auto _ : state) {
        cmps::multiply(matrix, x, y);
        benchmark::DoNotOptimize(y.data());
    }
    const double entries = matrix.start.back(), rows = static_cast<double>(matrix.rows());
    state.SetBytesProcessed(
        static_cast<std::int64_t>(static_cast<double>(state.iterations()) * (12 * entries + 28 * rows)));
    report(state, *field);
}

void pressure_solve(benchmark::State& state, bool is_multigrid) {
    const auto field = swinging_tank(state.range(0));
    const cmps::PressureEquation& equation = field->equation;
    const cmps::Particles& particles = field->particles;
    std::vector<double> at_x, at_z, start;
    for (const std::int32_t row : equation.row_of) {
        const std::size_t i = particles.first_wall() + static_cast<std::size_t>(row);
        at_x.push_back(particles.x[i]), at_z.push_back(particles.z[i]),
            start.push_back(0.97 * particles.pressure[i]);
    }
    cmps::PressureSolver solver(1e-3, 2000);
    std::vector<double> x;
    std::size_t iterations = 0;
    for (auto _ : state) {
        x = start;
        iterations = (is_multigrid ? solver.solve(equation.matrix, equation.right_hand_side, x, at_x, at_z,
                                                  2 * field->settings.spacing)
                                   : solver.solve(equation.matrix, equation.right_hand_side, x))
                         .iterations;
    }
    report(state, *field);
    state.counters["iterations"] = static_cast<double>(iterations);
}

BENCHMARK(whole_step)->Arg(1000)->Arg(5000)->Arg(20000)->Arg(100000)->Unit(benchmark::kMillisecond);
BENCHMARK(neighbour_lists)->Arg(5000)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK(pair_geometry)->Arg(5000)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK(assembly)->Arg(5000)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK(gradient)->Arg(5000)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK(matrix_product)->Arg(5000)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(pressure_solve, cholesky, false)
    ->Arg(5000)
    ->Arg(20000)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pressure_solve, multigrid, true)
    ->Arg(5000)
    ->Arg(20000)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);

}  // namespace
