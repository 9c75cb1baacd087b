#include "dem/motion.hpp"

namespace dem {

namespace {

/// Turn about one body axis: the body-frame momentum goes round by the angle it makes in `step`, the orientation follows.
/// tan(angle/2) is replaced by half the angle: still an exact rotation, and still second order as a splitting.
template <int axis>
void turn_about(Quaternion& orientation, Vector& momentum_in_body, double inertia, double step) {
    constexpr int next = (axis + 1) % 3, last = (axis + 2) % 3;
    const double half_angle = 0.5 * step * momentum_in_body[axis] / inertia;
    const double scale = 1 / (1 + half_angle * half_angle);
    const double cosine = (1 - half_angle * half_angle) * scale, sine = 2 * half_angle * scale;
    const double a = momentum_in_body[next], b = momentum_in_body[last];
    momentum_in_body[next] = cosine * a + sine * b;
    momentum_in_body[last] = cosine * b - sine * a;
    // orientation * (1, half_angle e_axis), not yet of unit length.
    const auto q = orientation.coeffs();  // x, y, z, w
    const double w = q[3], p = q[axis], n = q[next], l = q[last];
    auto& out = orientation.coeffs();
    out[3] = w - half_angle * p;
    out[axis] = p + half_angle * w;
    out[next] = n + half_angle * l;
    out[last] = l - half_angle * n;
}

}  // namespace

void turn_freely(Quaternion& orientation, const Vector& angular_momentum, const Vector& inertia, double step) {
    Vector in_body = orientation.toRotationMatrix().transpose() * angular_momentum;
    turn_about<0>(orientation, in_body, inertia[0], 0.5 * step);
    turn_about<1>(orientation, in_body, inertia[1], 0.5 * step);
    turn_about<2>(orientation, in_body, inertia[2], step);
    turn_about<1>(orientation, in_body, inertia[1], 0.5 * step);
    turn_about<0>(orientation, in_body, inertia[0], 0.5 * step);
    orientation.normalize();
}

void drift(Blocks& blocks, std::size_t block, double step) {
    blocks.position[block] += step * blocks.velocity[block];
    turn_freely(blocks.orientation[block], blocks.angular_momentum[block], blocks.inertia(block), step);
    blocks.rotation[block] = blocks.orientation[block].toRotationMatrix();
    blocks.update_angular_velocity(block);
}

}  // namespace dem
