#include "cmps/multigrid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cmps {
namespace {

constexpr std::size_t direct_below = 200;  // unknowns
constexpr double enlargement = 1.6;
constexpr std::size_t most_levels = 16;

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
        for (std::size_t i = 0; i < here.rows(); ++i) level.inverse_diagonal[i] = 1.0 / here.diagonal[i];
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
    std::vector<std::int32_t>& number = fine.children;  // first used as the number of each box
    number.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(lines), -1);
    fine.parent.resize(rows);
    coarse.box_x.clear(), coarse.box_z.clear();
    const auto box_of = [&](std::size_t i) {
        return static_cast<std::size_t>(fine.box_x[i]) * static_cast<std::size_t>(lines) +
               static_cast<std::size_t>(fine.box_z[i]);
    };
    for (std::size_t i = 0; i < rows; ++i) number[box_of(i)] = 0;
    std::int32_t next = 0;
    for (std::size_t b = 0; b < number.size();
         ++b) {  // in the order of place: coarse rows stay near their neighbours
        if (number[b] < 0) continue;
        number[b] = next++;
        coarse.box_x.push_back(static_cast<std::int32_t>(b / static_cast<std::size_t>(lines)) / 2);
        coarse.box_z.push_back(static_cast<std::int32_t>(b % static_cast<std::size_t>(lines)) / 2);
    }
    fine.child_start.assign(static_cast<std::size_t>(next) + 1, 0);
    for (std::size_t i = 0; i < rows; ++i) {
        fine.parent[i] = number[box_of(i)];
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
    coarse.start.assign(rows + 1, 0), coarse.upper.resize(rows), coarse.diagonal.resize(rows);
    coarse.column.clear(), coarse.value.clear();
    constexpr std::uint32_t unseen = std::numeric_limits<std::uint32_t>::max();
    marker_.assign(rows, unseen);
    for (std::size_t c = 0; c < rows; ++c) {
        const auto begin = static_cast<std::uint32_t>(coarse.column.size());
        double diagonal = 0;
        for (std::size_t m = here.child_start[c]; m < here.child_start[c + 1]; ++m) {
            const std::size_t i = static_cast<std::size_t>(here.children[m]);
            diagonal += fine.diagonal[i];
            for (std::size_t k = fine.start[i]; k < fine.start[i + 1]; ++k) {
                const std::int32_t to = here.parent[static_cast<std::size_t>(fine.column[k])];
                if (to == static_cast<std::int32_t>(c)) {
                    diagonal += fine.value[k];
                    continue;
                }
                std::uint32_t& place = marker_[static_cast<std::size_t>(to)];
                if (place == unseen || place < begin) {
                    place = static_cast<std::uint32_t>(coarse.column.size());
                    coarse.column.push_back(to), coarse.value.push_back(0.0);
                }
                coarse.value[place] += fine.value[k];
            }
        }
        // sweeps need the entries left of the diagonal apart from those right of it; their order within does
        // not matter
        auto end = static_cast<std::uint32_t>(coarse.column.size());
        std::uint32_t left = begin;
        for (std::size_t k = begin; k < end; ++k)
            if (coarse.column[k] < static_cast<std::int32_t>(c)) {
                std::swap(coarse.column[k], coarse.column[left]);
                std::swap(coarse.value[k], coarse.value[left]);
                ++left;
            }
        coarse.upper[c] = left;
        coarse.diagonal[c] = diagonal;
        coarse.start[c + 1] = end;
    }
}

void Multigrid::factorise_coarsest() {
    const SparseMatrix& matrix = matrix_of(depth_);
    const std::size_t n = matrix.rows();
    dense_.assign(n * n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
        dense_[i * n + i] = matrix.diagonal[i];
        for (std::size_t k = matrix.start[i]; k < matrix.upper[i]; ++k)
            dense_[i * n + static_cast<std::size_t>(matrix.column[k])] = matrix.value[k];
    }
    for (std::size_t i = 0; i < n; ++i) {
        double* const row = &dense_[i * n];
        for (std::size_t j = 0; j <= i; ++j) {
            const double* const other = &dense_[j * n];
            double sum = row[j];
#pragma omp simd reduction(- : sum)
            for (std::size_t k = 0; k < j; ++k) sum -= row[k] * other[k];
            row[j] = i == j ? std::sqrt(sum) : sum / other[j];
        }
    }
}

void Multigrid::apply(const std::vector<double>& right, std::vector<double>& result) {
    cycle(0, right, result);
}

void Multigrid::cycle(std::size_t level, const std::vector<double>& right, std::vector<double>& result) {
    const SparseMatrix& matrix = matrix_of(level);
    const std::size_t rows = matrix.rows();
    double* const x = result.data();
    if (level == depth_) {
        for (std::size_t i = 0; i < rows; ++i) {
            double sum = right[i];
            for (std::size_t k = 0; k < i; ++k) sum -= dense_[i * rows + k] * x[k];
            x[i] = sum / dense_[i * rows + i];
        }
        for (std::size_t i = rows; i-- > 0;) {
            double sum = x[i];
            for (std::size_t k = i + 1; k < rows; ++k) sum -= dense_[k * rows + i] * x[k];
            x[i] = sum / dense_[i * rows + i];
        }
        return;
    }
    const double* const value = matrix.value.data();
    const std::int32_t* const column = matrix.column.data();
    Level& here = levels_[level];
    Level& coarse = levels_[level + 1];
    // forwards from zero: x = (D + L)^-1 r; what is left of r is -L^T x
    for (std::size_t i = 0; i < rows; ++i) {
        double sum = right[i];
#pragma omp simd reduction(- : sum)
        for (std::size_t k = matrix.start[i]; k < matrix.upper[i]; ++k) sum -= value[k] * x[column[k]];
        x[i] = sum * here.inverse_diagonal[i];
    }
    std::fill(coarse.right.begin(), coarse.right.end(), 0.0);
    for (std::size_t i = 0; i < rows; ++i) {
        double sum = 0;
#pragma omp simd reduction(- : sum)
        for (std::size_t k = matrix.upper[i]; k < matrix.start[i + 1]; ++k) sum -= value[k] * x[column[k]];
        coarse.right[static_cast<std::size_t>(here.parent[i])] += sum;
    }
    cycle(level + 1, coarse.right, coarse.result);
    for (std::size_t i = 0; i < rows; ++i)
        x[i] += enlargement * coarse.result[static_cast<std::size_t>(here.parent[i])];
    // backwards
    for (std::size_t i = rows; i-- > 0;) {
        double sum = right[i];
#pragma omp simd reduction(- : sum)
        for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k) sum -= value[k] * x[column[k]];
        x[i] = sum * here.inverse_diagonal[i];
    }
}

}  // namespace cmps
