/// `boussinesq check`: what would be simulated, why, how long it takes and how accurate it is.
#pragma once

#include <string>

#include "boussinesq/scene.hpp"
#include "common/scene_file.hpp"

namespace boussinesq {

struct Forecast {
    double steps, seconds, nanoseconds_per_cell_step;
    double memory;           ///< bytes
    double relative_error;   ///< expected, of the wave; from the cost study
    std::string error_from;  ///< what it rests on
    std::string warning;     ///< the run goes wrong within its first steps; empty: it does not
};
/// Times a few hundred steps of the scene's own flume on this machine.
Forecast forecast(const Scene& scene);

/// Prints effects with reasons and the forecast; with `all` also the scene with every default filled in.
void print_check(const common::SceneFile& file, const Scene& scene, bool all);

}  // namespace boussinesq
