/// Assembly of the pressure equation
///
///     sum_j 4/(lambda n0) w (p_i - p_j) = rho/dt [ -div u*_i + gamma/dt' (n_i - n0)/n0 ]
///
/// as a symmetric matrix A_ij = -c_ij, c_ij = w_ij (or the higher-order coefficient), over the carriers whose
/// pressure is unknown; p = 0 at the surface; dummies are left out (Neumann).
///
/// Sources for div u*:
///     density      none; the density term alone, gamma given            (Koshizuka & Oka 1996)
///     higher_order (1/(n0 S)) sum (-w'/r) r_ij . u*_ij                  (HS, Khayyer & Gotoh 2009; S makes
///     it exact for
///                                                                        a linear velocity on the lattice)
///     corrected    D/n0 sum u*_ij . (C_i r_ij) w / r^2                  exact for a linear velocity anywhere
///     error_compensating  higher_order with |a| Dn/Dt + |Dn/Dt| a, a = (n - n0)/n0, in place of the gamma
///     term
///                  (ECS, Khayyer & Gotoh 2011; Dn/Dt of the predicted velocity)
#pragma once

#include <vector>

#include "cmps/free_surface.hpp"
#include "cmps/interactions.hpp"
#include "cmps/sparse_matrix.hpp"

namespace cmps {

enum class Source { density, higher_order, corrected, error_compensating };
enum class Laplacian { standard, higher_order };

/// How p = 0 at the free surface enters.
enum class SurfaceCondition {
    detected,  ///< p = 0 at particles that are found to lie at the surface: half a spacing below the true one
    smooth     ///< the missing part of the kernel is water of opposite pressure: p = 0 on the surface itself
};

struct PressureEquationSettings {
    Source source = Source::higher_order;
    Laplacian laplacian = Laplacian::standard;
    double density_weight = 0.02;  ///< gamma
    double density = 1000;         ///< rho, kg/m3
    SurfaceCondition surface = SurfaceCondition::smooth;
};

/// Matrix, right-hand side and the place of every unknown.
class PressureEquation {
 public:
    PressureEquation(const PressureEquationSettings& settings, const LatticeConstants& lattice)
        : settings_(settings), lattice_(lattice) {}
    /// What this equation needs of the pairs.
    PairExtras extras() const {
        return {.slope = settings_.source == Source::higher_order ||
                         settings_.source == Source::error_compensating,
                .curvature = settings_.laplacian == Laplacian::higher_order};
    }

    /// `particles` hold the predicted velocity u*. `correction_step`: the step of the density term, s; longer
    /// than `time_step` where that is shorter than the flow asks for, so that the term is a rate.
    void assemble(const Particles& particles, const NeighbourLists& lists, const Interactions& interactions,
                  const std::vector<Place>& place, double time_step, double correction_step);

    SparseMatrix matrix;
    std::vector<double> right_hand_side;
    std::vector<std::int32_t> unknown_of;  ///< per carrier row; -1: p = 0
    std::vector<std::int32_t> row_of;      ///< per unknown
    bool is_closed = false;                ///< no free surface: the pressure is known up to a constant
    std::vector<double> density_error;     ///< (n - n0)/n0 per carrier row

 private:
    double divergence(const Particles& particles, const NeighbourLists& lists,
                      const Interactions& interactions, std::size_t row) const;
    double slip(const Particles& particles, const NeighbourLists& lists, const Interactions& interactions,
                std::size_t row) const;
    /// 0 inside, 1 at the surface, by the asymmetry of the neighbourhood.
    double surface_share(const Interactions& interactions, std::size_t row) const;
    /// What the mirrored water above the surface adds to the diagonal.
    double missing_kernel(const Interactions& interactions, std::size_t row) const;
    PressureEquationSettings settings_;
    LatticeConstants lattice_;
};

}  // namespace cmps
