/// Columns over time from a text file: commas or blanks between numbers; words are heads before the first
/// numbers, lines that begin with # may stand anywhere.
#pragma once

#include <array>
#include <filesystem>
#include <vector>

namespace cmps {

/// Values between rows by Steffen's monotone cubic (no overshoot); held constant outside the table.
class TimeTable {
 public:
    /// Expects `columns` numbers a line, the first one the time (s), increasing. Throws InputError with the
    /// line at fault.
    TimeTable(const std::filesystem::path& file, std::size_t columns);
    /// Column 1, 2, ... at `time`.
    double value(std::size_t column, double time) const;
    /// Mean of a column over [from, to].
    double mean(std::size_t column, double from, double to) const;
    /// Least and greatest value of a column.
    std::array<double, 2> range(std::size_t column) const;
    /// Largest mean rate of change of a column between two rows, per s.
    double fastest(std::size_t column) const;
    /// Mean period of a column that swings to and fro, s: twice the time between its turns, those of a tenth
    /// of its range and more; 0: it turns fewer than three times.
    double period(std::size_t column) const;
    double first_time() const { return columns_[0].front(); }
    double last_time() const { return columns_[0].back(); }

 private:
    std::vector<std::vector<double>> columns_;
    std::vector<std::vector<double>> slopes_;
};

}  // namespace cmps
