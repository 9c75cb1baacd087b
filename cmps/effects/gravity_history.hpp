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
        field.settings.gravity_x = table_.value(1, time + 0.5 * step);
        field.settings.gravity_z = table_.value(2, time + 0.5 * step);
    }

 private:
    TimeTable table_;
};

}  // namespace cmps
