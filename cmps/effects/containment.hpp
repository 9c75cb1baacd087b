/// No particle inside the solid, whatever the angle of a corner: one that got there is put back on the
/// nearest face and loses its speed into it.
#pragma once

#include "cmps/near_field.hpp"
#include "cmps/solid.hpp"

namespace cmps {

class Containment final : public Effect {
 public:
    explicit Containment(const Solid& solid) : solid_(solid) {}
    std::string name() const override { return "containment"; }
    void end_step(NearField& field, double time, double step) override;
    std::vector<double> state() const override { return {static_cast<double>(returned_)}; }
    void restore(const std::vector<double>& state) override {
        returned_ = static_cast<std::size_t>(state.at(0));
    }
    std::size_t returned() const { return returned_; }

 private:
    const Solid& solid_;
    std::size_t returned_ = 0;
};

}  // namespace cmps
