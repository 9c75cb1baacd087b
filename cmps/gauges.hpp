/// Readings at points: surface elevation, pressure in the water, velocity; volume of water.
#pragma once

#include <array>
#include <vector>

#include "cmps/particles.hpp"
#include "cmps/solid.hpp"

namespace cmps {

/// Height of the water's surface at x, as a wire gauge reads it: bottom plus wetted length, wet being where
/// water fills at least half of what the solid leaves of the kernel. On a face, that of the water before it.
/// The bottom itself where it is dry. m
double surface_elevation(const Particles& particles, const Solid& solid, double spacing, double x);

/// Mean pressure of the water within `diameter`/2 (at least one spacing) of (x, z), Pa; zero where it is dry.
double pressure_in_water(const Particles& particles, double spacing, double x, double z, double diameter);

/// Velocity of the water at (x, z), m/s; zero where there is none.
std::array<double, 2> velocity_at(const Particles& particles, double spacing, double x, double z);

/// Volume of water between x0 and x1 by its surface profile and what the solid leaves above `bottom` (m), m^2
/// per m of width.
double volume_by_surface(const Particles& particles, const Solid& solid, double spacing, double x0, double x1,
                         double bottom);

}  // namespace cmps
