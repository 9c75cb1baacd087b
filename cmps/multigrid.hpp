/// Aggregation multigrid as a preconditioner: one symmetric V-cycle, Gauss-Seidel forwards down and backwards
/// up.
///
/// Unknowns are gathered by place: boxes of about the kernel's radius, then boxes of boxes.
/// Prolongation is constant over a box, coarse matrices are Galerkin products, the coarse correction is
/// enlarged by 1.6 (constant prolongation underestimates it), the coarsest level is solved directly. All of
/// it is done in float: a preconditioner decides how fast a solve converges, not what it converges to.
#pragma once

#include <cstdint>
#include <vector>

#include "cmps/sparse_matrix.hpp"

namespace cmps {

class Multigrid {
 public:
    /// Builds all levels for the matrix, which must outlive the preconditioner's use. x, z: place of every
    /// unknown; `box`: edge of the first boxes, m, at least half the length of the longest link.
    void build(const SparseMatrix& matrix, const std::vector<double>& x, const std::vector<double>& z,
               double box);
    /// result = M^-1 right
    void apply(const std::vector<double>& right, std::vector<double>& result);
    /// What one cycle moves through memory when no array stays in cache, bytes.
    double bytes_per_cycle() const;

 private:
    struct Level {
        SparseMatrix matrix;               ///< of this level; empty on the finest, which is the caller's
        std::vector<std::int32_t> parent;  ///< coarse unknown of every unknown of this level
        std::vector<std::int32_t> box_x, box_z;  ///< box of every unknown of this level
        std::vector<std::int32_t> place;         ///< window * box_x + box_z
        std::vector<std::uint32_t> child_start, order;
        std::vector<std::int32_t> number;  ///< coarse unknown of every box of the grid, -1: none
        std::int32_t lines = 0;            ///< boxes of the grid in z
        std::vector<float> inverse_diagonal, right, result;
        std::vector<std::int32_t> children;  ///< unknowns of this level by parent
    };
    const SparseMatrix& matrix_of(std::size_t level) const {
        return level == 0 ? *finest_ : levels_[level].matrix;
    }
    void gather(std::size_t level);
    void coarsen(std::size_t level);
    void factorise_coarsest();
    void solve_coarsest();
    void cycle(std::size_t level);

    const SparseMatrix* finest_ = nullptr;
    std::vector<Level> levels_;
    std::size_t depth_ = 0;
    std::vector<double> dense_, dense_result_;  ///< Cholesky factor of the coarsest matrix, by rows
    std::vector<std::size_t> first_;            ///< column of the first entry of each of its rows
};

}  // namespace cmps
