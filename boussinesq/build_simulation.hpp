/// From the scene to the simulation: initial water, zones, and only the effects the scene calls for.
#pragma once

#include "boussinesq/scene.hpp"
#include "boussinesq/simulation.hpp"

namespace boussinesq {

/// Throws InputError where the equations carry no such wave.
Simulation build_simulation(const Scene& scene);

/// Switches breaking on in a simulation that goes without.
void add_breaking(Simulation& simulation, const Scene& scene);

/// First cell (padded) in which waves may break: shoreward of where they are made.
std::size_t first_breaking_cell(const Scene& scene);

/// Depth below which a flume without moving shoreline is no longer safely wet, m.
double shoreline_margin(const Scene& scene);

}  // namespace boussinesq
