/// HDF5 files as plain values: attributes and datasets, written atomically, checked when read.
///
/// The only place that includes HDF5. Datasets are chunked as one piece with Fletcher32, so that a flipped
/// bit is noticed; the file is written under a temporary name, flushed, fsynced and renamed, so that a reader
/// never sees half.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace common {

/// A dataset: row-major values with shape and unit.
struct Dataset {
    std::string unit;
    std::vector<std::size_t> shape;
    std::variant<std::vector<double>, std::vector<float>, std::vector<std::int32_t>,
                 std::vector<std::uint64_t>>
        values;

    std::size_t size() const;
    /// The values as double, whatever they are stored as.
    std::vector<double> as_double() const;
    /// The values as they are stored; throws std::bad_variant_access on another type (read_window checks
    /// types).
    const std::vector<float>& floats() const { return std::get<std::vector<float>>(values); }
    const std::vector<double>& doubles() const { return std::get<std::vector<double>>(values); }
    const std::vector<std::int32_t>& integers() const { return std::get<std::vector<std::int32_t>>(values); }
    const std::vector<std::uint64_t>& words() const { return std::get<std::vector<std::uint64_t>>(values); }
};

/// float64 dataset.
Dataset real64(std::string unit, std::vector<std::size_t> shape, std::vector<double> values);
/// float32 dataset; accurate enough for fields.
Dataset real32(std::string unit, std::vector<std::size_t> shape, std::vector<float> values);
Dataset real32(std::string unit, std::vector<std::size_t> shape, std::span<const double> values);
Dataset integer32(std::string unit, std::vector<std::size_t> shape, std::vector<std::int32_t> values);
Dataset unsigned64(std::vector<std::size_t> shape, std::vector<std::uint64_t> values);

using Attribute = std::variant<std::string, double, std::int64_t>;

/// A whole HDF5 file in memory. Dataset names are absolute paths ("/flow/velocity"); groups follow from them.
struct DataFile {
    std::map<std::string, Attribute> attributes;
    std::map<std::string, Dataset> datasets;

    bool has(const std::string& dataset) const { return datasets.contains(dataset); }
    /// Throws InputError naming `dataset` when it is absent.
    const Dataset& at(const std::string& dataset) const;
    std::string text(const std::string& attribute) const;
    double number(const std::string& attribute) const;
    std::int64_t integer(const std::string& attribute) const;
};

/// Atomic: temporary name in the same folder, close, fsync, rename, fsync the folder. Throws RunError (disk
/// full, ...).
void write_data_file(const std::filesystem::path& path, const DataFile& file);

/// Reads all of it. Throws InputError that names the file and the dataset at fault (truncated, checksum,
/// type). `accept` sees attributes, units and shapes, without values, before any values are read, and throws
/// when they are not those wanted.
DataFile read_data_file(const std::filesystem::path& path,
                        const std::function<void(const DataFile&)>& accept = {});

/// Atomic replacement of a small text file (run.json) that can be made anew: renamed into place, not
/// synced. Throws RunError.
void write_text_file(const std::filesystem::path& path, std::string_view content);

}  // namespace common
