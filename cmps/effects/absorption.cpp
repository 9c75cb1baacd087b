#include "cmps/effects/absorption.hpp"

#include <algorithm>
#include <cmath>

namespace cmps {

double Absorption::velocity() const {
    return -gain_ * celerity_ / waves_.still_water_depth(wall_.position()) * excess_;
}

void Absorption::end_step(NearField& field, double time, double step) {
    const double wall = wall_.position(), l0 = field.settings.spacing;
    const Particles& particles = field.particles;
    double share = 0;  // of the particles, each weighted by 1 - distance / reach
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
        share += std::max(0.0, 1.0 - std::max(0.0, particles.x[i] - wall) / reach_);
    waves_.go_to(time);
    constexpr int places = 8;  // the waves are hundreds of reaches long
    double incoming = 0;
    for (int k = 0; k < places; ++k) {
        const double part = (k + 0.5) / places, x = wall + part * reach_;
        incoming +=
            (1.0 - part) * (waves_.still_water_depth(x) + waves_.surface_elevation(x)) * reach_ / places;
    }
    const double excess = (share * l0 * l0 - incoming) / (0.5 * reach_);
    // the weights' centre lies a third of the reach ahead: what is seen there arrives after this time
    const double delay = reach_ / (3.0 * celerity_);
    excess_ += (1.0 - std::exp(-step / delay)) * (excess - excess_);
}

}  // namespace cmps
