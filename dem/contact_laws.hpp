/// Contact laws between two spheres: normal spring, and friction or its absence.
///
/// Each law is a small struct; contacts.cpp is compiled once for every pair of them, so that no flag is
/// tested per contact.
#pragma once

#include <algorithm>
#include <cmath>

#include "dem/material.hpp"
#include "dem/vector.hpp"

namespace dem {

/// F = 4/3 E* sqrt(R*) overlap^(3/2) (Hertz).
struct HertzLaw {
    double twice_contact_modulus;

    explicit HertzLaw(const Material& material) : twice_contact_modulus(2 * material.contact_modulus()) {}
    /// dF/d(overlap), N/m.
    double stiffness(double reduced_radius, double overlap) const {
        return twice_contact_modulus * std::sqrt(reduced_radius * overlap);
    }
    static double force(double stiffness, double overlap) { return 2.0 / 3.0 * stiffness * overlap; }
    static double energy(double stiffness, double overlap) { return 4.0 / 15.0 * stiffness * overlap * overlap; }
};

/// F = k_n overlap, with k_n of Hertz theory at a reference overlap.
struct LinearLaw {
    double normal_stiffness;

    /// The stiffness at `reference_overlap` (m) between two elements of radius d/2.
    LinearLaw(const Material& material, double element_diameter, double reference_overlap)
        : normal_stiffness(material.hertz_stiffness(element_diameter / 4, reference_overlap)) {}
    double stiffness(double, double) const { return normal_stiffness; }
    static double force(double stiffness, double overlap) { return stiffness * overlap; }
    static double energy(double stiffness, double overlap) { return 0.5 * stiffness * overlap * overlap; }
};

/// What a tangential law gives back for one contact.
struct TangentialForce {
    Vector force;        ///< on the first body, N
    double dissipated;   ///< J in this step
};

/// Mindlin spring with history, dashpot, and the Coulomb limit.
///
/// The spring's force is stored, not its displacement: a displacement times a stiffness that grows with the overlap
/// would gain energy. When the contact unloads, the force shrinks with the stiffness (Thornton et al. 2013).
struct CoulombFriction {
    double coefficient;
    double stiffness_ratio;

    explicit CoulombFriction(const Material& material)
        : coefficient(material.friction), stiffness_ratio(material.stiffness_ratio()) {}

    /// `spring`: stored force on the first body (updated); `stiffness_before`: normal stiffness one step ago.
    /// `slip_speed`: velocity of the first body relative to the second, tangential, m/s.
    TangentialForce force(Vector& spring, double stiffness_before, double stiffness, const Vector& normal,
                          const Vector& slip_speed, double normal_force, double damping_scale, double dt) const {
        const double tangential_stiffness = stiffness_ratio * stiffness;
        double dissipated = 0;
        // The stored force turns with the pair of bodies: into the new tangent plane, at its old length.
        const double before = spring.squaredNorm();
        if (before > 0) {
            spring -= spring.dot(normal) * normal;
            const double turned = spring.squaredNorm();
            const double energy_before = before / (2 * stiffness_ratio * stiffness_before);
            if (turned > 0) spring *= std::sqrt(before / turned) * std::min(1.0, stiffness / stiffness_before);
            dissipated += energy_before - spring.squaredNorm() / (2 * tangential_stiffness);
        }
        spring -= tangential_stiffness * dt * slip_speed;

        const double limit = coefficient * normal_force;
        const double length_squared = spring.squaredNorm();
        if (length_squared > limit * limit) {  // slides: the spring gives way
            const double length = std::sqrt(length_squared);
            dissipated += (length - limit) * (length + limit) / (2 * tangential_stiffness);
            spring *= limit / length;
            return {spring, dissipated};
        }
        // Sticks: as much of the dashpot as the Coulomb circle allows.
        const Vector dashpot = -damping_scale * std::sqrt(tangential_stiffness) * slip_speed;
        double share = 1;
        if ((spring + dashpot).squaredNorm() > limit * limit) {
            const double a = dashpot.squaredNorm(), b = spring.dot(dashpot), c = length_squared - limit * limit;
            share = a > 0 ? (-b + std::sqrt(std::max(0.0, b * b - a * c))) / a : 0.0;
        }
        dissipated -= share * dashpot.dot(slip_speed) * dt;
        return {spring + share * dashpot, dissipated};
    }
    double ratio() const { return stiffness_ratio; }
    double energy(const Vector& spring, double stiffness) const {
        return spring.squaredNorm() / (2 * stiffness_ratio * stiffness);
    }
};

/// mu = 0.
struct Frictionless {
    static TangentialForce force(Vector&, double, double, const Vector&, const Vector&, double, double, double) {
        return {Vector::Zero(), 0};
    }
    static double ratio() { return 0; }
    static double energy(const Vector&, double) { return 0; }
};

}  // namespace dem
