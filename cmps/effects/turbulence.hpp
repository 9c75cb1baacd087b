/// Sub-particle turbulence (Smagorinsky): nu_t = (C_s l0)^2 |S|, |S| = sqrt(2 S_ij S_ij) from the corrected
/// velocity gradient (Gotoh, Shibahara & Sakai 2001).
#pragma once

#include "cmps/near_field.hpp"

namespace cmps {

class Turbulence final : public Effect {
 public:
    explicit Turbulence(double constant) : constant_(constant) {}
    std::string name() const override { return "turbulence"; }
    void accelerate(NearField& field, double time, double step) override;

 private:
    double constant_;
    std::vector<double> eddy_viscosity_, du_, dw_;
};

}  // namespace cmps
