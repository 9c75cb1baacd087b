#include "boussinesq/effect_rules.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "boussinesq/grid.hpp"
#include "boussinesq/waves/wave_theory.hpp"

namespace boussinesq {
namespace {

double shallowest(const Expectation& expected) {
    double depth = -expected.bed.front()[1];
    for (const auto& point : expected.bed) depth = std::min(depth, -point[1]);
    return depth;
}

/// Height of the incident wave shoaled to another depth; a wave without period follows Green's law.
double incident_height(const Expectation& expected, double depth) {
    double gain;
    if (expected.period > 0) {
        const double w = 2.0 * std::numbers::pi / expected.period;
        gain = std::sqrt(
            airy_group_speed(airy_wave_number(w, expected.generator_depth), expected.generator_depth) /
            airy_group_speed(airy_wave_number(w, depth), depth));
    } else {
        gain = std::pow(expected.generator_depth / depth, 0.25);
    }
    return expected.height * gain;
}

double shoaled_height(const Expectation& expected, double depth) {
    return incident_height(expected, depth) * (expected.reflects ? 2.0 : 1.0);
}

}  // namespace

Shallowest shallowest_place(const Expectation& expected) {
    constexpr double breaking = 0.8;
    double depth = shallowest(expected);
    const bool breaks = depth <= 0 || incident_height(expected, depth) > breaking * depth;
    if (breaks) {
        double low = std::max(depth, 0.0), high = expected.generator_depth;  // breaks at low, not at high
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            (incident_height(expected, middle) > breaking * middle ? low : high) = middle;
        }
        depth = high;
    }
    const double length =
        expected.period > 0
            ? 2.0 * std::numbers::pi / airy_wave_number(2.0 * std::numbers::pi / expected.period, depth)
            : 0.0;
    return {.depth = depth, .height = incident_height(expected, depth), .length = length, .breaks = breaks};
}

Verdict needs_dispersion(const Expectation& expected) {
    if (expected.period <= 0) return {true, "the wave is not periodic: its shape rests on dispersion"};
    double deepest = 0;
    for (const auto& point : expected.bed) deepest = std::max(deepest, -point[1]);
    const double w = 2.0 * std::numbers::pi / expected.shortest_period;
    const double k = airy_wave_number(w, deepest), k_shallow = w / std::sqrt(gravity * deepest);
    const double length = expected.bed.back()[0] - expected.bed.front()[0];
    const double error = (k - k_shallow) * length / (2.0 * std::numbers::pi);
    if (error > expected.phase_tolerance)
        return {true, fmt::format("kh up to {:.2f}: without it the phase would be {:.2g} periods off over "
                                  "the flume, more than {:.2g}",
                                  k * deepest, error, expected.phase_tolerance)};
    // A long wave that dispersion does not hold together steepens by its height: by this share of its own
    // slope.
    const double steepening = 1.5 * expected.height / expected.generator_depth * k * length;
    if (steepening > 0.1)
        return {
            true,
            fmt::format(
                "kh up to {:.2f}, but waves this high would steepen by {:.0f} % over the flume without it",
                k * deepest, 100.0 * steepening)};
    return {false,
            fmt::format(
                "kh up to {:.2f}: without it the phase is {:.2g} periods off over the flume, within {:.2g}",
                k * deepest, error, expected.phase_tolerance)};
}

Verdict needs_breaking(const Expectation& expected) {
    const double lowest = shallowest(expected);
    if (expected.height <= 0) return {false, "no waves"};
    if (!expected.is_dispersive)
        return {false, "without dispersion bores form and lose energy by themselves"};
    if (lowest <= 0)
        return {true, "the bed rises above still water: waves break on the way or at the shoreline"};
    const double ratio = shoaled_height(expected, lowest) / lowest;
    return {ratio >= 0.4,
            fmt::format("largest H/h along the flume {:.2f} {} 0.4{}", ratio, ratio >= 0.4 ? ">=" : "<",
                        ratio >= 0.4 ? "" : ": no breaking expected")};
}

Verdict needs_shoreline(const Expectation& expected) {
    const double lowest = shallowest(expected);
    if (lowest <= 0) return {true, "the bed rises above still water"};
    const double height = shoaled_height(expected, lowest);
    const bool on = lowest < height;
    return {on, fmt::format("least depth {:.3g} m {} wave height {:.3g} m there{}", lowest,
                            on ? "<" : ">=", height, on ? "" : ": the bed stays wet")};
}

Verdict needs_friction(const Expectation& expected) {
    if (expected.friction > 0) return {true, "a coefficient is given"};
    return {false, "no coefficient given"};
}

}  // namespace boussinesq
