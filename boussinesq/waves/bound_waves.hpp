/// Waves bound to a sea of linear components, to second order in the wave height, for the very equations
/// solved: long waves that follow the groups (sub-harmonics; Longuet-Higgins and Stewart 1962) and the
/// sharpening of crests (super-harmonics). A sea made without them sends free waves along that are neither
/// asked for nor there in nature.
///
/// Two components of amplitudes A, wave numbers k and angular frequencies w force, at K = k1 +- k2 and
/// W = w1 +- w2, an elevation E A1 A2 cos(K x - W t) and a velocity V A1 A2 cos(K x - W t). E and V are
/// smooth in k1 and k2, so they are taken at a few Chebyshev points: the double sum over n components costs
/// n * points.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "boussinesq/waves/wave_theory.hpp"

namespace boussinesq {

/// For one ordered pair of components (each pair of different ones counts twice), unit amplitudes.
struct BoundPair {
    double elevation;  ///< E, 1/m
    double velocity;   ///< V, 1/(m s)
};
/// `sign` +1: sum, -1: difference. Two equal components have the limit as they draw near.
BoundPair bound_pair(const LinearDispersion& dispersion, double depth, double k1, double k2, int sign);

/// All pairs of a sea. With a_p = sum over components of share(p, n) e^(i phase_n):
/// elevation = Re(a)' E_real Re(a) + Im(a)' E_imaginary Im(a) - mean, velocity likewise.
struct BoundWaves {
    Eigen::MatrixXd share;  ///< points x components, amplitude included
    Eigen::MatrixXd elevation_real, elevation_imaginary, velocity_real, velocity_imaginary;
    double mean_elevation = 0;  ///< taken off: the mean level stays that of still water, m
    double mean_velocity = 0;   ///< taken off: no mean flux of water, m/s
};
BoundWaves bound_waves(const LinearDispersion& dispersion, double depth,
                       const std::vector<double>& wave_numbers, const std::vector<double>& amplitudes);

}  // namespace boussinesq
