#include "cmps/scene_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "cmps/initial_state.hpp"

namespace cmps {
namespace {

/// Four columns of wall that start on the bed, their face at x.
void add_moving_wall(const Scene& scene, std::vector<BoundaryParticle>& placed) {
    const double l0 = scene.settings.spacing;
    const double top = 0.75 * scene.settings.depth;  // above the highest crest before waves break
    for (int layer = 0; layer < 4; ++layer) {
        const double x = scene.offshore - (layer + 0.5) * l0;
        for (double z = bottom_level(scene, x) + 0.5 * l0; z < top; z += l0)
            placed.push_back(
                {.x = x, .z = z, .normal = {1, 0}, .body = body_moving_wall, .carries_pressure = layer == 0});
    }
}

}  // namespace

double bottom_level(const Scene& scene, double x) {
    return scene.tank ? (*scene.tank)[2] : common::bed_level(scene.bed, x);
}

Solid make_solid(const Scene& scene) {
    const double thick = 6.0 * scene.settings.spacing;  // more than the four layers behind a face
    Solid solid;
    double x0 = scene.offshore - 3.0, x1 = scene.onshore, low = 0, high = 1e3;
    if (scene.tank) {
        const auto [a, b, c, d] = *scene.tank;
        x0 = a, x1 = b, low = c, high = d;
        solid.add({{a - thick, c - thick}, {b + thick, c - thick}, {b + thick, c}, {a - thick, c}}, body_bed);
        solid.add({{a - thick, d}, {b + thick, d}, {b + thick, d + thick}, {a - thick, d + thick}},
                  body_end_wall);
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
        solid.add({{x1, low - thick}, {x1 + thick, low - thick}, {x1 + thick, 3.0 - low}, {x1, 3.0 - low}},
                  body_end_wall);
        if (scene.drive == Drive::none) {
            const double x = scene.offshore;
            x0 = x;
            solid.add({{x - thick, low - thick}, {x, low - thick}, {x, 3.0 - low}, {x - thick, 3.0 - low}},
                      body_end_wall);
        }
        low -= thick, high = 2.5 - low;
    }
    for (std::size_t k = 0; k < scene.structure.size(); ++k)
        solid.add(scene.structure[k], static_cast<std::int32_t>(k));
    solid.find_surface({x0, low}, {x1, high});
    return solid;
}

double end_of_water(const Scene& scene, const Solid& solid) {
    for (double x = scene.offshore; x < scene.onshore; x += 0.25 * scene.settings.spacing)
        if (solid.contains(x, 0.0)) return x;
    return scene.onshore;
}

double rear_of_structure(const Scene& scene) {
    double rear = scene.onshore;
    for (const Polygon& polygon : scene.structure) {
        double x1 = -1e300, z1 = -1e300;
        for (const Point& p : polygon) x1 = std::max(x1, p[0]), z1 = std::max(z1, p[1]);
        if (z1 > 0) rear = x1;
    }
    return rear;
}

double lowest_bottom(const Scene& scene) {
    if (scene.tank) return (*scene.tank)[2];
    double lowest = 0;
    for (const Point& p : scene.bed) lowest = std::min(lowest, p[1]);
    return lowest;
}

Particles initial_particles(const Scene& scene, const Solid& solid, const WaveField* waves) {
    const double l0 = scene.settings.spacing, margin = 6 * l0;
    const double x0 = scene.offshore - (scene.drive == Drive::none ? margin : 1.0);
    double top = 1e3;
    if (!scene.tank) {  // walls no water can reach are not needed
        top = 2.0 * scene.settings.depth;
        for (const Polygon& polygon : scene.water)
            for (const Point& p : polygon) top = std::max(top, p[1] + 2.0 * scene.settings.depth);
    }
    const bool has_basin = scene.has_effect("overtopping_basin");
    const double x1 = has_basin ? rear_of_structure(scene) + margin : scene.onshore + margin;
    auto placed = place_boundary(solid, l0, x0, x1, top);
    if (scene.drive != Drive::none) add_moving_wall(scene, placed);
    Particles particles = make_boundary(placed);
    if (!scene.water.empty()) {
        fill_polygons(solid, l0, scene.water, scene.water_velocity, particles);
        return particles;
    }
    fill_water(
        solid, l0, scene.offshore, end_of_water(scene, solid), lowest_bottom(scene) - l0,
        [&](double x) { return waves ? waves->surface_elevation(x) : 0.0; }, particles);
    if (waves)
        for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
            waves->velocity(particles.x[i], particles.z[i], particles.u[i], particles.w[i]);
    return particles;
}

}  // namespace cmps
