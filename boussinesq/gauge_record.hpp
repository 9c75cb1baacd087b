/// What gauges see: surface elevation and velocity at points, each at its own interval.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/window.hpp"

namespace boussinesq {

/// One gauge's whole record.
struct GaugeRecord {
    std::string name;
    double x;         ///< m
    double interval;  ///< s
    std::array<double, 2>
        array;  ///< x of two more points that tell reflected waves apart, m; equal to x: none
    std::vector<double> time, elevation, velocity;          ///< s, m, m/s
    std::vector<double> second_elevation, third_elevation;  ///< at the points of `array`, m

    bool has_array() const { return array[0] != x; }
};

/// Writes the samples of one window, /gauges/<name>/..., from the records.
void add_gauges(common::Window& window, const std::vector<GaugeRecord>& records);

/// Fills records from the windows [0, count) of a folder, when a run goes on.
void read_gauges(const std::filesystem::path& folder, std::int64_t count, std::vector<GaugeRecord>& records);

}  // namespace boussinesq
