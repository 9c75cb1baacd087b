#include "cmps/pressure_solver.hpp"

#include <algorithm>
#include <cmath>

#include "common/parallel.hpp"

namespace cmps {

void IncompleteCholesky::factorise(const SparseMatrix& matrix) {
    const std::size_t rows = matrix.rows();
    start_.resize(rows + 1);
    column_.resize(matrix.column.size());
    factor_.resize(matrix.column.size());
    inverse_diagonal_.resize(rows);
    scaled_.assign(rows, 0.0);  // row i of L D, scattered
    std::uint32_t next = 0;
    start_[0] = 0;
    for (std::size_t i = 0; i < rows; ++i) {
        const std::uint32_t begin = next;
        double pivot = matrix.diagonal[i];
        for (std::size_t k = matrix.start[i]; k < matrix.upper[i]; ++k) {
            const std::int32_t j = matrix.column[k];
            double sum = static_cast<double>(matrix.value[k]);
            for (std::size_t m = start_[j]; m < start_[j + 1]; ++m)
                sum -= static_cast<double>(factor_[m]) * scaled_[column_[m]];
            scaled_[j] = sum;
            const double l = sum * inverse_diagonal_[j];
            pivot -= l * sum;
            column_[next] = j;
            factor_[next++] = static_cast<float>(l);
        }
        start_[i + 1] = next;
        inverse_diagonal_[i] = 1.0 / pivot;
        for (std::size_t m = begin; m < next; ++m) scaled_[column_[m]] = 0.0;
    }
}

void IncompleteCholesky::apply(const std::vector<double>& r, std::vector<double>& z) {
    const std::size_t rows = inverse_diagonal_.size();
    const float* const factor = factor_.data();
    const std::int32_t* const column = column_.data();
    double* const out = z.data();
    for (std::size_t i = 0; i < rows; ++i) {
        double sum = r[i];
        for (std::size_t k = start_[i]; k < start_[i + 1]; ++k) sum -= factor[k] * out[column[k]];
        out[i] = sum;
    }
#pragma omp simd
    for (std::size_t i = 0; i < rows; ++i) out[i] *= inverse_diagonal_[i];
    for (std::size_t i = rows; i-- > 0;) {
        const double value = out[i];
        for (std::size_t k = start_[i]; k < start_[i + 1]; ++k) out[column[k]] -= factor[k] * value;
    }
}

SolveReport PressureSolver::solve(const SparseMatrix& matrix, const std::vector<double>& b,
                                  std::vector<double>& x) {
    return iterate(
        matrix, b, x, [&] { cholesky_.factorise(matrix); },
        [&](const auto& r, auto& z) { cholesky_.apply(r, z); });
}

SolveReport PressureSolver::solve(const SparseMatrix& matrix, const std::vector<double>& b,
                                  std::vector<double>& x, const std::vector<double>& at_x,
                                  const std::vector<double>& at_z, double box) {
    return iterate(
        matrix, b, x, [&] { multigrid_.build(matrix, at_x, at_z, box); },
        [&](const auto& r, auto& z) { multigrid_.apply(r, z); });
}

template <class Term>
double PressureSolver::sum_over_rows(std::size_t rows, const Term& term) {
    constexpr std::size_t block = 2048;
    const std::size_t blocks = (rows + block - 1) / block;
    partial_.resize(blocks);
    common::parallel_for(blocks, 8, [&](std::size_t b) {
        const std::size_t to = std::min(rows, (b + 1) * block);
        double sum = 0;
#pragma omp simd reduction(+ : sum)
        for (std::size_t i = b * block; i < to; ++i) sum += term(i);
        partial_[b] = sum;
    });
    double sum = 0;
    for (std::size_t b = 0; b < blocks; ++b) sum += partial_[b];
    return sum;
}

template <class Build, class Apply>
SolveReport PressureSolver::iterate(const SparseMatrix& matrix, const std::vector<double>& b,
                                    std::vector<double>& x, const Build& build, const Apply& apply) {
    const std::size_t rows = matrix.rows();
    SolveReport report;
    if (rows == 0) return {.iterations = 0, .residual = 0, .is_converged = true};
    for (auto* array : {&residual_, &direction_, &product_, &preconditioned_}) array->resize(rows);
    std::fill(direction_.begin(), direction_.end(), 0.0);
    double* const r = residual_.data();
    double* const p = direction_.data();
    double* const q = product_.data();
    double* const z = preconditioned_.data();
    double target = tolerance_ * std::sqrt(sum_over_rows(rows, [&](std::size_t i) { return b[i] * b[i]; }));
    multiply(matrix, x, product_);
    double norm = std::sqrt(sum_over_rows(rows, [&](std::size_t i) {
        r[i] = b[i] - q[i];
        return r[i] * r[i];
    }));
    // where next to nothing is left to solve for, the rounding of the guess is as near as one comes
    target = std::max(target, 1e-12 * norm);
    if (norm > target) {
        build();
        double previous = 0;
        while (norm > target && report.iterations < most_iterations_) {
            apply(residual_, preconditioned_);
            const double rz = sum_over_rows(rows, [&](std::size_t i) { return r[i] * z[i]; });
            const double beta = report.iterations ? rz / previous : 0.0;
            previous = rz;
#pragma omp simd
            for (std::size_t i = 0; i < rows; ++i) p[i] = z[i] + beta * p[i];
            multiply(matrix, direction_, product_);
            const double alpha = rz / sum_over_rows(rows, [&](std::size_t i) { return p[i] * q[i]; });
            norm = std::sqrt(sum_over_rows(rows, [&](std::size_t i) {
                x[i] += alpha * p[i];
                r[i] -= alpha * q[i];
                return r[i] * r[i];
            }));
            ++report.iterations;
        }
    }
    report.is_converged = norm <= target;
    report.residual = target > 0 ? norm / target * tolerance_ : 0.0;
    return report;
}

}  // namespace cmps
