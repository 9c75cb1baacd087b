/// Velocity over the depth, from what a window holds.
///
/// With u, h, b of the window and slopes along x by central differences (order (k d)^4 of the equations
/// themselves):
///
///     u(z) = u - [(z-b)^2/2 - h^2/6] u_xx + [(z-b) - h/2] (2 b_x u_x + b_xx u)
///     w(z) = -(z-b) u_x + b_x u
///
/// Its depth average is u; w is zero through a level bed.
#pragma once

namespace boussinesq {

/// Depth-averaged velocity and its slopes (m/s, 1/s, 1/(m s)), bed level (m), slope and curvature (1/m),
/// total depth (m).
struct Column {
    double velocity, velocity_slope, velocity_curvature;
    double bed, bed_slope, bed_curvature;
    double depth;
};

struct VelocityAt {
    double horizontal, vertical;  ///< m/s
};

/// Velocity at level z, bed <= z <= bed + depth.
constexpr VelocityAt velocity_at(const Column& c, double z) {
    const double above = z - c.bed;
    return {
        c.velocity - (0.5 * above * above - c.depth * c.depth / 6.0) * c.velocity_curvature +
            (above - 0.5 * c.depth) * (2.0 * c.bed_slope * c.velocity_slope + c.bed_curvature * c.velocity),
        c.bed_slope * c.velocity - above * c.velocity_slope};
}

}  // namespace boussinesq
