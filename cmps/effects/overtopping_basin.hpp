/// Water that passes over the structure is collected and counted; the basin behind is not simulated.
#pragma once

#include "cmps/near_field.hpp"

namespace cmps {

class OvertoppingBasin final : public Effect {
 public:
    /// Fluid beyond x (m) is taken out.
    explicit OvertoppingBasin(double x) : x_(x) {}
    std::string name() const override { return "overtopping_basin"; }
    void end_step(NearField& field, double time, double step) override;
    std::vector<double> state() const override { return {static_cast<double>(collected_)}; }
    void restore(const std::vector<double>& state) override {
        collected_ = static_cast<std::size_t>(state.at(0));
    }
    std::size_t collected() const { return collected_; }

 private:
    double x_;
    std::size_t collected_ = 0;
};

}  // namespace cmps
