/// What a run will cost, before it runs.
#pragma once

#include <cstddef>

#include "cmps/scene.hpp"

namespace cmps {

struct Forecast {
    std::size_t fluid = 0, boundary = 0;  ///< particles
    double start = 0;                     ///< s, estimated when the near field starts at arrival
    double step = 0;                      ///< mean time step expected, s
    double steps = 0;
    double seconds = 0;  ///< wall time on this machine, one thread
    double memory = 0;   ///< bytes
};

/// Fills the scene and times a few steps of it at rest (well under a second for most scenes).
/// `start`: known start, s; negative: estimated from the travel time of long waves over the bed.
Forecast make_forecast(const Scene& scene, double start);

}  // namespace cmps
