#include "cmps/effects/relaxation_zone.hpp"

#include <cmath>

namespace cmps {

void RelaxationZone::end_step(NearField& field, double time, double step) {
    waves_.go_to(time);
    Particles& particles = field.particles;
    const double wall = wall_.position(), back = wall_.displacement() / return_time_;
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i) {
        const double distance = particles.x[i] - wall;
        if (distance >= length_ || distance < 0) continue;
        const double share = 1.0 - distance / length_;
        const double blend = 1.0 - std::exp(-strength_ * share * share * step);
        double u, w;
        waves_.velocity(particles.x[i], particles.z[i], u, w);
        particles.u[i] += blend * (u - back - particles.u[i]);
        particles.w[i] += blend * (w - particles.w[i]);
    }
}

}  // namespace cmps
