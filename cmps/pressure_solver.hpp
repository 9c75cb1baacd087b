/// Conjugate gradients for the pressure equation, warm-started, with incomplete Cholesky or aggregation
/// multigrid.
#pragma once

#include <cstddef>
#include <vector>

#include "cmps/multigrid.hpp"
#include "cmps/sparse_matrix.hpp"

namespace cmps {

/// Incomplete Cholesky without fill, A ~ (L + D) D^-1 (L + D)^T, for M-matrices (it exists for them).
class IncompleteCholesky {
 public:
    void factorise(const SparseMatrix& matrix);
    /// z = M^-1 r
    void apply(const std::vector<double>& r, std::vector<double>& z);

 private:
    std::vector<std::uint32_t> start_;
    std::vector<std::int32_t> column_;
    std::vector<float> factor_;  ///< unit lower triangle, strict part, by rows
    std::vector<double> inverse_diagonal_, scaled_;
};

struct SolveReport {
    std::size_t iterations = 0;
    double residual = 0;  ///< |b - A x| / |b|
    bool is_converged = false;
};

/// Solves A x = b to |r| <= tolerance |b| from the given x.
class PressureSolver {
 public:
    PressureSolver(double tolerance, std::size_t most_iterations)
        : tolerance_(tolerance), most_iterations_(most_iterations) {}
    /// With incomplete Cholesky.
    SolveReport solve(const SparseMatrix& matrix, const std::vector<double>& b, std::vector<double>& x);
    /// With multigrid; at_x, at_z: place of every unknown, `box`: edge of the finest boxes, m.
    SolveReport solve(const SparseMatrix& matrix, const std::vector<double>& b, std::vector<double>& x,
                      const std::vector<double>& at_x, const std::vector<double>& at_z, double box);

 private:
    template <class Build, class Apply>
    SolveReport iterate(const SparseMatrix& matrix, const std::vector<double>& b, std::vector<double>& x,
                        const Build& build, const Apply& apply);
    /// Sum of term(i) over the rows, the same for any number of threads.
    template <class Term>
    double sum_over_rows(std::size_t rows, const Term& term);
    double tolerance_;
    std::size_t most_iterations_;
    IncompleteCholesky cholesky_;
    Multigrid multigrid_;
    std::vector<double> residual_, direction_, product_, preconditioned_, partial_;
};

}  // namespace cmps
