/// Finds waves that break: water at a crest as fast as the crest itself.
///
/// A wave breaks once the water at its crest moves at more than 0.85 of the crest's celerity, in any depth
/// (Barthelemy et al. 2018; Derakhti et al. 2020); below it waves stay whole. Columns of two spacings are
/// read from the ground up; thin water (swash, a tongue on dry ground) has no crests.
#pragma once

#include <cstddef>
#include <vector>

#include "cmps/particles.hpp"

namespace cmps {

struct Crest {
    double speed_over_celerity = 0, x = 0;  ///< -, m
};

class CrestSpeed {
 public:
    /// `still_level`: of the water's surface before waves came, m; `period`: of the waves, s, 0: long;
    /// `gravity`: m/s2.
    CrestSpeed(double spacing, double still_level, double period, double gravity = 9.81)
        : spacing_(spacing), still_level_(still_level), period_(period), gravity_(gravity) {}
    /// The crest between x0 and x1 (m) whose water comes nearest to outrunning it.
    Crest fastest(const Particles& particles, double x0, double x1);

 private:
    struct Cell {
        int count = 0;
        double u = 0, w = 0, lowest = 1e300, highest = -1e300;
    };
    double spacing_, still_level_, period_, gravity_;
    std::vector<Cell> cells_;  // by column, from the lowest water up
};

}  // namespace cmps
