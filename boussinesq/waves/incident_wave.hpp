/// The wave that comes in from offshore, as a function of place and time over a level bed.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace boussinesq {

/// Incident surface elevation (m) and depth-averaged velocity (m/s).
class IncidentWave {
 public:
    virtual ~IncidentWave() = default;
    /// Fills elevation and velocity at the places x (m) at time t (s).
    virtual void at(double t, std::span<const double> x, std::span<double> elevation,
                    std::span<double> velocity) const = 0;
};

}  // namespace boussinesq
