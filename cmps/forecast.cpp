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

/// Height by which the water's centre lies above that of the same water level over the tank or flume, m.
double height_to_fall(const Scene& scene, const Solid& solid, const Particles& particles) {
    double low = 1e300, high = -1e300, centre = 0;
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i) {
        centre += particles.z[i] / static_cast<double>(particles.fluid);
        low = std::min(low, particles.z[i]), high = std::max(high, particles.z[i]);
    }
    const double l0 = scene.settings.spacing, x0 = scene.tank ? (*scene.tank)[0] : scene.offshore,
                 x1 = scene.tank ? (*scene.tank)[1] : scene.onshore;
    double left = static_cast<double>(particles.fluid) * l0 * l0, moment = 0, volume = left;
    for (double z = low; z < high && left > 0; z += l0)  // fill layer by layer
        for (double x = x0 + 0.5 * l0; x < x1 && left > 0; x += l0)
            if (!solid.contains(x, z)) left -= l0 * l0, moment += z * l0 * l0;
    return centre - moment / (volume - left);
}

/// Mean speed of water that falls freely onto the floor of its tank, over sqrt(g h).
double falling_speed(const Scene& scene, const Particles& particles) {
    const double g = std::abs(scene.settings.gravity_z);
    if (!scene.tank || g == 0 || particles.fluid == 0) return 0.0;
    const auto first = particles.z.begin() + static_cast<std::ptrdiff_t>(particles.first_fluid());
    const double way = *std::min_element(first, particles.z.end()) - (*scene.tank)[2];
    const double duration = std::min(scene.time.end, std::sqrt(2.0 * std::max(way, 0.0) / g));
    return 0.5 * g * duration / std::sqrt(g * scene.settings.depth);
}

/// Mean step, s, when water at rest allows `largest` (0.4 l0 / sqrt(g h)). What moves fastest, over sqrt(g
/// h), as met in runs: 0.6 under waves of H/h = 0.2 to 0.4, 1.3 to 1.8 in columns that collapse and in tanks
/// that are shaken, nothing in still water.
double mean_step(const Scene& scene, const Solid& solid, const Particles& particles, double largest) {
    const bool is_still =
        scene.gravity_file.empty() && height_to_fall(scene, solid, particles) < 0.5 * scene.settings.spacing;
    double fastest = scene.drive != Drive::none ? 0.6 : is_still ? 0.0 : 1.45;
    if (!is_still) fastest = std::max(fastest, falling_speed(scene, particles));
    const double gravity_step = 0.4;
    return largest * std::min(1.0, scene.settings.courant / (gravity_step * fastest + 1e-12));
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
    forecast.step = mean_step(scene, solid, field.particles, largest);
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
