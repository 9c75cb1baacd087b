/// Active absorption: a wall that moves with the waves that come back to it, so that they leave.
///
/// A wave that travels offshore with elevation eta_r has the depth-averaged velocity -c eta_r / h. What
/// stands ahead of the wall beyond the elevation of the incoming waves is eta_r, so the wall of eq. (6)
/// becomes
///
///     v = u_B - (c / h) (eta - eta_B)                        (Schaffer & Klopman 2000)
///
/// eta is read over a short reach ahead of the wall: what stands there is on its way, by the time that the
/// smoothing in time then takes. It is the surface that is read, not a count of particles: they pack a little
/// differently beside a moving wall, and a steady millimetre carries the wall away.
#pragma once

#include "cmps/effects/moving_wall.hpp"
#include "cmps/near_field.hpp"
#include "cmps/solid.hpp"
#include "cmps/wave_field.hpp"

namespace cmps {

class Absorption final : public Effect {
 public:
    /// celerity of the waves, m/s; gain 1: all of it; reach ahead of the wall, m.
    Absorption(WaveField& waves, const MovingWall& wall, const Solid& solid, double celerity, double gain,
               double reach)
        : waves_(waves), wall_(wall), solid_(solid), celerity_(celerity), gain_(gain), reach_(reach) {}
    std::string name() const override { return "absorption"; }
    void end_step(NearField& field, double time, double step) override;
    std::vector<double> state() const override { return {excess_}; }
    void restore(const std::vector<double>& state) override { excess_ = state.at(0); }

    /// What the wall adds to its velocity, m/s.
    double velocity() const;

 private:
    WaveField& waves_;
    const MovingWall& wall_;
    const Solid& solid_;
    double celerity_, gain_, reach_, excess_ = 0;
};

}  // namespace cmps
