#include "cmps/effects/overtopping_basin.hpp"

namespace cmps {

void OvertoppingBasin::end_step(NearField& field, double, double) {
    Particles& particles = field.particles;
    for (std::size_t i = particles.size(); i-- > particles.first_fluid();)
        if (particles.x[i] > x_) particles.remove_fluid(i), ++collected_;
}

}  // namespace cmps
