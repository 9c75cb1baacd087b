/// Whether water stands still: pools of it, and how far they can fall.
#pragma once

#include "cmps/particles.hpp"

namespace cmps {

/// Largest height (m) by which a connected water's highest surface stands above air that touches the same
/// water: 0 where every pool is level and held on all sides. To one and a half spacings.
double height_to_fall(const Particles& particles, double spacing);

}  // namespace cmps
