#include "cmps/expected_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cmps {
namespace {

struct Row {
    double particles_over_depth;
    ExpectedError error;
};

/// The ladder of workflows/studies/cost_cmps.py as measured with the default schemes: rms over three
/// lattices; a wave's figure scatters by about half of itself.
constexpr std::array<Row, 6> ladder = {{
    {8, {.floor_pressure = 0.0125, .levels = 0.035, .wave_height = 0.029}},
    {12, {.floor_pressure = 0.0120, .levels = 0.028, .wave_height = 0.082}},
    {16, {.floor_pressure = 0.0072, .levels = 0.026, .wave_height = 0.020}},
    {24, {.floor_pressure = 0.0034, .levels = 0.023, .wave_height = 0.0096}},
    {30, {.floor_pressure = 0.0026, .levels = 0.022, .wave_height = 0.0072}},
    {40, {.floor_pressure = 0.0016, .levels = 0.022, .wave_height = 0.0057}},
}};

}  // namespace

ExpectedError expected_error(double particles_over_depth) {
    const double at = std::min(particles_over_depth, ladder.back().particles_over_depth);
    std::size_t k = 1;
    while (k + 1 < ladder.size() && ladder[k].particles_over_depth < at) ++k;
    const Row &a = ladder[k - 1], &b = ladder[k];
    const double share =
        std::log(at / a.particles_over_depth) / std::log(b.particles_over_depth / a.particles_over_depth);
    const auto between = [&](double ExpectedError::*member) {
        return a.error.*member * std::pow(b.error.*member / (a.error.*member), share);
    };
    return {between(&ExpectedError::floor_pressure), between(&ExpectedError::levels),
            between(&ExpectedError::wave_height)};
}

std::string expected_error_text(double particles_over_depth) {
    const ExpectedError error = expected_error(particles_over_depth);
    const double finest = ladder.back().particles_over_depth;
    return fmt::format(
        "as measured at {:.0f}{} particles over the depth: pressure of still water {:.1f} %, levels of a dam "
        "break {:.1f} % of its height, height of a standing wave {:.1f} % a period",
        std::min(particles_over_depth, finest), particles_over_depth > finest ? " (finest measured)" : "",
        100 * error.floor_pressure, 100 * error.levels, 100 * error.wave_height);
}

}  // namespace cmps
