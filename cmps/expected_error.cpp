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
/// lattices: what one run may expect, for a wave's figure scatters by as much as it is.
constexpr std::array<Row, 7> ladder = {{
    {8, {.floor_pressure = 0.0170, .levels = 0.029, .wave_height = 0.122}},
    {12, {.floor_pressure = 0.0127, .levels = 0.026, .wave_height = 0.031}},
    {16, {.floor_pressure = 0.0079, .levels = 0.025, .wave_height = 0.018}},
    {20, {.floor_pressure = 0.0055, .levels = 0.023, .wave_height = 0.0105}},
    {24, {.floor_pressure = 0.0039, .levels = 0.023, .wave_height = 0.0073}},
    {30, {.floor_pressure = 0.0022, .levels = 0.022, .wave_height = 0.0060}},
    {40, {.floor_pressure = 0.0014, .levels = 0.022, .wave_height = 0.0030}},
}};
/// The same with a kernel of 3.1 l0.
constexpr double wide_radius = 3.1;
constexpr std::array<Row, 3> wide_ladder = {{
    {20, {.floor_pressure = 0.0022, .levels = 0.024, .wave_height = 0.0054}},
    {24, {.floor_pressure = 0.0017, .levels = 0.024, .wave_height = 0.0046}},
    {30, {.floor_pressure = 0.0011, .levels = 0.022, .wave_height = 0.0036}},
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
