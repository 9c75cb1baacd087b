#include "cmps/sparse_matrix.hpp"

#include "common/parallel.hpp"

namespace cmps {

void multiply(const SparseMatrix& matrix, const std::vector<double>& x, std::vector<double>& y) {
    const double* const in = x.data();
    const float* const value = matrix.value.data();
    const std::int32_t* const column = matrix.column.data();
    common::parallel_for(matrix.rows(), 8000, [&](std::size_t i) {
        // plain: on rows this short gathers and a vector's reduction cost more than they save; two sums, so
        // that one addition need not wait for the one before
        double sum = matrix.diagonal[i] * in[i], other = 0;
        std::size_t k = matrix.start[i];
        const std::size_t end = matrix.start[i + 1];
        for (; k + 1 < end; k += 2) {
            sum += value[k] * in[column[k]];
            other += value[k + 1] * in[column[k + 1]];
        }
        if (k < end) sum += value[k] * in[column[k]];
        y[i] = sum + other;
    });
}

}  // namespace cmps
