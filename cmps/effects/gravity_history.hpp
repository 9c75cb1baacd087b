/// Gravity that changes with time (sloshing: the tank's own frame), from a table t, gx, gz.
#pragma once

#include <array>

#include "cmps/effects/work.hpp"
#include "cmps/near_field.hpp"
#include "cmps/time_table.hpp"

namespace cmps {

class GravityHistory final : public Effect {
 public:
    explicit GravityHistory(TimeTable table);
    std::string name() const override { return "gravity_history"; }
    void begin_step(NearField& field, double time, double step) override;
    void end_step(NearField& field, double time, double step) override;
    /// That of the table's strongest gravity: while there is little, more may come within a step.
    double longest_step(const NearField& field) const override;
    std::vector<double> state() const override { return {work_.net, work_.gross}; }
    void restore(const std::vector<double>& state) override { work_ = {state.at(0), state.at(1)}; }

    /// Of gravity, on all the water.
    const Work& work() const { return work_; }

 private:
    TimeTable table_;
    double strongest_ = 0;  // m/s2, at most
    Work work_;
    std::array<double, 2> before_ = {};  // sums of velocity over the fluid, m/s
};

}  // namespace cmps
