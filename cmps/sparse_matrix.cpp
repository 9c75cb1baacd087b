#include "cmps/sparse_matrix.hpp"

#include "common/parallel.hpp"

namespace cmps {

void multiply(const SparseMatrix& matrix, const std::vector<double>& x, std::vector<double>& y) {
    const double* const in = x.data();
    const float* const value = matrix.value.data();
    const std::int32_t* const column = matrix.column.data();
    common::parallel_for(matrix.rows(), 8000, [&](std::size_t i) {
        double sum = matrix.diagonal[i] * in[i];
        // plain: on rows this short gathers and a vector's reduction cost more than they save
        for (std::size_t k = matrix.start[i]; k < matrix.start[i + 1]; ++k) sum += value[k] * in[column[k]];
        y[i] = sum;
    });
}

}  // namespace cmps
