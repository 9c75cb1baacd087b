/// Tables of numbers from CSV files: a header line of names, then rows of numbers.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace boussinesq {

struct CsvTable {
    std::vector<std::string> names;
    std::vector<std::vector<double>> columns;
    std::vector<std::size_t> lines;  ///< line of the file each row stands on

    /// Column of that name (or any of its aliases), or null.
    const std::vector<double>* column(const std::vector<std::string>& aliases) const;
};

/// Throws InputError naming file and line: no header, a row of another length, a word that is not a finite
/// number.
CsvTable read_csv(const std::filesystem::path& path);

}  // namespace boussinesq
