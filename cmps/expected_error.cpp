#include "cmps/expected_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace cmps {
namespace {

struct Row {
    double particles_over_depth;
    ExpectedError error;
};

/// The ladder of workflows/studies/cost_cmps.py as measured with the default schemes: rms over five
/// lattices: what one run may expect, for a wave's figure scatters by as much as it is; that of waves over
/// this study and the one before it.
constexpr std::array<Row, 7> ladder = {{
    {8, {.floor_pressure = 0.0177, .levels = 0.027, .wave_height = 0.121}},
    {12, {.floor_pressure = 0.0134, .levels = 0.025, .wave_height = 0.033}},
    {16, {.floor_pressure = 0.0083, .levels = 0.025, .wave_height = 0.0207}},
    {20, {.floor_pressure = 0.0058, .levels = 0.025, .wave_height = 0.0082}},
    {24, {.floor_pressure = 0.0034, .levels = 0.022, .wave_height = 0.0093}},
    {30, {.floor_pressure = 0.0026, .levels = 0.022, .wave_height = 0.0055}},
    {40, {.floor_pressure = 0.0013, .levels = 0.022, .wave_height = 0.0035}},
}};
/// The same with a kernel of 3.1 l0.
constexpr double wide_radius = 3.1;
constexpr std::array<Row, 3> wide_ladder = {{
    {20, {.floor_pressure = 0.0029, .levels = 0.022, .wave_height = 0.0063}},
    {24, {.floor_pressure = 0.0015, .levels = 0.024, .wave_height = 0.0048}},
    {30, {.floor_pressure = 0.0014, .levels = 0.023, .wave_height = 0.0049}},
}};

ExpectedError read_off(std::span<const Row> rows, double particles_over_depth) {
    const double at = std::min(particles_over_depth, rows.back().particles_over_depth);
    std::size_t k = 1;
    while (k + 1 < rows.size() && rows[k].particles_over_depth < at) ++k;
    const Row &a = rows[k - 1], &b = rows[k];
    const double share =
        std::log(at / a.particles_over_depth) / std::log(b.particles_over_depth / a.particles_over_depth);
    const auto between = [&](double ExpectedError::*member) {
        return a.error.*member * std::pow(b.error.*member / (a.error.*member), share);
    };
    return {between(&ExpectedError::floor_pressure), between(&ExpectedError::levels),
            between(&ExpectedError::wave_height)};
}

}  // namespace

std::string expected_error_text(double particles_over_depth, double kernel_radius) {
    const std::span<const Row> rows =
        kernel_radius < wide_radius ? std::span<const Row>(ladder) : std::span<const Row>(wide_ladder);
    const ExpectedError error = read_off(rows, particles_over_depth);
    const double finest = rows.back().particles_over_depth;
    return fmt::format(
        "as measured at {:.0f}{} particles over the depth: pressure of still water {:.1f} %, levels of a dam "
        "break {:.1f} % of its height, height of a standing wave {:.1f} % a period",
        std::min(particles_over_depth, finest), particles_over_depth > finest ? " (finest measured)" : "",
        100 * error.floor_pressure, 100 * error.levels, 100 * error.wave_height);
}

}  // namespace cmps
