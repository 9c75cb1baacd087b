/// The solitary wave of the equations solved.
///
/// The equation of permanent_wave.hpp with C = m^2/d + g d^2/2 and p(h) = h'^2 is linear in p; a wave of
/// height H needs p = 0 at the crest and at rest, which fixes the speed. For alpha = 1: c^2 = g (d + H), eta
/// = H sech^2(K (x - c t)).
#pragma once

#include <vector>

#include "boussinesq/waves/incident_wave.hpp"

namespace boussinesq {

/// Speed of the solitary wave, m/s. Throws InputError when the equations carry none of that height.
double solitary_speed(double alpha, double height, double depth);

/// Crest at x = position at t = 0.
class SolitaryWave : public IncidentWave {
 public:
    SolitaryWave(double alpha, double height, double depth, double position);
    void at(double t, std::span<const double> x, std::span<double> elevation,
            std::span<double> velocity) const override;
    double elevation(double distance_from_crest) const;
    double speed() const { return speed_; }
    /// Distance from the crest where the elevation is `share` of the height, m.
    double reach(double share) const;

 private:
    double height_, depth_, position_, speed_, decay_, step_;
    std::vector<double> table_;  ///< elevation at multiples of step_ from the crest; exponential beyond
};

}  // namespace boussinesq
