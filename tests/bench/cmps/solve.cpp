/// The pressure solve on sloshing water: time per particle, and for what memory may bound its share of the
/// bandwidth that a triad gets in the same run.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <ctime>
#include <vector>

#include "tests/bench/cmps/swinging_tank.hpp"

namespace {

using cmps_bench::report_particles;
using cmps_bench::swinging_tank;

double processor_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// a = b + s c on arrays far beyond the caches, counted as STREAM does: what memory can give, bytes/s. Best
/// of ten.
double triad_bandwidth() {
    static const double bandwidth = [] {
        constexpr std::size_t count = 20'000'000;
        std::vector<double> a(count, 1.0), b(count, 2.0), c(count, 3.0);
        double best = 0;
        for (int k = 0; k < 10; ++k) {
            const double start = processor_seconds();
            for (std::size_t i = 0; i < count; ++i) a[i] = b[i] + 0.5 * c[i];
            benchmark::DoNotOptimize(a.data());
            benchmark::ClobberMemory();
            best = std::max(best, 24.0 * count / (processor_seconds() - start));
        }
        return best;
    }();
    return bandwidth;
}

/// Bytes a second of `bytes_each` an iteration, their share of the triad, and whether they fit the last
/// cache: then memory bounds nothing and the share may exceed 1.
void report_bandwidth(benchmark::State& state, double bytes_each, double seconds) {
    const double bandwidth = bytes_each * static_cast<double>(state.iterations()) / seconds;
    state.counters["GB/s"] = 1e-9 * bandwidth;
    state.counters["triad_GB/s"] = 1e-9 * triad_bandwidth();
    state.counters["share_of_triad"] = bandwidth / triad_bandwidth();
    state.counters["MB"] = 1e-6 * bytes_each;
    double cache = 0;
    for (const auto& level : benchmark::CPUInfo::Get().caches) cache = std::max(cache, 1.0 * level.size);
    state.counters["in_cache"] = bytes_each < cache ? 1 : 0;
}

/// Product with the matrix: entries 8 bytes, a row's start, diagonal, x and y.
double product_bytes(const cmps::SparseMatrix& matrix) {
    return 8.0 * matrix.start.back() + 28.0 * static_cast<double>(matrix.rows());
}

/// The product of a conjugate-gradient iteration.
void matrix_product(benchmark::State& state) {
    triad_bandwidth();
    const auto field = swinging_tank(state.range(0));
    const cmps::SparseMatrix& matrix = field->equation.matrix;
    std::vector<double> x(matrix.rows(), 1.0), y(matrix.rows());
    const double start = processor_seconds();
    for (auto _ : state) {
        cmps::multiply(matrix, x, y);
        benchmark::DoNotOptimize(y.data());
    }
    report_bandwidth(state, product_bytes(matrix), processor_seconds() - start);
    report_particles(state, *field);
}

/// Places of the unknowns, m.
void places_of_unknowns(const cmps::NearField& field, std::vector<double>& x, std::vector<double>& z) {
    for (const std::int32_t row : field.equation.row_of) {
        const std::size_t i = field.particles.first_wall() + static_cast<std::size_t>(row);
        x.push_back(field.particles.x[i]), z.push_back(field.particles.z[i]);
    }
}

void multigrid_setup(benchmark::State& state) {
    const auto field = swinging_tank(state.range(0));
    std::vector<double> at_x, at_z;
    places_of_unknowns(*field, at_x, at_z);
    cmps::Multigrid multigrid;
    for (auto _ : state) multigrid.build(field->equation.matrix, at_x, at_z, 2.5 * field->settings.spacing);
    report_particles(state, *field);
}

void multigrid_cycle(benchmark::State& state) {
    triad_bandwidth();
    const auto field = swinging_tank(state.range(0));
    std::vector<double> at_x, at_z;
    places_of_unknowns(*field, at_x, at_z);
    cmps::Multigrid multigrid;
    multigrid.build(field->equation.matrix, at_x, at_z, 2.5 * field->settings.spacing);
    std::vector<double> result(at_x.size());
    const double start = processor_seconds();
    for (auto _ : state) multigrid.apply(field->equation.right_hand_side, result);
    report_bandwidth(state, multigrid.bytes_per_cycle(), processor_seconds() - start);
    report_particles(state, *field);
}

void pressure_solve(benchmark::State& state, bool is_multigrid) {
    const auto field = swinging_tank(state.range(0));
    const cmps::PressureEquation& equation = field->equation;
    std::vector<double> at_x, at_z, start;
    places_of_unknowns(*field, at_x, at_z);
    for (const std::int32_t row : equation.row_of)
        start.push_back(
            0.97 * field->particles.pressure[field->particles.first_wall() + static_cast<std::size_t>(row)]);
    cmps::PressureSolver solver(1e-3, 2000);
    std::vector<double> x;
    std::size_t iterations = 0;
    for (auto _ : state) {
        x = start;
        iterations = (is_multigrid ? solver.solve(equation.matrix, equation.right_hand_side, x, at_x, at_z,
                                                  2.5 * field->settings.spacing)
                                   : solver.solve(equation.matrix, equation.right_hand_side, x))
                         .iterations;
    }
    report_particles(state, *field);
    state.counters["iterations"] = static_cast<double>(iterations);
}

BENCHMARK(matrix_product)->Arg(5000)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMicrosecond);
BENCHMARK(multigrid_setup)->Arg(5000)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK(multigrid_cycle)->Arg(5000)->Arg(100000)->Arg(1000000)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(pressure_solve, cholesky, false)
    ->Arg(1000)
    ->Arg(5000)
    ->Arg(20000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(pressure_solve, multigrid, true)
    ->Arg(1000)
    ->Arg(5000)
    ->Arg(20000)
    ->Arg(100000)
    ->Unit(benchmark::kMillisecond);

}  // namespace
