#include "dem/motion.hpp"

#include <cmath>

namespace dem {

namespace {

/// A quaternion in registers, not of unit length.
struct Turn {
    double w, v[3];
};

/// Turn about one body axis: the body-frame momentum goes round by the angle it makes, the orientation
/// follows. tan(angle/2) is replaced by half the angle: still an exact rotation, and still second order as a
/// splitting.
template <int axis>
inline void turn_about(Turn& turn, double (&momentum)[3], double inverse_inertia, double step) {
    constexpr int next = (axis + 1) % 3, last = (axis + 2) % 3;
    const double half_angle = 0.5 * step * momentum[axis] * inverse_inertia;
    const double scale = 1 / (1 + half_angle * half_angle);
    const double cosine = (1 - half_angle * half_angle) * scale, sine = 2 * half_angle * scale;
    const double a = momentum[next], b = momentum[last];
    momentum[next] = cosine * a + sine * b;
    momentum[last] = cosine * b - sine * a;
    // turn * (1, half_angle e_axis)
    const Turn q = turn;
    turn.w = q.w - half_angle * q.v[axis];
    turn.v[axis] = q.v[axis] + half_angle * q.w;
    turn.v[next] = q.v[next] + half_angle * q.v[last];
    turn.v[last] = q.v[last] - half_angle * q.v[next];
}

}  // namespace

void turn_freely(Quaternion& orientation, const Rotation& rotation, const Vector& angular_momentum,
                 const Vector& inverse_inertia, double step) {
    // About the angular momentum, with the moment of the first axis: (1, half angle) * orientation.
    const Vector half = 0.5 * step * inverse_inertia[0] * angular_momentum;
    const Quaternion& q = orientation;
    Turn turn{q.w() - half.x() * q.x() - half.y() * q.y() - half.z() * q.z(),
              {q.x() + half.x() * q.w() + half.y() * q.z() - half.z() * q.y(),
               q.y() + half.y() * q.w() + half.z() * q.x() - half.x() * q.z(),
               q.z() + half.z() * q.w() + half.x() * q.y() - half.y() * q.x()}};
    // The rest of the energy: (1/I_k - 1/I_1) l_k^2 / 2 for the other two axes.
    const double second = inverse_inertia[1] - inverse_inertia[0],
                 third = inverse_inertia[2] - inverse_inertia[0];
    const Vector in_body = rotation.transpose() * angular_momentum;
    double momentum[3] = {in_body.x(), in_body.y(), in_body.z()};
    if (second != 0) turn_about<1>(turn, momentum, second, 0.5 * step);
    if (third != 0) turn_about<2>(turn, momentum, third, step);
    if (second != 0) turn_about<1>(turn, momentum, second, 0.5 * step);
    const double scale = 1 / std::sqrt(turn.w * turn.w + turn.v[0] * turn.v[0] + turn.v[1] * turn.v[1] +
                                       turn.v[2] * turn.v[2]);
    orientation = Quaternion(scale * turn.w, scale * turn.v[0], scale * turn.v[1], scale * turn.v[2]);
}

double drift(Blocks& blocks, std::size_t block, double step) {
    blocks.position[block] += step * blocks.velocity[block];
    const Vector inverse_inertia = blocks.shape_of(block).inverse_inertia * (1 / blocks.mass_ratio[block]);
    turn_freely(blocks.orientation[block], blocks.rotation[block], blocks.angular_momentum[block],
                inverse_inertia, step);
    blocks.rotation[block] = blocks.orientation[block].toRotationMatrix();
    const Rotation& turn = blocks.rotation[block];
    blocks.angular_velocity[block] =
        turn * inverse_inertia.cwiseProduct(turn.transpose() * blocks.angular_momentum[block]);
    // The angles of all turns, each about an axis of its own, added up.
    const double turned = blocks.angular_momentum[block].norm() *
                          (inverse_inertia[0] + std::abs(inverse_inertia[1] - inverse_inertia[0]) +
                           std::abs(inverse_inertia[2] - inverse_inertia[0]));
    return step * (blocks.velocity[block].norm() + blocks.shape_of(block).radius * turned);
}

}  // namespace dem
