/// The moving wall that drives the near field, eq. (6), or a piston whose path is given.
#pragma once

#include <functional>

#include "cmps/effects/work.hpp"
#include "cmps/near_field.hpp"

namespace cmps {

/// Moves every boundary particle of `body_moving_wall` with one velocity. The wall stands on the bed wherever
/// it goes; that it rises and sinks with the ground is no velocity: it slides past the water.
class MovingWall final : public Effect {
 public:
    /// `velocity(time, step, x)`: mean velocity from `time` to `time + step` of the wall that stands at x,
    /// m/s. `bed(x)`: level of the bed, m. The wall starts at `x`.
    MovingWall(
        double x, std::function<double(double, double, double)> velocity,
        std::function<double(double)> bed = [](double) { return 0.0; })
        : start_(x), velocity_(std::move(velocity)), bed_(std::move(bed)) {}
    std::string name() const override { return "moving_wall"; }
    void begin_step(NearField& field, double time, double step) override;
    void end_step(NearField& field, double time, double step) override;
    std::vector<double> state() const override { return {displacement_, speed_, work_.net, work_.gross}; }
    void restore(const std::vector<double>& state) override {
        displacement_ = state.at(0), speed_ = state.at(1), work_ = {state.at(2), state.at(3)};
    }

    /// Present place of its face, m.
    double position() const { return start_ + displacement_; }
    double displacement() const { return displacement_; }
    /// Level of the bed that it stands on, m.
    double foot() const { return bed_(position()); }
    /// Of its face's pressure on the water.
    const Work& work() const { return work_; }

 private:
    double start_;
    std::function<double(double, double, double)> velocity_;
    std::function<double(double)> bed_;
    double displacement_ = 0, speed_ = 0;
    Work work_;
};

/// The velocity of eq. (6), brought back slowly: the mean mass flux of the waves would carry the wall away.
/// v = u_B(x_wall, t) - (x_wall - x_start) / return_time
double returning_wall_velocity(double wave_velocity, double displacement, double return_time);

}  // namespace cmps
