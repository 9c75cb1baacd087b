/// What gauges see: surface elevation and velocity at points, each at its own interval.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/window.hpp"

namespace boussinesq {

/// One gauge's whole record.
struct GaugeRecord {
    std::string name;
    double x;                                       ///< m
    double interval;                                ///< s
    std::vector<double> time, elevation, velocity;  ///< s, m, m/s
};

/// Writes the samples of one window, /gauges/<name>/..., from the records.
void add_gauges(common::Window& window, const std::vector<GaugeRecord>& records);

/// Fills records from the windows [0, count) of a folder, when a run goes on.
void read_gauges(const std::filesystem::path& folder, std::int64_t count, std::vector<GaugeRecord>& records);

}  // namespace boussinesq
