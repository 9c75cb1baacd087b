/// Symmetric sparse matrix in compressed rows: diagonal apart, off-diagonal entries ascending in each row.
/// Entries are float: on the finest level they are kernel weights, which are kept as float anyway, and they
/// are most of what a solve moves through memory. Products and sums are double.
#pragma once

#include <cstdint>
#include <vector>

namespace cmps {

struct SparseMatrix {
    std::vector<std::uint32_t> start;  ///< rows + 1
    std::vector<std::uint32_t> upper;  ///< per row: first entry right of the diagonal
    std::vector<std::int32_t> column;
    std::vector<float> value;
    std::vector<double> diagonal;

    std::size_t rows() const { return diagonal.size(); }
};

/// y = A x
void multiply(const SparseMatrix& matrix, const std::vector<double>& x, std::vector<double>& y);

}  // namespace cmps
