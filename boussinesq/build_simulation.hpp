/// From the scene to the simulation: initial water, zones, and only the effects the scene calls for.
#pragma once

#include "boussinesq/scene.hpp"
#include "boussinesq/simulation.hpp"

namespace boussinesq {

/// Throws InputError where the equations carry no such wave.
Simulation build_simulation(const Scene& scene);

}  // namespace boussinesq
