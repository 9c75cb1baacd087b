#include "cmps/pressure_solver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/cmps_tank.hpp"

namespace {

/// The pressure equation of a small tank in which every particle moves at random.
struct System {
    cmps::NearField field;
    explicit System(double spacing)
        : field(cmps_tank::settings(spacing, 0.2), cmps_tank::particles(
                                                       0.3, spacing, [](double) { return 0.2; }, 0.3)) {
        std::mt19937 random(3);
        std::normal_distribution<double> speed(0, 0.1);
        for (std::size_t i = field.particles.first_fluid(); i < field.particles.size(); ++i)
            field.particles.u[i] = speed(random), field.particles.w[i] = speed(random);
        field.settle(5, 0.2);
        field.equation.assemble(field.particles, field.search.lists(), field.interactions, field.place, 1e-3,
                                1e-3);
    }
};

/// Dense Cholesky, as the judge.
std::vector<double> exact(const cmps::SparseMatrix& matrix, std::vector<double> b) {
    const std::size_t n = matrix.rows();
    std::vector<std::vector<double>> a(n, std::vector<double>(n, 0.0));
    for (std::size_t i = 0; i < n; ++i) {
        a[i][i] = matrix.diagonal[i];
        for (std::uint32_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k)
            a[i][matrix.column[k]] = matrix.value[k];
    }
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < i; ++j) EXPECT_NEAR(a[i][j], a[j][i], 1e-12);  // round-off
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < j; ++k) a[j][j] -= a[j][k] * a[j][k];
        a[j][j] = std::sqrt(a[j][j]);
        for (std::size_t i = j + 1; i < n; ++i) {
            for (std::size_t k = 0; k < j; ++k) a[i][j] -= a[i][k] * a[j][k];
            a[i][j] /= a[j][j];
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) b[i] -= a[i][k] * b[k];
        b[i] /= a[i][i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k][i] * b[k];
        b[i] /= a[i][i];
    }
    return b;
}

TEST(PressureSolver, AgreesWithADirectSolve) {
    System system(0.02);
    const auto& equation = system.field.equation;
    const std::vector<double> expected = exact(equation.matrix, equation.right_hand_side);
    std::vector<double> x(equation.matrix.rows(), 0.0);
    const auto report = cmps::PressureSolver(1e-12, 1000).solve(equation.matrix, equation.right_hand_side, x);
    EXPECT_TRUE(report.is_converged);
    double error = 0, size = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        error += std::pow(x[i] - expected[i], 2), size += expected[i] * expected[i];
    EXPECT_LT(std::sqrt(error / size), 1e-9);  // tolerance times the condition number
}

TEST(PressureSolver, MultigridFindsTheSameSolutionInFewIterations) {
    System system(0.005);  // 2400 unknowns: two levels above the direct solve
    const auto& equation = system.field.equation;
    const auto& particles = system.field.particles;
    std::vector<double> x(equation.matrix.rows(), 0.0), expected = x, at_x, at_z;
    for (const auto row : equation.row_of) {
        at_x.push_back(particles.x[particles.first_wall() + static_cast<std::size_t>(row)]);
        at_z.push_back(particles.z[particles.first_wall() + static_cast<std::size_t>(row)]);
    }
    cmps::PressureSolver solver(1e-10, 1000);
    const auto cholesky = solver.solve(equation.matrix, equation.right_hand_side, expected);
    const auto multigrid = solver.solve(equation.matrix, equation.right_hand_side, x, at_x, at_z, 0.01);
    EXPECT_TRUE(multigrid.is_converged);
    EXPECT_LT(multigrid.iterations, cholesky.iterations);
    double error = 0, size = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        error += std::pow(x[i] - expected[i], 2), size += expected[i] * expected[i];
    EXPECT_LT(std::sqrt(error / size), 1e-6);  // tolerance times the condition number of about 2000
}

TEST(PressureSolver, StopsAtOnceFromTheSolution) {
    System system(0.02);
    const auto& equation = system.field.equation;
    std::vector<double> x(equation.matrix.rows(), 0.0);
    cmps::PressureSolver solver(1e-8, 1000);
    solver.solve(equation.matrix, equation.right_hand_side, x);
    EXPECT_EQ(solver.solve(equation.matrix, equation.right_hand_side, x).iterations, 0u);
}

TEST(PressureSolver, LittleToSolveForFromAGuessFarOffIsFound) {
    System system(0.005);
    const auto& equation = system.field.equation;
    const auto& particles = system.field.particles;
    std::vector<double> at_x, at_z;
    for (const auto row : equation.row_of) {
        at_x.push_back(particles.x[particles.first_wall() + static_cast<std::size_t>(row)]);
        at_z.push_back(particles.z[particles.first_wall() + static_cast<std::size_t>(row)]);
    }
    std::vector<double> little(equation.matrix.rows());
    for (std::size_t i = 0; i < little.size(); ++i)  // weightless water that was still under its weight
        little[i] = 1e-60 * equation.right_hand_side[i];
    for (const bool by_multigrid : {false, true}) {
        std::vector<double> x(little.size(), 5000.0);
        cmps::PressureSolver solver(1e-3, 1000);
        const auto report = by_multigrid ? solver.solve(equation.matrix, little, x, at_x, at_z, 0.01)
                                         : solver.solve(equation.matrix, little, x);
        EXPECT_TRUE(report.is_converged);
        for (const double pressure : x)
            ASSERT_LT(std::abs(pressure), 5000.0 * 1e-6);  // 1e-12 times the condition
    }
}

TEST(PressureSolver, SaysSoWhenItDoesNotConverge) {
    System system(0.02);
    const auto& equation = system.field.equation;
    std::vector<double> x(equation.matrix.rows(), 0.0);
    EXPECT_FALSE(
        cmps::PressureSolver(1e-12, 2).solve(equation.matrix, equation.right_hand_side, x).is_converged);
}

}  // namespace
