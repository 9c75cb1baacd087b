#include "cmps/multigrid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cmps {
namespace {

constexpr std::size_t direct_below = 200;  // unknowns
constexpr float enlargement = 1.6F;
constexpr std::size_t most_levels = 16;
// Links of a level reach over two boxes at most, those of coarser levels over one or two: all boxes that a
// box is linked to lie in a window of 5 x 5.
constexpr std::int32_t reach = 2, window = 2 * reach + 1, middle = reach * window + reach;

}  // namespace

void Multigrid::build(const SparseMatrix& matrix, const std::vector<double>& x, const std::vector<double>& z,
                      double box) {
    finest_ = &matrix;
    if (levels_.size() < most_levels) levels_.resize(most_levels);
    const std::size_t rows = matrix.rows();
    Level& finest = levels_[0];
    finest.box_x.resize(rows), finest.box_z.resize(rows);
    double x0 = std::numeric_limits<double>::infinity(), z0 = x0;
    for (std::size_t i = 0; i < rows; ++i) x0 = std::min(x0, x[i]), z0 = std::min(z0, z[i]);
    for (std::size_t i = 0; i < rows; ++i) {
        finest.box_x[i] = static_cast<std::int32_t>((x[i] - x0) / box);
        finest.box_z[i] = static_cast<std::int32_t>((z[i] - z0) / box);
    }
    depth_ = 0;
    for (;; ++depth_) {
        const SparseMatrix& here = matrix_of(depth_);
        Level& level = levels_[depth_];
        level.inverse_diagonal.resize(here.rows());
        for (std::size_t i = 0; i < here.rows(); ++i)
            level.inverse_diagonal[i] = static_cast<float>(1.0 / here.diagonal[i]);
        level.right.resize(here.rows()), level.result.resize(here.rows());
        if (here.rows() <= direct_below || depth_ + 1 == most_levels) break;
        gather(depth_);
        coarsen(depth_);
    }
    factorise_coarsest();
}

/// Numbers the boxes that hold unknowns of `level`, and sorts the unknowns by box.
void Multigrid::gather(std::size_t level) {
    Level& fine = levels_[level];
    Level& coarse = levels_[level + 1];
    const std::size_t rows = fine.box_x.size();
    std::int32_t columns = 0, lines = 0;
    for (std::size_t i = 0; i < rows; ++i)
        columns = std::max(columns, fine.box_x[i] + 1), lines = std::max(lines, fine.box_z[i] + 1);
    // a margin of empty boxes, so that the window around a box never leaves the grid
    columns += 2 * reach, lines += 2 * reach;
    fine.lines = lines;
    std::vector<std::int32_t>& number = fine.number;
    number.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(lines), -1);
    fine.parent.resize(rows), fine.place.resize(rows);
    coarse.box_x.clear(), coarse.box_z.clear();
    for (std::size_t i = 0; i < rows; ++i) {
        fine.parent[i] = (fine.box_x[i] + reach) * lines + fine.box_z[i] + reach;
        fine.place[i] = window * fine.box_x[i] + fine.box_z[i];
        number[static_cast<std::size_t>(fine.parent[i])] = 0;
    }
    std::int32_t next = 0;
    for (std::int32_t b = 0; b < columns * lines; ++b) {  // coarse rows stay near their neighbours
        if (number[static_cast<std::size_t>(b)] < 0) continue;
        number[static_cast<std::size_t>(b)] = next++;
        coarse.box_x.push_back((b / lines - reach) / 2);
        coarse.box_z.push_back((b % lines - reach) / 2);
    }
    fine.child_start.assign(static_cast<std::size_t>(next) + 1, 0);
    for (std::size_t i = 0; i < rows; ++i) {
        fine.parent[i] = number[static_cast<std::size_t>(fine.parent[i])];
        ++fine.child_start[static_cast<std::size_t>(fine.parent[i]) + 1];
    }
    for (std::size_t c = 0; c < static_cast<std::size_t>(next); ++c)
        fine.child_start[c + 1] += fine.child_start[c];
    fine.order.assign(fine.child_start.begin(), fine.child_start.end() - 1);
    fine.children.resize(rows);
    for (std::size_t i = 0; i < rows; ++i)
        fine.children[fine.order[static_cast<std::size_t>(fine.parent[i])]++] = static_cast<std::int32_t>(i);
}

/// Galerkin product with constant prolongation: entries of a box's unknowns are summed by the boxes they lead
/// to.
void Multigrid::coarsen(std::size_t level) {
    const SparseMatrix& fine = matrix_of(level);
    const Level& here = levels_[level];
    SparseMatrix& coarse = levels_[level + 1].matrix;
    const std::size_t rows = here.child_start.size() - 1;
    coarse.start.resize(rows + 1), coarse.upper.resize(rows), coarse.diagonal.resize(rows);
    coarse.column.resize(rows * (window * window - 1)), coarse.value.resize(coarse.column.size());
    const std::int32_t* const place = here.place.data();
    std::uint32_t next = 0;
    coarse.start[0] = 0;
    for (std::size_t c = 0; c < rows; ++c) {
        const auto first = static_cast<std::size_t>(here.children[here.child_start[c]]);
        const std::int32_t corner = place[first] - middle;
        float sums[window * window] = {};
        double diagonal = 0;
        for (std::size_t m = here.child_start[c]; m < here.child_start[c + 1]; ++m) {
            const auto i = static_cast<std::size_t>(here.children[m]);
            diagonal += fine.diagonal[i];
            for (std::size_t k = fine.start[i]; k < fine.start[i + 1]; ++k)
                sums[place[fine.column[k]] - corner] += fine.value[k];
        }
        coarse.diagonal[c] = diagonal + static_cast<double>(sums[middle]);
        const std::int32_t* const around =
            &here.number[static_cast<std::size_t>(here.box_x[first] * here.lines + here.box_z[first])];
        for (std::int32_t b = 0; b < window * window; ++b) {
            if (b == middle) coarse.upper[c] = next;
            if (b == middle || sums[b] == 0) continue;
            coarse.column[next] = around[b / window * here.lines + b % window];
            coarse.value[next++] = sums[b];
        }
        coarse.start[c + 1] = next;
    }
}

