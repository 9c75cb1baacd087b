/// Sphere elements and the water they stand in: the constants of eqs. (8)-(12) of Gotoh et al. (2009).
#pragma once

#include <cmath>
#include <numbers>

namespace dem {

/// The element from which the paper builds its blocks.
struct Element {
    double diameter = 0.008;       ///< d, m
    double density_ratio = 3.689;  ///< s, density of an element over that of water

    double volume() const { return std::numbers::pi / 6 * diameter * diameter * diameter; }  ///< A3 d^3, m^3
    double section() const { return std::numbers::pi / 4 * diameter * diameter; }            ///< A2 d^2, m^2
};

struct Water {
    double density = 1000;                ///< kg/m^3
    double viscosity = 1e-6;              ///< kinematic, m^2/s
    double added_mass_coefficient = 0.5;  ///< C_M
    double drag_coefficient = 0.4;        ///< C_D of eq. (12) at high Reynolds numbers
};

/// Elastic and frictional properties shared by all spheres.
struct Material {
    double young_modulus = 1.0e7;  ///< Pa
    double poisson_ratio = 0.3;
    double friction = 0.577;     ///< Coulomb coefficient mu
    double damping_ratio = 1.0;  ///< 1: critical damping of the two-body system

    /// E* of two bodies of this material, Pa.
    double contact_modulus() const { return young_modulus / (2 * (1 - poisson_ratio * poisson_ratio)); }
    /// G* of two bodies of this material (Mindlin), Pa.
    double contact_shear_modulus() const {
        const double shear_modulus = young_modulus / (2 * (1 + poisson_ratio));
        return shear_modulus / (2 * (2 - poisson_ratio));
    }
    /// Tangential over normal stiffness of a contact: 8 G* sqrt(R delta) over 2 E* sqrt(R delta).
    double stiffness_ratio() const { return 4 * contact_shear_modulus() / contact_modulus(); }
    /// Normal stiffness dF/d(overlap) of Hertz theory, N/m.
    double hertz_stiffness(double reduced_radius, double overlap) const {
        return 2 * contact_modulus() * std::sqrt(reduced_radius * overlap);
    }
};

}  // namespace dem
