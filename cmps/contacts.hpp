/// What holds particles apart where the pressure equation has not: pairs of water, and water at walls.
///
/// Dynamic stabilisation (DS): below 0.9 l0 half the missing distance is made up over the reference step (all
/// of it at walls); the push is capped at 0.1 l0, so that a small adaptive step does not feed it. Collisions:
/// below 0.5 l0 approaching pairs meet with restitution 0.2.
///
/// Walls: water comes no nearer than the finest stagnation flow that particles can show. Within a spacing of
/// the face its speed across is at most the reference speed times its distance over l0; it ends 0.1 l0 from
/// the face. So a tongue's tip, one particle thick, is stopped over l0/u as it is in a continuum, and not
/// within the one step in which it would strike the face. What the wall gives is part of the pressure on it.
#pragma once

#include <vector>

#include "cmps/interactions.hpp"
#include "cmps/neighbours.hpp"
#include "cmps/particles.hpp"
#include "cmps/settings.hpp"

namespace cmps {

class Contacts {
 public:
    /// Distance within which pairs meet, m.
    static double reach(const Settings& settings);

    /// Changes the fluid's velocities. `near_weight`: the kernel's at `reach`. `step`, `reference_step` (that
    /// of the celerity): s. `speed`: the fastest water's or the celerity, m/s.
    void apply(const Settings& settings, Particles& particles, const NeighbourLists& lists,
               const Interactions& interactions, float near_weight, double step, double reference_step,
               double speed);

    /// What each wall particle's piece of face has given in the last step, as a pressure, Pa.
    const std::vector<double>& wall_pressure() const { return wall_pressure_; }

 private:
    std::vector<double> change_u_, change_w_, wall_pressure_;
};

}  // namespace cmps
