/// Viscosity: u += dt nu 2 D/(lambda n0) sum (u_j - u_i) w, with walls at rest (no slip).
#pragma once

#include "cmps/near_field.hpp"

namespace cmps {

class Viscosity final : public Effect {
 public:
    explicit Viscosity(double kinematic) : kinematic_(kinematic) {}
    std::string name() const override { return "viscosity"; }
    double longest_step(const NearField& field) const override {
        return 0.25 * field.settings.spacing * field.settings.spacing / kinematic_;
    }
    void accelerate(NearField& field, double time, double step) override;

 private:
    double kinematic_;  // m2/s
    std::vector<double> du_, dw_;
};

}  // namespace cmps
