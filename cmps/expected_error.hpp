/// Errors measured by workflows/studies/cost_cmps.py, by resolution: what `check` expects of a run.
#pragma once

#include <string>

namespace cmps {

/// Errors at a number of particles over the depth, read off the measured ladder by log-log interpolation.
struct ExpectedError {
    double floor_pressure;  ///< still water: rms of p/(rho g h) - 1
    double levels;          ///< dam break (Lobovsky et al. 2014): rms of the levels over H
    double wave_height;     ///< standing wave, kh = 1.6: share of the height lost in a period
};

/// One line for `check`: what the figures are errors of, and where they come from. Beyond the ladder's ends
/// the end's figures are taken (finer) or the trend is continued (coarser). `kernel_radius`: over l0.
std::string expected_error_text(double particles_over_depth, double kernel_radius);

}  // namespace cmps
