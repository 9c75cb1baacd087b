/// Periodic waves of permanent form: exact solutions of the equations solved, for any height they carry.
///
/// In the frame that moves with the wave, h v = -m and the momentum equation integrates once to
///
///     m^2/h + g h^2/2 + (alpha/3) [h'' (m^2 - (1 - 1/alpha) g h^3) - 3 m^2 h'^2 / h] + (2/3) m^2 h'^2 / h =
///     C
///
/// solved for a cosine series of h by collocation and Newton, from a small wave up to the height asked for. A
/// wave so made keeps its form on the grid, which Stokes or cnoidal theory, solutions of other equations, do
/// not quite. For the classical equations, alpha = 1, and Ursell numbers above 26 the exact cnoidal wave is
/// taken instead, by elliptic functions. The mean mass flux is zero (Stokes' second definition), as in a
/// closed flume: c = m / d, L = c T.
#pragma once

#include <vector>

#include "boussinesq/waves/incident_wave.hpp"

namespace boussinesq {

/// Roots h1 < h2 < h3 and modulus of the exact periodic solution of the classical equations (alpha = 1),
/// h = h2 + (h3 - h2) cn^2(...), with elliptic functions (El, Grimshaw and Smyth 2006); the cnoidal wave of
/// these equations.
struct CnoidalWave {
    double h1, h2, h3, modulus, wave_number;

    double speed(double depth) const;
    /// Total depth at phase theta (0: crest), m.
    double depth_at(double phase) const;
};
/// Throws InputError when no such wave exists.
CnoidalWave cnoidal_wave(double height, double period, double depth);

/// A permanent periodic wave: its profile, speed and flux.
struct PermanentForm {
    double period, length, speed;   ///< s, m, m/s
    double still_depth;             ///< mean depth d, m
    double flux;                    ///< m = c d, m2/s
    std::vector<double> amplitude;  ///< of cos(n theta), n = 1, 2, ...; m

    double elevation(double phase) const;
};
/// `alpha` of the equations; height, period and mean depth in m and s. Throws InputError when Newton finds no
/// wave.
PermanentForm permanent_form(double alpha, double height, double period, double depth);

/// Regular waves; the crest passes x = position at t = 0.
class RegularWave : public IncidentWave {
 public:
    RegularWave(PermanentForm form, double position);
    void at(double t, std::span<const double> x, std::span<double> elevation,
            std::span<double> velocity) const override;

 private:
    PermanentForm form_;
    double position_;
    std::vector<double> table_;  ///< elevation over one length, with wrapped ends
};

}  // namespace boussinesq