/// Cholesky factors by rows. Left of the first entry of a row there is nothing, before and after: boxes are
/// numbered across the shorter side of a flume, so that only a narrow band has to be worked through.
void Multigrid::factorise_coarsest() {
    const SparseMatrix& matrix = matrix_of(depth_);
    const std::size_t n = matrix.rows();
    dense_.assign(n * n, 0.0);
    first_.resize(n);
    for (std::size_t i = 0; i < n; ++i) {
        dense_[i * n + i] = matrix.diagonal[i];
        first_[i] = i;
        for (std::size_t k = matrix.start[i]; k < matrix.upper[i]; ++k) {
            const auto j = static_cast<std::size_t>(matrix.column[k]);
            dense_[i * n + j] = static_cast<double>(matrix.value[k]);
            first_[i] = std::min(first_[i], j);
        }
    }
    for (std::size_t i = 0; i < n; ++i) {
        double* const row = &dense_[i * n];
        for (std::size_t j = first_[i]; j <= i; ++j) {
            const double* const other = &dense_[j * n];
            double sum = row[j];
#pragma omp simd reduction(- : sum)
            for (std::size_t k = std::max(first_[i], first_[j]); k < j; ++k) sum -= row[k] * other[k];
            row[j] = i == j ? std::sqrt(sum) : sum / other[j];
        }
    }
    dense_result_.resize(n);
}

void Multigrid::solve_coarsest() {
    const std::size_t n = matrix_of(depth_).rows();
    Level& level = levels_[depth_];
    double* const x = dense_result_.data();
    for (std::size_t i = 0; i < n; ++i) {
        const double* const row = &dense_[i * n];
        double sum = static_cast<double>(level.right[i]);
#pragma omp simd reduction(- : sum)
        for (std::size_t k = first_[i]; k < i; ++k) sum -= row[k] * x[k];
        x[i] = sum / row[i];
    }
    for (std::size_t i = n; i-- > 0;) {
        const double* const row = &dense_[i * n];
        const double value = x[i] /= row[i];
#pragma omp simd
        for (std::size_t k = first_[i]; k < i; ++k) x[k] -= row[k] * value;
    }
    for (std::size_t i = 0; i < n; ++i) level.result[i] = static_cast<float>(x[i]);
}

void Multigrid::apply(const std::vector<double>& right, std::vector<double>& result) {
    Level& finest = levels_[0];
#pragma omp simd
    for (std::size_t i = 0; i < right.size(); ++i) finest.right[i] = static_cast<float>(right[i]);
    cycle(0);
#pragma omp simd
    for (std::size_t i = 0; i < right.size(); ++i) result[i] = static_cast<double>(finest.result[i]);
}

double Multigrid::bytes_per_cycle() const {
    double bytes = 24.0 * static_cast<double>(finest_->rows());  // right and result between double and float
    for (std::size_t level = 0; level < depth_; ++level) {
        const SparseMatrix& matrix = matrix_of(level);
        // Every entry is read twice: half of them forwards, half for what is left, all backwards. Per row:
        // forwards 20 (start, upper, right, inverse, x), what is left 16, the coarse correction 12,
        // backwards 24.
        bytes += 16.0 * matrix.start[matrix.rows()] + 72.0 * static_cast<double>(matrix.rows());
    }
    return bytes;
}

/// Sweeps add a row's entries so that the unknown found last comes last: the next row's sum is under way
/// before.
void Multigrid::cycle(std::size_t level) {
    if (level == depth_) return solve_coarsest();
    const SparseMatrix& matrix = matrix_of(level);
    const std::size_t rows = matrix.rows();
    const float* const value = matrix.value.data();
    const std::int32_t* const column = matrix.column.data();
    const std::uint32_t* const start = matrix.start.data();
    const std::uint32_t* const upper = matrix.upper.data();
    Level& here = levels_[level];
    Level& coarse = levels_[level + 1];
    float* const x = here.result.data();
    const float* const right = here.right.data();
    const float* const inverse = here.inverse_diagonal.data();
    // forwards from zero: x = (D + L)^-1 r; what is left of r is -L^T x
    for (std::size_t i = 0; i < rows; ++i) {
        float sum = right[i];
        for (std::size_t k = start[i]; k < upper[i]; ++k) sum -= value[k] * x[column[k]];
        x[i] = sum * inverse[i];
    }
    std::fill(coarse.right.begin(), coarse.right.end(), 0.0F);
    for (std::size_t i = 0; i < rows; ++i) {
        float sum = 0;
        for (std::size_t k = upper[i]; k < start[i + 1]; ++k) sum -= value[k] * x[column[k]];
        coarse.right[static_cast<std::size_t>(here.parent[i])] += sum;
    }
    cycle(level + 1);
    for (std::size_t i = 0; i < rows; ++i)
        x[i] += enlargement * coarse.result[static_cast<std::size_t>(here.parent[i])];
    // backwards
    for (std::size_t i = rows; i-- > 0;) {
        float sum = right[i];
        for (std::size_t k = start[i]; k < upper[i]; ++k) sum -= value[k] * x[column[k]];
        for (std::size_t k = start[i + 1]; k-- > upper[i];) sum -= value[k] * x[column[k]];
        x[i] = sum * inverse[i];
    }
}

}  // namespace cmps
