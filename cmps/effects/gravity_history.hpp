/// Gravity that changes with time (sloshing: the tank's own frame), from a table t, gx, gz.
#pragma once

#include "cmps/near_field.hpp"
#include "cmps/time_table.hpp"

namespace cmps {

class GravityHistory final : public Effect {
 public:
    explicit GravityHistory(TimeTable table) : table_(std::move(table)) {}
    std::string name() const override { return "gravity_history"; }
    void begin_step(NearField& field, double time, double step) override {
        // means, so that a jerk within a step gives the water its whole impulse
        field.settings.gravity_x = table_.mean(1, time, time + step);
        field.settings.gravity_z = table_.mean(2, time, time + step);
    }

 private:
    TimeTable table_;
};

}  // namespace cmps
