/// Hot paths of a time step on sloshing water: time per particle-step (walls counted), bytes moved a second
/// by those that are bound by memory, against the machine's triad.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
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
    for (int k = 0; k < (count > 200000 ? 5 : 20); ++k) {
        const double step = field->largest_step();
        field->advance(time, step);
        time += step;
    }
    return field;
}

void report(benchmark::State& state, const cmps::NearField& field) {
    const auto work = static_cast<double>(state.iterations()) * static_cast<double>(field.particles.size());
    state.counters["per_particle"] =
        benchmark::Counter(work, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["particles"] = static_cast<double>(field.particles.size());
}

void report_bytes(benchmark::State& state, double bytes_each) {
    state.SetBytesProcessed(static_cast<std::int64_t>(static_cast<double>(state.iterations()) * bytes_each));
}

/// Memory this process holds now, bytes.
double resident_memory() {
    std::ifstream file("/proc/self/statm");
    double all = 0, resident = 0;
    file >> all >> resident;
    return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// Product with the matrix: entries 8 bytes, a row's start, diagonal, x and y.
double product_bytes(const cmps::SparseMatrix& matrix) {
    return 8.0 * matrix.start.back() + 28.0 * static_cast<double>(matrix.rows());
}

/// a = b + s c on arrays far beyond the caches, counted as STREAM does: what memory can give.
void triad(benchmark::State& state) {
    const auto count = static_cast<std::size_t>(state.range(0));
    std::vector<double> a(count, 1.0), b(count, 2.0), c(count, 3.0);
    for (auto _ : state) {
        for (std::size_t i = 0; i < count; ++i) a[i] = b[i] + 0.5 * c[i];
        benchmark::DoNotOptimize(a.data());
        benchmark::ClobberMemory();
    }
    report_bytes(state, 24.0 * static_cast<double>(count));
}

void whole_step(benchmark::State& state) {
    const double before = resident_memory();
    const auto field = swinging_tank(state.range(0));
    state.counters["bytes_per_particle"] =
        (resident_memory() - before) / static_cast<double>(field->particles.size());
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
                                 1e-3, 1e-3);
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
    report_bytes(state, product_bytes(matrix));
    report(state, *field);
}

void free_surface(benchmark::State& state) {
    const auto field = swinging_tank(state.range(0));
    for (auto _ : state)
        cmps::find_free_surface(field->particles, field->search.lists(), field->interactions,
                                field->lattice.number_density, field->place);
    report(state, *field);
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
    report(state, *field);
}

void multigrid_cycle(benchmark::State& state) {
    const auto field = swinging_tank(state.range(0));
    std::vector<double> at_x, at_z;
    places_of_unknowns(*field, at_x, at_z);
    cmps::Multigrid multigrid;
    multigrid.build(field->equation.matrix, at_x, at_z, 2.5 * field->settings.spacing);
    std::vector<double> result(at_x.size());
    for (auto _ : state) multigrid.apply(field->equation.right_hand_side, result);
    report_bytes(state, multigrid.bytes_per_cycle());
    report(state, *field);
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
    report(state, *field);
    state.counters["iterations"] = static_cast<double>(iterations);
}

BENCHMARK(triad)->Arg(20'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(whole_step)
    ->Arg(1000)
    ->Arg(5000)
    ->Arg(10000)
    ->Arg(20000)
    ->Arg(100000)
    ->Arg(1000000)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(neighbour_lists)->Arg(5000)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK(pair_geometry)->Arg(5000)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK(free_surface)->Arg(5000)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK(assembly)->Arg(5000)->Arg(100000)->Unit(benchmark::kMicrosecond);
BENCHMARK(gradient)->Arg(5000)->Arg(100000)->Unit(benchmark::kMicrosecond);
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
