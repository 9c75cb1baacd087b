#include "cmps/path_average.hpp"

namespace cmps {

PathAverage::PathAverage(double time, Particles& particles) : time_(time) {
    for (auto& mean : particles.path_u) mean = particles.u;
    for (auto& mean : particles.path_w) mean = particles.w;
}

void PathAverage::begin_step(const Particles& particles) {
    old_x = particles.x, old_z = particles.z;
}

void PathAverage::end_step(Particles& particles, double step) const {
    const double share = step / (step + time_for(step));  // lags by the time exactly, at even steps
    const auto take = [&](const std::vector<double>& place, const std::vector<double>& old, auto& means) {
        for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i) {
            double value = (place[i] - old[i]) / step;
            for (auto& mean : means) value = mean[i] += share * (value - mean[i]);
        }
    };
    take(particles.x, old_x, particles.path_u);
    take(particles.z, old_z, particles.path_w);
}

void PathAverage::evaluate(const Particles& particles, double step, WaterMotion& motion) const {
    const double time = time_for(step);
    const auto find = [&](const auto& means, std::vector<double>& velocity, std::vector<double>& rate) {
        velocity.assign(particles.size(), 0.0), rate.assign(particles.size(), 0.0);
        for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i) {
            const double first = (means[0][i] - means[1][i]) / time,
                         second = (means[1][i] - means[2][i]) / time;
            rate[i] = 3.0 * first - 2.0 * second;
            // displacements are those of half a step ago
            velocity[i] = means[0][i] + (time + 0.5 * step) * first;
        }
    };
    find(particles.path_u, motion.u, motion.du_dt);
    find(particles.path_w, motion.w, motion.dw_dt);
}

}  // namespace cmps
