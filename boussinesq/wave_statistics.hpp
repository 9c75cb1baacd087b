/// Statistics of a gauge's record: wave heights and periods, mean level, reflection.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "boussinesq/waves/wave_theory.hpp"

namespace boussinesq {

/// Waves between upward crossings of the record's mean (Goda 2010, section 10.2).
struct WaveStatistics {
    std::size_t waves = 0;
    double significant_height = 0,
           significant_period = 0;                  ///< H_1/3, T_1/3: means over the highest third, m and s
    double largest_height = 0, largest_period = 0;  ///< H_max and its period
    double mean_height = 0, mean_period = 0;
    double mean_level = 0;           ///< set-up, m
    double root_mean_square = 0;     ///< of elevation about the mean, m
    double highest = 0, lowest = 0;  ///< m
};

/// `time` increases, s; elevation in m. Steps may differ.
WaveStatistics wave_statistics(std::span<const double> time, std::span<const double> elevation);

/// Mean level while the surface stands above `lowest` (m), and for how much of the time it does: on a beach
/// that falls dry the surface is the bed, which is no level of water.
struct WetLevel {
    double share = 0, mean = 0;  ///< -, m
};
WetLevel level_while_wet(std::span<const double> time, std::span<const double> elevation, double lowest);

/// Incident and reflected waves apart, from three gauges in line (Mansard and Funke 1980: least squares).
struct Reflection {
    double incident_height = 0,
           reflected_height = 0;  ///< 2 sqrt(2) sigma of each part: height for regular waves, m
    double coefficient = 0;       ///< reflected over incident
};

/// `elevation`: three records over the same times; `place`: their x (m); `depth` there (m); `frequencies`:
/// angular frequencies of the components (rad/s), multiples of 2 pi over the record's length for clean
/// separation.
Reflection reflection_of(std::span<const double> time,
                         const std::array<std::span<const double>, 3>& elevation,
                         const std::array<double, 3>& place, double depth, const LinearDispersion& dispersion,
                         std::span<const double> frequencies);

}  // namespace boussinesq
