#include "cmps/effects/absorption.hpp"

#include <cmath>

#include "cmps/gauges.hpp"

namespace cmps {

double Absorption::velocity() const {
    return -gain_ * celerity_ / waves_.still_water_depth(wall_.position()) * excess_;
}

void Absorption::end_step(NearField& field, double time, double step) {
    waves_.go_to(time);
    constexpr int places = 4;
    double sum = 0, weights = 0;
    for (int k = 0; k < places; ++k) {
        const double part = (k + 0.5) / places, x = wall_.position() + part * reach_;
        const double eta = surface_elevation(field.particles, solid_, field.settings.spacing, x);
        sum += (1.0 - part) * (eta - waves_.surface_elevation(x)), weights += 1.0 - part;
    }
    // the weights' centre lies a third of the reach ahead: what is seen there arrives after this time
    const double delay = reach_ / (3.0 * celerity_);
    excess_ += (1.0 - std::exp(-step / delay)) * (sum / weights - excess_);
}

}  // namespace cmps
