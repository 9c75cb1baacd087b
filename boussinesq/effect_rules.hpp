/// Which optional effects a scene calls for: rules that decide "auto", each with its reason in words.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace boussinesq {

/// What is known of the waves and the flume before anything runs.
struct Expectation {
    std::vector<std::array<double, 2>> bed;  ///< polyline, m
    double height = 0;              ///< incident height in the depth of the generator (irregular: largest), m
    double period = 0;              ///< s; 0: not periodic
    double shortest_period = 0;     ///< of the waves that carry energy: of a sea half the peak's, s
    double generator_depth = 0;     ///< m
    bool reflects = false;          ///< a wall at the shoreward end
    double phase_tolerance = 0.02;  ///< error of phase over the flume that is worth a term, in periods
    double friction = 0;
    bool is_dispersive = true;  ///< as decided before breaking is
};

struct Verdict {
    bool is_on;
    std::string reason;
};

/// The incident wave where the bed comes highest, shoaled by linear theory; where waves break, at the depth
/// of which they are 0.8 high.
struct Shallowest {
    double depth, height, length;  ///< m; length 0: not periodic
    bool breaks;                   ///< the bed comes higher still
};
Shallowest shallowest_place(const Expectation& expected);

Verdict needs_dispersion(const Expectation& expected);
/// Shoals the incident wave over the bed by linear theory and looks for H/h above 0.4 (0.8 is the breaking
/// limit; half of it leaves room for what linear theory leaves out).
Verdict needs_breaking(const Expectation& expected);
/// The bed comes nearer to still water than the wave is high.
Verdict needs_shoreline(const Expectation& expected);
Verdict needs_friction(const Expectation& expected);

}  // namespace boussinesq
