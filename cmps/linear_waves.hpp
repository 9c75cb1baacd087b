/// Airy waves: what rules, boundary and watch need to know of the waves before a particle has moved.
#pragma once

namespace cmps {

/// Phase speed, m/s, of waves of `period` (s) in `depth` (m).
double phase_speed(double period, double depth, double gravity = 9.81);

/// Height in `depth` over the height in `from`, of waves that lose nothing on their way: by their group
/// speed, or by Green's law where there is no period (0).
double shoaling(double period, double from, double depth);

}  // namespace cmps
