/// Pressure gradient: the schemes of the paper and the corrected one.
///
/// With r_ij = r_j - r_i, p^_i the lowest pressure of i and its neighbours, D = 2:
///
///     standard        (1)   D/n0 sum (p_j - p^_i) r_ij w / r^2
///     modified        (4)   D/n0 sum (p_i + p_j - 2 p^_i) r_ij w / r^2
///     antisymmetric   (5)   D/n0 sum (p_i + p_j - p^_i - p^_j) r_ij w / r^2        conserves momentum
///     corrected       GC    C_i D/n0 sum (p_j - p_i) r_ij w / r^2                  exact for a linear p
///     antisymmetric corrected    D/n0 sum (p_i C_i + p_j C_j) r_ij w / r^2         conserves momentum
///
/// C_i = (D/n0 sum r_ij r_ij^T w / r^2)^-1, the identity at walls in the last one (the form of Vila 1999). It
/// keeps (5)'s pairs and carries waves: workflows/studies/cost_cmps.py compares them.
///
/// (5) with local minima gives zero for a linear pressure on a regular lattice; with the lowest pressure of
/// the connected water (zero at a free surface) it is p_i + p_j: it conserves momentum and is consistent on a
/// lattice.
#pragma once

#include <vector>

#include "cmps/interactions.hpp"

namespace cmps {

enum class Gradient {
    standard,
    modified,
    antisymmetric_local,
    antisymmetric_global,
    antisymmetric_corrected,
    corrected
};

/// D/n0 times the moment of a particle's neighbourhood, inverted; the identity where it is too lopsided.
struct Correction {
    double xx, xz, zz;
};
/// Fewer than 4 neighbours, determinant < 0.1 or trace < 0.5: identity.
Correction correction_of(const Interactions& interactions, std::size_t row, double lattice_density);

/// Gradient of the pressure at every fluid particle, Pa/m; arrays run over fluid particles.
class GradientTerm {
 public:
    GradientTerm(Gradient kind, double lattice_density) : kind_(kind), lattice_density_(lattice_density) {}
    void evaluate(const Particles& particles, const NeighbourLists& lists, const Interactions& interactions,
                  std::vector<double>& gradient_x, std::vector<double>& gradient_z);

 private:
    void find_local_minima(const Particles& particles, const NeighbourLists& lists,
                           const Interactions& interactions);
    void correct_pressures(const Particles& particles, const Interactions& interactions);
    void evaluate_corrected_pairs(const Particles& particles, const NeighbourLists& lists,
                                  const Interactions& interactions, std::vector<double>& gradient_x,
                                  std::vector<double>& gradient_z) const;
    Gradient kind_;
    double lattice_density_;
    std::vector<double> minimum_;
    std::vector<double> pressure_xx_, pressure_xz_, pressure_zz_;  // p C, per carrier
};

}  // namespace cmps
