#include "cmps/scene_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "cmps/initial_state.hpp"
#include "cmps/narrow_places.hpp"

namespace cmps {
namespace {

/// How far water runs up a wall that moves as fast as this scene's, m: waves before they break, or the bore
/// ahead of a piston (v sqrt(h/g)) and the jet up its face (v2/2g).
double run_up(const Scene& scene) {
    const double g = 9.81, h = scene.settings.depth, v = scene.piston.fastest;
    return std::max(0.75 * h, v * std::sqrt(h / g) + 0.5 * v * v / g);
}

/// How far behind cmps.offshore the moving wall may go, m.
double farthest_retreat(const Scene& scene) {
    if (scene.drive == Drive::none) return 0.0;
    // a breaking wave moves water by half a depth (H / 2 kh, kh = 0.8), the longest before eq. (6)'s wall is
    // brought back by two and a half
    const double of_waves = 2.5 * scene.settings.depth;
    return scene.drive == Drive::waves ? of_waves : std::max(0.0, -scene.piston.least);
}

/// How much deeper than where it starts the bed lies where the moving wall may go, m.
double fall_of_bed(const Scene& scene) {
    const double start = scene.wall_at_start(), from = scene.offshore - farthest_retreat(scene);
    const double to = scene.offshore + (scene.drive == Drive::waves ? farthest_retreat(scene)
                                                                    : std::max(0.0, scene.piston.most));
    double lowest =
        std::min({bottom_level(scene, start), bottom_level(scene, from), bottom_level(scene, to)});
    for (const Point& p : scene.bed)
        if (p[0] > from && p[0] < to) lowest = std::min(lowest, p[1]);
    return bottom_level(scene, start) - lowest;
}

/// Four columns of wall that start on the bed, their face at wall_at_start(); high enough where it sinks with
/// the ground.
void add_moving_wall(const Scene& scene, std::vector<BoundaryParticle>& placed) {
    const double l0 = scene.settings.spacing;
    double top = highest_water(scene) + run_up(scene) + fall_of_bed(scene);
    if (scene.tank) top = std::min(top, (*scene.tank)[3]);
    for (int layer = 0; layer < 4; ++layer) {
        const double x = scene.wall_at_start() - (layer + 0.5) * l0;
        for (double z = bottom_level(scene, x) + 0.5 * l0; z < top; z += l0)
            placed.push_back(
                {.x = x, .z = z, .normal = {1, 0}, .body = body_moving_wall, .carries_pressure = layer == 0});
    }
}

/// No water between bed and z = 0 at x.
bool is_blocked(const Scene& scene, const Solid& solid, double x) {
    double open = 0;
    for (const auto& [low, high] :
         solid.free_intervals(x, lowest_bottom(scene) - scene.settings.spacing, 0.0))
        open += high - low;
    return open < closed_gap * scene.settings.spacing;
}

/// Where the water of the start stands at x, intervals [z0, z1].
std::vector<std::array<double, 2>> still_water_at(const Scene& scene, const Solid& solid,
                                                  const WaveField* waves, double x) {
    return solid.free_intervals(x, lowest_bottom(scene) - scene.settings.spacing,
                                waves ? waves->surface_elevation(x) : 0.0);
}

}  // namespace

double bottom_level(const Scene& scene, double x) {
    return scene.tank ? (*scene.tank)[2] : common::bed_level(scene.bed, x);
}

Solid make_solid(const Scene& scene) {
    const double thick = 6.0 * scene.settings.spacing;  // more than the four layers behind a face
    Solid solid;
    // bed below the wall wherever it goes; three times the way of one that waves move
    const double behind = std::max(7.5 * scene.settings.depth, farthest_retreat(scene) + 2 * thick);
    double x0 = scene.offshore - behind, x1 = scene.onshore, low = 0, high = 0;
    if (scene.tank) {
        const auto [a, b, c, d] = *scene.tank;
        const bool has_piston = scene.drive == Drive::piston;  // in place of the offshore wall
        const double left = has_piston ? x0 - thick : a - thick;
        x0 = has_piston ? x0 : a, x1 = b, low = c, high = d;
        solid.add({{left, c - thick}, {b + thick, c - thick}, {b + thick, c}, {left, c}}, body_bed);
        solid.add({{left, d}, {b + thick, d}, {b + thick, d + thick}, {left, d + thick}}, body_end_wall);
        if (!has_piston)
            solid.add({{a - thick, c - thick}, {a, c - thick}, {a, d + thick}, {a - thick, d + thick}},
                      body_end_wall);
        solid.add({{b, c - thick}, {b + thick, c - thick}, {b + thick, d + thick}, {b, d + thick}},
                  body_end_wall);
    } else {
        Polygon bed(scene.bed.begin(), scene.bed.end());
        for (const Point& p : bed) low = std::min(low, p[1]);
        bed.insert(bed.begin(), {std::min(x0, bed.front()[0]) - thick, bed.front()[1]});
        bed.push_back({std::max(x1, bed.back()[0]) + 2 * thick, bed.back()[1]});
        bed.push_back({bed.back()[0], low - 2 * thick});
        bed.push_back({bed.front()[0], low - 2 * thick});
        solid.add(bed, body_bed);
        // faces end above all that out_of_reach() lets water touch, walls above their faces
        const double face_top = highest_water(scene) + 6.25 * scene.settings.depth + thick - low,
                     end_top = face_top + 1.25 * scene.settings.depth;
        solid.add({{x1, low - thick}, {x1 + thick, low - thick}, {x1 + thick, end_top}, {x1, end_top}},
                  body_end_wall);
        if (scene.drive == Drive::none) {
            const double x = scene.offshore;
            x0 = x;
            solid.add({{x - thick, low - thick}, {x, low - thick}, {x, end_top}, {x - thick, end_top}},
                      body_end_wall);
        }
        low -= thick, high = face_top;
    }
    for (std::size_t k = 0; k < scene.structure.size(); ++k)
        solid.add(scene.structure[k], static_cast<std::int32_t>(k));
    solid.find_surface({x0, low}, {x1, high});
    return solid;
}

double highest_water(const Scene& scene) {
    double level = scene.water.empty() ? 0.0 : -1e300;
    for (const Polygon& polygon : scene.water)
        for (const Point& p : polygon) level = std::max(level, p[1]);
    return level;
}

double out_of_reach(const Scene& scene) {
    if (scene.tank) return (*scene.tank)[3] + 6.0 * scene.settings.spacing;  // its lid is four layers thick
    return highest_water(scene) + 2.0 * scene.settings.depth;
}

double end_of_water(const Scene& scene, const Solid& solid) {
    const double step = 0.25 * scene.settings.spacing;
    for (double x = scene.wall_at_start(); x < scene.onshore; x += step) {
        if (!is_blocked(scene, solid, x)) continue;
        double open = std::max(x - step, scene.wall_at_start()), blocked = x;
        for (int i = 0; i < 40; ++i) {
            const double middle = 0.5 * (open + blocked);
            (is_blocked(scene, solid, middle) ? blocked : open) = middle;
        }
        return blocked;
    }
    return scene.onshore;
}

std::vector<std::size_t> barriers(const Scene& scene, const Solid& solid) {
    std::vector<std::size_t> found;
    for (std::size_t k = 0; k < scene.structure.size(); ++k) {
        double x0 = 1e300, x1 = -1e300, z1 = -1e300;
        for (const Point& p : scene.structure[k])
            x0 = std::min(x0, p[0]), x1 = std::max(x1, p[0]), z1 = std::max(z1, p[1]);
        const int places = static_cast<int>(std::ceil((x1 - x0) / (0.25 * scene.settings.spacing)));
        bool is_barrier = false;
        for (int i = 0; i < places && !is_barrier && z1 > 0; ++i)
            is_barrier = is_blocked(scene, solid, x0 + (i + 0.5) / places * (x1 - x0));
        if (is_barrier) found.push_back(k);
    }
    return found;
}

double rear_of_structure(const Scene& scene, const Solid& solid) {
    double rear = -1e300;
    for (const std::size_t k : barriers(scene, solid))
        for (const Point& p : scene.structure[k]) rear = std::max(rear, p[0]);
    return rear > -1e300 ? std::min(rear, scene.onshore) : scene.onshore;
}

double lowest_bottom(const Scene& scene) {
    if (scene.tank) return (*scene.tank)[2];
    double lowest = 0;
    for (const Point& p : scene.bed) lowest = std::min(lowest, p[1]);
    return lowest;
}

double initial_area(const Scene& scene, const Solid& solid, const WaveField* waves) {
    const double l0 = scene.settings.spacing;
    if (!scene.water.empty()) {
        double area = 0;
        for (const Polygon& polygon : scene.water) area += free_area(solid, l0, polygon);
        return area;
    }
    return free_area(solid, l0, scene.wall_at_start(), end_of_water(scene, solid),
                     [&](double x) { return still_water_at(scene, solid, waves, x); });
}

Particles initial_particles(const Scene& scene, const Solid& solid, const WaveField* waves) {
    const double l0 = scene.settings.spacing, margin = 6 * l0;
    const double x0 = scene.offshore - (scene.drive == Drive::waves ? 0.0 : margin) - farthest_retreat(scene);
    const bool has_basin = scene.has_effect("overtopping_basin");
    const double x1 = (has_basin ? rear_of_structure(scene, solid) : scene.onshore) + margin;
    auto placed = place_boundary(solid, l0, x0, x1, out_of_reach(scene));
    if (scene.drive != Drive::none) add_moving_wall(scene, placed);
    Particles particles = make_boundary(placed);
    if (!scene.water.empty()) {
        fill_polygons(solid, l0, scene.water, scene.water_velocity, particles);
        return particles;
    }
    fill_water(
        solid, l0, scene.wall_at_start(), end_of_water(scene, solid),
        [&](double x) { return still_water_at(scene, solid, waves, x); }, particles);
    if (waves)
        for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
            waves->velocity(particles.x[i], particles.z[i], particles.u[i], particles.w[i]);
    return particles;
}

}  // namespace cmps
