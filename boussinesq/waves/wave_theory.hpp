/// Linear wave theory, exact (Airy) and of the equations solved, and the limits of waves.
#pragma once

namespace boussinesq {

/// Linear dispersion of the equations solved, c^2 = g h (1 + (alpha-1) k^2 h^2 / 3) / (1 + alpha k^2 h^2 /
/// 3); shallow water where dispersion is off.
struct LinearDispersion {
    double alpha;
    bool is_dispersive = true;

    /// rad/m from angular frequency (rad/s) and still depth (m). Not finite where the equations carry no such
    /// wave (alpha = 1 and omega^2 d / g >= 3).
    double wave_number(double angular_frequency, double depth) const;
    double angular_frequency(double wave_number, double depth) const;
    /// d omega / d k, m/s
    double group_speed(double wave_number, double depth) const;
};

/// Airy: omega^2 = g k tanh(k d).
double airy_wave_number(double angular_frequency, double depth);
double airy_group_speed(double wave_number, double depth);

/// Largest height of a progressive wave over a level bed, m (Fenton 1990, fit to Williams' exact solutions).
double largest_wave_height(double length, double depth);

/// H L^2 / d^3: below about 26 Stokes waves, above cnoidal waves.
inline double ursell_number(double height, double length, double depth) {
    return height * length * length / (depth * depth * depth);
}

}  // namespace boussinesq
