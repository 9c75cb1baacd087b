#include "cmps/forecast.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "cmps/near_field.hpp"
#include "cmps/scene_geometry.hpp"

namespace cmps {
namespace {

/// Travel time of a long wave from the bed's offshore end to the wall, s.
double travel_time(const Scene& scene) {
    if (scene.bed.empty()) return 0.0;
    constexpr int pieces = 200;
    const double from = scene.bed.front()[0], length = scene.offshore - from;
    double time = 0;
    for (int k = 0; k < pieces; ++k) {
        const double depth = -bottom_level(scene, from + (k + 0.5) / pieces * length);
        if (depth > 0) time += length / pieces / std::sqrt(9.81 * depth);
    }
    return time;
}

/// Mean step, s, when water at rest allows `largest` (0.4 l0 / sqrt(g h)). What moves fastest, over sqrt(g
/// h), as met in runs: 0.6 under waves of H/h = 0.2 to 0.4, 1.8 in columns that collapse, nothing in still
/// water. Steps land on the samples of the flow.
double mean_step(const Scene& scene, double largest) {
    const double fastest = scene.drive != Drive::none ? 0.6 : scene.water.empty() ? 0.0 : 1.8;
    const double gravity_step = 0.4;
    const double limit = largest * std::min(1.0, scene.settings.courant / (gravity_step * fastest + 1e-12));
    if (!scene.has_flow) return limit;
    return scene.flow.interval / std::ceil(scene.flow.interval / limit);
}

}  // namespace

Forecast make_forecast(const Scene& scene, double start) {
    Forecast forecast;
    const bool is_at_arrival = scene.drive == Drive::waves && scene.has_effect("start_at_arrival");
    forecast.start = start >= 0      ? start
                     : scene.start   ? *scene.start
                     : is_at_arrival ? travel_time(scene)
                                     : 0.0;

    const Solid solid = make_solid(scene);
    NearField field(scene.settings, initial_particles(scene, solid, nullptr));
    forecast.fluid = field.particles.fluid, forecast.boundary = field.particles.first_fluid();
    double surface = 0;
    for (const Polygon& polygon : scene.water)
        for (const Point& p : polygon) surface = std::max(surface, p[1]);
    field.settle(10, surface);
    const double largest = field.largest_step();
    forecast.step = mean_step(scene, largest);
    forecast.steps = std::max(0.0, scene.time.end - forecast.start) / forecast.step;

    constexpr int warm_up = 2, timed = 10;  // pairs of steps
    double time = 0, best = 1e300;
    for (int pair = 0; pair < warm_up + timed; ++pair) {
        // as in moving water, lists are built anew now and then; processor time, for others may be at work
        // too
        field.search.invalidate();
        const std::clock_t begun = std::clock();
        for (int k = 0; k < 2; ++k, time += 0.5 * largest) field.advance(time, 0.5 * largest);
        const double seconds = 0.5 * static_cast<double>(std::clock() - begun) / CLOCKS_PER_SEC;
        if (pair >= warm_up) best = std::min(best, seconds);
    }
    constexpr double motion_costs = 1.5;  // moving water needs more iterations and samples than water at rest
    forecast.seconds = forecast.steps * best * motion_costs;
    forecast.memory = 25e6 + 2000.0 * static_cast<double>(field.particles.size());
    return forecast;
}

}  // namespace cmps
