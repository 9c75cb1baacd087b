/// What samples lose: the error of a sinusoid that is known at even instants and interpolated in between.
#pragma once

namespace common {

/// How values between samples are found.
enum class Interpolation {
    linear,       ///< a straight line
    cubic_slopes  ///< cubic of two values and two slopes; a slope is that of the cubic through its sample and
                  ///< the three before (how cmps follows waves)
};

/// Root mean square over a period of the error over that of the sinusoid; `samples` in each of its periods.
/// Near 1 and above: the samples say nothing about it.
double sampling_error(Interpolation interpolation, double samples);

}  // namespace common
