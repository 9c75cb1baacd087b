/// What samples in time lose of the waves: of the windows that drive the near field, and of its own flow
/// grid.
#pragma once

#include <string>
#include <vector>

#include "cmps/scene.hpp"
#include "common/sampling_error.hpp"

namespace cmps {

/// Part of the waves at one frequency.
struct WaveLine {
    double angular_frequency, amplitude;  ///< rad/s, any unit
};

/// Spectrum of the waves that [waves] or a piston's path gives; empty where neither says.
std::vector<WaveLine> wave_lines(const Scene& scene);

/// Rms error over the rms of waves that are known every `interval` seconds. 0 where nothing is known of them.
double wave_sampling_error(const std::vector<WaveLine>& lines, common::Interpolation interpolation,
                           double interval);

/// The largest interval, s, of two digits, whose error is `bound` at most. Needs lines.
double interval_of_error(const std::vector<WaveLine>& lines, common::Interpolation interpolation,
                         double bound);

/// An interval judged by the error of the accuracy level, that of the waves offshore.
struct SamplingVerdict {
    bool is_refused = false;  ///< more is lost than the level allows
    std::string text;         ///< what is lost and what would do; empty: less than a tenth of that
};
SamplingVerdict judge_sampling(const Scene& scene, common::Interpolation interpolation, double interval);

/// `interval` of a flow grid that does not give one, s: 80 samples a wave, more where else a tenth of the
/// level's error is passed; 0.02 where nothing is known of the waves.
double default_flow_interval(const Scene& scene);

}  // namespace cmps
