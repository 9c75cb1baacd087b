/// What the water does, for those who need it smoother than particles move: velocity and acceleration along
/// the path of each particle, from where it really went - drift, shifting and contacts together. A particle's
/// own velocity is not that: where shifting pushes it on, it stands against it, and in still water both go on
/// for ever, layer by layer.
///
/// Three exponential means S1, S2, S3 in a row, each over the time T, of displacement over step:
///
///     velocity      2 S1 - S2                               lag removed, amplitude + (omega T)^2
///     acceleration  [3 (S1 - S2) - 2 (S2 - S3)] / T          lag removed, amplitude + 3 (omega T)^2
///
/// against S1 and (v - S1)/T with a lag of T each, and the noise of the last step in the second.
#pragma once

#include <vector>

#include "cmps/particles.hpp"

namespace cmps {

/// Per particle, m/s and m/s2.
struct WaterMotion {
    std::vector<double> u, w, du_dt, dw_dt;
};

class PathAverage {
 public:
    /// `time`: T, s. The particles' velocities are those of their paths so far.
    PathAverage(double time, Particles& particles);
    /// Before a step: notes where the particles are.
    void begin_step(const Particles& particles);
    /// After it.
    void end_step(Particles& particles, double step) const;
    /// The motion now; `step`: that of the last step, s.
    void evaluate(const Particles& particles, double step, WaterMotion& motion) const;

    std::vector<double> old_x, old_z;  ///< places before the step; go along when particles are put in order

 private:
    double time_for(double step) const { return time_ > step ? time_ : step; }
    double time_;
};

}  // namespace cmps
