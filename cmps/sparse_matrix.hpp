/// Symmetric sparse matrix in compressed rows: diagonal apart, off-diagonal entries ascending in each row.
#pragma once

#include <cstdint>
#include <vector>

namespace cmps {

struct SparseMatrix {
    std::vector<std::uint32_t> start;  ///< rows + 1
    std::vector<std::uint32_t> upper;  ///< per row: first entry right of the diagonal
    std::vector<std::int32_t> column;
    std::vector<double> value;
    std::vector<double> diagonal;

    std::size_t rows() const { return diagonal.size(); }
};

/// y = A x
void multiply(const SparseMatrix& matrix, const std::vector<double>& x, std::vector<double>& y);

}  // namespace cmps
