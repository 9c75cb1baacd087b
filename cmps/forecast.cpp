#include "cmps/forecast.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "cmps/near_field.hpp"
#include "cmps/pools.hpp"
#include "cmps/scene_geometry.hpp"
#include "cmps/time_table.hpp"

namespace cmps {
namespace {

constexpr double pi = 3.14159265358979, two_pi = 2 * pi;

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

/// Mean speed of water that falls freely onto the floor of its tank, over sqrt(g h).
double falling_speed(const Scene& scene, const Particles& particles) {
    const double g = std::abs(scene.settings.gravity_z);
    if (!scene.tank || g == 0 || particles.fluid == 0) return 0.0;
    const auto first = particles.z.begin() + static_cast<std::ptrdiff_t>(particles.first_fluid());
    const double way = *std::min_element(first, particles.z.end()) - (*scene.tank)[2];
    const double duration = std::min(scene.time.end, std::sqrt(2.0 * std::max(way, 0.0) / g));
    return 0.5 * g * duration / std::sqrt(g * scene.settings.depth);
}

/// Fastest water over sqrt(g h) as met in runs: 1.3 to 1.8 in columns of depth h that collapse and in tanks
/// that slosh until the water breaks; less, by Torricelli's law, where it falls from a lesser height.
constexpr double of_collapse = 1.45;

double speed_of_fall(const Scene& scene, const Particles& particles) {
    const double drop = height_to_fall(particles, scene.settings.spacing);
    const double share = std::min(1.0, drop / scene.settings.depth);
    return std::max(of_collapse * std::sqrt(share), falling_speed(scene, particles));
}

/// Steps of water that falls from where it stands, or moves with waves or a piston (0.6 sqrt(g h) at H/h =
/// 0.2 to 0.4), when water at rest allows `largest` (0.4 l0 / sqrt(g h)).
double steps_at_speed(const Scene& scene, double fastest, double duration, double largest) {
    const double gravity_step = 0.4;
    return duration / (largest * std::min(1.0, scene.settings.courant / (gravity_step * fastest + 1e-12)));
}

/// Steps in a tank that is shaken: its first mode, without damping, until the water breaks. A slope a/g of
/// the surface at rest is 4 L/pi^2 a/g of the mode cos(pi x/L).
double steps_when_shaken(const Scene& scene, double start, double fall, double largest) {
    const TimeTable gravity(scene.gravity_file, 3);
    const double g = 9.81, h = scene.settings.depth, length = scene.onshore - scene.offshore;
    const double k = pi / length, omega = std::sqrt(g * k * std::tanh(k * h));
    const double step = 0.02 * two_pi / omega;
    const double of_slope = omega * omega * 4.0 * length / (pi * pi) / g;
    double amplitude = 0, rate = 0, steps = 0;
    for (double time = start; time < scene.time.end; time += step) {
        const double part = std::min(step, scene.time.end - time);
        amplitude += 0.5 * part * rate;
        rate += part * (of_slope * gravity.mean(1, time, time + part) - omega * omega * amplitude);
        amplitude += 0.5 * part * rate;
        const double speed = std::hypot(rate, omega * amplitude) / std::tanh(k * h) / std::sqrt(g * h);
        if (speed > of_collapse) amplitude *= of_collapse / speed, rate *= of_collapse / speed;
        steps += steps_at_speed(scene, std::max(fall, std::min(speed, of_collapse)), part, largest);
    }
    return steps;
}

double expected_steps(const Scene& scene, const Particles& particles, double start, double largest) {
    const double duration = std::max(0.0, scene.time.end - start);
    if (scene.drive != Drive::none) return steps_at_speed(scene, 0.6, duration, largest);
    const double fall = speed_of_fall(scene, particles);
    if (!scene.gravity_file.empty()) return steps_when_shaken(scene, start, fall, largest);
    return steps_at_speed(scene, fall, duration, largest);
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
    forecast.steps = expected_steps(scene, field.particles, forecast.start, largest);
    forecast.step =
        forecast.steps > 0 ? std::max(0.0, scene.time.end - forecast.start) / forecast.steps : largest;

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
