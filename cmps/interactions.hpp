/// Geometry of all pairs at the positions where the pressure is solved: computed once a step, read by every
/// term.
#pragma once

#include <vector>

#include "cmps/kernel.hpp"
#include "cmps/neighbours.hpp"
#include "cmps/particles.hpp"

namespace cmps {

/// Per list entry (i, j): r_ij = r_j - r_i, w, w/r^2 and, where a term asks for it, w'/r. Zero beyond the
/// radius. r_ij is taken in double; it and what follows from it are float (relative 6e-8, antisymmetric in i
/// and j: momentum is conserved as before), for pairs are most of what a step moves through memory. Per row:
/// sums that the terms share.
struct Interactions {
    std::vector<float> dx, dz, weight, weight_over_r2;
    std::vector<float> slope;      ///< w'/r; empty unless asked for
    std::vector<float> curvature;  ///< w'' - w'/r; empty unless asked for

    std::vector<float> largest_weight;                    ///< that of the nearest neighbour
    std::vector<double> number_density;                   ///< n = sum w
    std::vector<double> asymmetry_x, asymmetry_z;         ///< F = sum w r_ij / r, points where neighbours are
    std::vector<double> crowding_x, crowding_z;           ///< sum w r_ij / r^2 over all neighbours, 1/m
    std::vector<double> moment_xx, moment_xz, moment_zz;  ///< sum w r_ij r_ij / r^2 over pressure carriers
};

/// What a step's terms need beside the weights.
struct PairExtras {
    bool slope = false, curvature = false;
};

/// Fills `interactions` from the lists at the particles' present positions.
template <class Kernel>
void compute_interactions(const Kernel& kernel, const Particles& particles, const NeighbourLists& lists,
                          PairExtras extras, Interactions& interactions);

}  // namespace cmps
