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
    static double energy(double stiffness, double overlap) {
        return 4.0 / 15.0 * stiffness * overlap * overlap;
    }
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
    Vector dashpot;     ///< its part of the force on the first body, N; the spring is the rest
    double dissipated;  ///< by the spring giving way in this step, J
};

/// Mindlin spring with history, dashpot, and the Coulomb limit.
///
/// The spring's force is stored, not its displacement: a displacement times a stiffness that grows with the
/// overlap would gain energy. When the contact unloads, the force shrinks with the stiffness (Thornton et al.
/// 2013).
struct CoulombFriction {
    double coefficient;
    double stiffness_ratio;  ///< tangential over normal
    double root_of_ratio;
    double half_compliance_ratio;  ///< 1 / (2 stiffness_ratio)

    explicit CoulombFriction(const Material& material)
        : coefficient(material.friction),
          stiffness_ratio(material.stiffness_ratio()),
          root_of_ratio(std::sqrt(stiffness_ratio)),
          half_compliance_ratio(0.5 / stiffness_ratio) {}

    /// `spring`: stored force on the first body (updated); `stiffness_before`: normal stiffness one step ago.
    /// `slip_speed`: velocity of the first body relative to the second, tangential, m/s. `dashpot`: of the
    /// normal direction, kg/s. `twist`: angle by which the two bodies have turned about the normal in this
    /// step, the mean of both: the spring turns with them.
    // Inlined by word: called once, in the innermost loop.
    [[gnu::always_inline]] TangentialForce force(Vector& spring, double stiffness_before, double stiffness,
                                                 const Vector& normal, const Vector& slip_speed,
                                                 double normal_force, double dashpot, double twist,
                                                 double dt) const {
        const double tangential_stiffness = stiffness_ratio * stiffness;
        double dissipated = 0;
        const double before = spring.squaredNorm();
        if (before > 0) {
            // Into the new tangent plane: the step's turn is small, so the length lost is of second order.
            spring -= spring.dot(normal) * normal;
            if (twist != 0) {
                // Sine and cosine of an angle below a hundredth, to the last digit.
                const double square = twist * twist, sine = twist * (1 - square / 6),
                             cosine = 1 - square * (0.5 - square / 24);
                spring = cosine * spring + sine * normal.cross(spring);
            }
            const double inverse = 1 / (stiffness * stiffness_before);
            const double growth = stiffness * stiffness * inverse;
            if (growth < 1) spring *= growth;
            const double per_stiffness = half_compliance_ratio * stiffness_before * inverse;  // 1 / (2 k_t)
            dissipated += (before * growth - spring.squaredNorm()) * per_stiffness;
        }
        spring -= tangential_stiffness * dt * slip_speed;

        const double limit = coefficient * normal_force, limit_squared = limit * limit;
        const double length_squared = spring.squaredNorm();
        if (length_squared > limit_squared) {  // slides: the spring gives way, against the force at the limit
            const double length = std::sqrt(length_squared);
            dissipated += limit * (length - limit) / tangential_stiffness;
            spring *= limit / length;
            return {Vector::Zero(), dissipated};
        }
        // Sticks: as much of the dashpot as the Coulomb circle allows.
        const Vector drag = -root_of_ratio * dashpot * slip_speed;
        double share = 1;
        if ((spring + drag).squaredNorm() > limit_squared) {
            const double square = drag.squaredNorm(), along = spring.dot(drag),
                         room = limit_squared - length_squared;
            share = square > 0 ? (std::sqrt(along * along + square * room) - along) / square : 0.0;
        }
        return {share * drag, dissipated};
    }
    double ratio() const { return stiffness_ratio; }
    double coefficient_or_none() const { return coefficient; }
    double energy(const Vector& spring, double stiffness) const {
        return spring.squaredNorm() / (2 * stiffness_ratio * stiffness);
    }
};

/// mu = 0.
struct Frictionless {
    static TangentialForce force(Vector&, double, double, const Vector&, const Vector&, double, double,
                                 double, double) {
        return {Vector::Zero(), 0};
    }
    static double ratio() { return 0; }
    static double coefficient_or_none() { return 0; }
    static double energy(const Vector&, double) { return 0; }
};

}  // namespace dem
