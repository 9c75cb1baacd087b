#include "cmps/effects/moving_wall.hpp"

namespace cmps {

void MovingWall::begin_step(NearField& field, double time, double step) {
    speed_ = velocity_(time, step, position());
    Particles& particles = field.particles;
    for (std::size_t i = 0; i < particles.first_fluid(); ++i)
        if (particles.body[i] == body_moving_wall) particles.u[i] = speed_;
}

void MovingWall::end_step(NearField& field, double, double step) {
    Particles& particles = field.particles;
    const double before = foot();
    displacement_ += step * speed_;
    if (const double rise = foot() - before; rise != 0)
        for (std::size_t i = 0; i < particles.first_fluid(); ++i)
            if (particles.body[i] == body_moving_wall) particles.z[i] += rise;
    double pressure = 0;  // of all its rows, Pa
    for (std::size_t row = 0; row < particles.walls; ++row)
        if (particles.body[particles.first_wall() + row] == body_moving_wall)
            pressure += field.face_pressure[row];
    work_.add(pressure * field.settings.spacing * speed_ * step);
}

double returning_wall_velocity(double wave_velocity, double displacement, double return_time) {
    return wave_velocity - displacement / return_time;
}

}  // namespace cmps
