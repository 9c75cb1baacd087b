/// Readings at points: surface elevation, pressure, velocity, overtopped volume; forces on structures.
#pragma once

#include <array>
#include <vector>

#include "cmps/particles.hpp"
#include "cmps/solid.hpp"

namespace cmps {

/// Height of the water's surface at x, as a wire gauge reads it: bottom plus wetted length, wet being where
/// at least half the kernel is filled by water and solid. The bottom itself where it is dry. m
double surface_elevation(const Particles& particles, const Solid& solid, double spacing, double x);

/// Mean pressure of the wall particles within `diameter`/2 (at least one spacing) of (x, z); of the water
/// where no wall is near. Pa
double pressure_at(const Particles& particles, double spacing, double x, double z, double diameter);

/// Velocity of the water at (x, z), m/s; zero where there is none.
std::array<double, 2> velocity_at(const Particles& particles, double spacing, double x, double z);

/// Force of the water on a body: sum over its wall particles of -p n l0, N per m of width.
std::array<double, 2> force_on(const Particles& particles, double spacing, std::int32_t body);

/// Volume of water between x0 and x1 by its surface profile and what the solid leaves above `bottom` (m), m^2
/// per m of width.
double volume_by_surface(const Particles& particles, const Solid& solid, double spacing, double x0, double x1,
                         double bottom);

}  // namespace cmps
