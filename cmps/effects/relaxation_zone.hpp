/// Open boundary: velocities are drawn towards those of the waves in a zone behind the moving wall, so that
/// waves coming back leave.
///
///     u += (1 - exp(-chi dt)) (u_B(x, z, t) - u),   chi = strength (1 - distance / length)^2
#pragma once

#include "cmps/effects/moving_wall.hpp"
#include "cmps/near_field.hpp"
#include "cmps/wave_field.hpp"

namespace cmps {

class RelaxationZone final : public Effect {
 public:
    /// length in m, strength in 1/s; `offset(…)` of the wall's return is taken off the target velocity.
    RelaxationZone(WaveField& waves, const MovingWall& wall, double length, double strength,
                   double return_time)
        : waves_(waves), wall_(wall), length_(length), strength_(strength), return_time_(return_time) {}
    std::string name() const override { return "relaxation_zone"; }
    void end_step(NearField& field, double time, double step) override;

 private:
    WaveField& waves_;
    const MovingWall& wall_;
    double length_, strength_, return_time_;
};

}  // namespace cmps
