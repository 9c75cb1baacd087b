/// Face values from cell averages.
///
/// WENO5 (Jiang and Shu 1996): fifth order where smooth, third-order stencils weighted away from jumps. The
/// weights are brought to one denominator, so that a value costs one division.
#pragma once

namespace boussinesq {

/// Value at the face between c and d from the averages a b | c | d e of the five cells around c.
/// `noise`: square of differences that do not count as a jump.
inline double weno5(double a, double b, double c, double d, double e, double noise) {
    const double p0 = 2.0 * a - 7.0 * b + 11.0 * c;
    const double p1 = -b + 5.0 * c + 2.0 * d;
    const double p2 = 2.0 * c + 5.0 * d - e;
    const double bend0 = a - 2.0 * b + c, slope0 = a - 4.0 * b + 3.0 * c;
    const double bend1 = b - 2.0 * c + d, slope1 = b - d;
    const double bend2 = c - 2.0 * d + e, slope2 = 3.0 * c - 4.0 * d + e;
    constexpr double r = 13.0 / 3.0;  // Jiang-Shu indicators times four
    const double s0 = noise + r * bend0 * bend0 + slope0 * slope0;
    const double s1 = noise + r * bend1 * bend1 + slope1 * slope1;
    const double s2 = noise + r * bend2 * bend2 + slope2 * slope2;
    const double t0 = s0 * s0, t1 = s1 * s1, t2 = s2 * s2;
    const double w0 = t1 * t2, w1 = 6.0 * t0 * t2, w2 = 3.0 * t0 * t1;
    return (w0 * p0 + w1 * p1 + w2 * p2) / (6.0 * (w0 + w1 + w2));
}

}  // namespace boussinesq
