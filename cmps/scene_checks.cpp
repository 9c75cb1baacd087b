#include "cmps/scene_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cmps/narrow_places.hpp"
#include "cmps/scene_geometry.hpp"

namespace cmps {
namespace {

using common::Section;

/// A structure that no water can touch and water outside the walls are mistakes of the scene.
void check_places(const Section& section, const Scene& scene) {
    const double slack = 1e-9;  // m
    for (std::size_t k = 0; k < scene.structure.size(); ++k) {
        const auto [x0, x1, z0, z1] = bounding_box(scene.structure[k]);
        if (scene.tank && (z1 <= (*scene.tank)[2] + slack || z0 >= (*scene.tank)[3] - slack))
            section.problem("structure",
                            fmt::format("polygon {} (z = {:g} to {:g} m) lies outside the tank, z = {:g} to "
                                        "{:g} m",
                                        k + 1, z0, z1, (*scene.tank)[2], (*scene.tank)[3]));
        else if (x1 <= scene.offshore + slack || x0 >= scene.onshore - slack)
            section.problem("structure",
                            fmt::format("polygon {} (x = {:g} to {:g} m) lies outside the near field, x = "
                                        "{:g} to {:g} m",
                                        k + 1, x0, x1, scene.offshore, scene.onshore));
        else if (!scene.tank && z1 <= std::min(bottom_level(scene, x0), bottom_level(scene, x1)) - slack)
            section.problem("structure", fmt::format("polygon {} lies wholly under the bed", k + 1));
    }
    for (std::size_t k = 0; k < scene.water.size(); ++k) {
        const auto [x0, x1, z0, z1] = bounding_box(scene.water[k]);
        const std::string where =
            fmt::format("polygon {} (x = {:g} to {:g}, z = {:g} to {:g} m)", k + 1, x0, x1, z0, z1);
        if (scene.tank && (x0 < (*scene.tank)[0] - slack || x1 > (*scene.tank)[1] + slack ||
                           z0 < (*scene.tank)[2] - slack || z1 > (*scene.tank)[3] + slack))
            section.problem("water", where + " leaves the tank");
        if (!scene.tank && (x0 < scene.offshore - slack || x1 > scene.onshore + slack))
            section.problem("water", fmt::format("{} leaves the near field, x = {:g} to {:g} m", where,
                                                 scene.offshore, scene.onshore));
        else if (scene.drive == Drive::piston && x0 < scene.wall_at_start() - slack)
            section.problem("water", fmt::format("{} stands behind the piston, which starts at x = {:g} m",
                                                 where, scene.wall_at_start()));
        for (std::size_t m = 0; m < k; ++m)
            if (overlap(scene.water[m], scene.water[k]))
                section.problem("water", fmt::format("polygons {} and {} overlap: their water would stand "
                                                     "in one place twice",
                                                     m + 1, k + 1));
    }
}

/// Waves come onto water that stands at z = 0: at the wall it must reach from the bed to there.
void check_water_at_wall(const Section& section, const Scene& scene) {
    if (scene.drive != Drive::waves || scene.water.empty()) return;
    Solid water;
    for (const Polygon& polygon : scene.water) water.add(polygon, 0);
    const double part = 0.5 * scene.settings.spacing, x = scene.offshore + part;
    if (!water.contains(x, bottom_level(scene, x) + part) || !water.contains(x, -part) ||
        water.contains(x, part))
        section.problem("water", fmt::format("at the moving wall, x = {:g} m, it must reach from the bed up "
                                             "to z = 0, where the waves' still water stands",
                                             scene.offshore));
}

/// The moving wall must have its way free.
void check_wall_path(const Section& section, const Scene& scene) {
    if (scene.drive == Drive::none) return;
    const bool is_piston = scene.drive == Drive::piston;
    const double from = scene.offshore + scene.piston.least, to = scene.offshore + scene.piston.most;
    const double room = 4 * scene.settings.spacing;
    for (const Polygon& polygon : scene.structure) {
        const auto [x0, x1, z0, z1] = bounding_box(polygon);
        if (to <= x0 - room || from >= x1) continue;
        section.problem(
            is_piston && scene.offshore <= x0 - room ? "piston_file" : "offshore",
            fmt::format("the moving wall at x = {:g} m stands in the structure (x = {:g} to {:g} m) or less "
                        "than four particles ahead of it",
                        to, x0, x1));
    }
    if (is_piston && to > scene.onshore - room)
        section.problem("piston_file",
                        fmt::format("the piston goes to x = {:g} m, through the shoreward end at {:g} m", to,
                                    scene.onshore));
}

/// What particles of this spacing cannot resolve.
void check_narrow_places(const Section& section, const Scene& scene, const Solid& solid) {
    const double l0 = scene.settings.spacing, top = out_of_reach(scene);
    const auto where = [&](const NarrowPlace& place) {
        return fmt::format("at ({:.4g}, {:.4g}) m", place.at[0], place.at[1]);
    };
    const auto key = [](const NarrowPlace& place) {
        return std::max(place.body, place.opposite) >= 0 ? "structure" : "particle_spacing";
    };
    const auto spacing_that_does = [](double most) {  // rounded down to two digits
        const double digit = std::pow(10.0, std::floor(std::log10(most)) - 1);
        return std::floor(most / digit * (1 + 1e-9)) * digit;
    };
    const double thickness = std::max(least_thickness, scene.settings.kernel_radius_ratio);
    if (const auto place = thinnest_body(solid, thickness * l0, l0, top))
        section.problem(
            key(*place),
            fmt::format(
                "{} it is {:.3g} m thick, thinner than {:g} particles of {:g} m: the pressures of its "
                "two sides would mix; a particle_spacing of {:g} m would do",
                where(*place), place->width, thickness, l0, spacing_that_does(place->width / thickness)));
    if (const auto place = narrowest_gap(solid, l0, top))
        section.problem(
            key(*place),
            fmt::format("{} a gap is {:.3g} m wide, narrower than {:g} particles of {:g} m: close it; a "
                        "particle_spacing of {:g} m would do",
                        where(*place), place->width, least_gap, l0,
                        spacing_that_does(place->width / least_gap)));
}

/// A polygon whose faces all lie in others changes nothing: its force would read zero.
void check_structure_faces(const Section& section, const Scene& scene, const Solid& solid) {
    std::vector<bool> has_face(scene.structure.size(), false);
    for (const SurfaceSegment& segment : solid.surface())
        if (segment.body >= 0) has_face[static_cast<std::size_t>(segment.body)] = true;
    for (std::size_t k = 0; k < scene.structure.size(); ++k) {
        if (has_face[k]) continue;
        std::size_t other = 0;
        while (other < k && scene.structure[other] != scene.structure[k]) ++other;
        section.problem("structure",
                        other < k
                            ? fmt::format("polygons {} and {} are the same: give one", other + 1, k + 1)
                            : fmt::format("polygon {} has no face of its own: it lies within the bed, walls "
                                          "and the other polygons, and changes nothing",
                                          k + 1));
    }
}

/// Gauges in the solid have no water to read. On its face they may stand.
void check_gauges_in_solid(const common::SceneFile& file, const Scene& scene, const Solid& solid) {
    using Kind = common::Gauge::Kind;
    for (const common::Gauge& gauge : scene.gauges) {
        if (gauge.kind != Kind::pressure && gauge.kind != Kind::velocity) continue;
        if (gauge.x < scene.offshore || gauge.x > scene.onshore) continue;  // another stage's
        std::size_t nearest = 0;
        if (!solid.contains(gauge.x, gauge.z)) continue;
        if (solid.distance(gauge.x, gauge.z, nearest) <= 0.1 * scene.settings.spacing) continue;
        file.section("gauges").problem(
            gauge.name, fmt::format("({:g}, {:g}) m lies inside bed, structure or walls", gauge.x, gauge.z));
    }
}

}  // namespace

std::array<double, 4> bounding_box(const Polygon& polygon) {
    std::array<double, 4> box = {1e300, -1e300, 1e300, -1e300};
    for (const Point& p : polygon) {
        box[0] = std::min(box[0], p[0]), box[1] = std::max(box[1], p[0]);
        box[2] = std::min(box[2], p[1]), box[3] = std::max(box[3], p[1]);
    }
    return box;
}

void check_tank_ends(const Section& section, const Scene& scene) {
    if (!scene.tank) return;
    const auto [x0, x1, z0, z1] = *scene.tank;
    if (scene.drive == Drive::waves)
        section.problem("drive", "waves come into a flume, not into a tank: give flume.bed, or a piston");
    if (scene.drive == Drive::none && scene.offshore != x0)
        section.problem("offshore",
                        fmt::format("the tank's wall stands at x = {:g} m: only a piston may stand "
                                    "elsewhere",
                                    x0));
    if (scene.drive == Drive::piston && (scene.offshore < x0 || scene.offshore >= x1))
        section.problem("offshore", fmt::format("lies outside the tank, x = {:g} to {:g} m", x0, x1));
    if (scene.onshore != x1)
        section.problem("onshore", fmt::format("the tank's wall stands at x = {:g} m", x1));
}

void check_reach_of_gauges(const common::SceneFile& file, const Scene& scene) {
    using Kind = common::Gauge::Kind;
    if (scene.offshore >= scene.onshore) return;  // said already
    for (const common::Gauge& gauge : scene.gauges) {
        const bool is_inside = gauge.x >= scene.offshore && gauge.x <= scene.onshore;
        if (!is_inside && (gauge.kind != Kind::surface || scene.drive != Drive::waves))
            file.section("gauges").problem(
                gauge.name, fmt::format("x = {:g} m lies outside the near field, x = {:g} to {:g} m", gauge.x,
                                        scene.offshore, scene.onshore));
        const bool has_level = gauge.kind == Kind::pressure || gauge.kind == Kind::velocity;
        if (is_inside && has_level && scene.tank &&
            (gauge.z < (*scene.tank)[2] || gauge.z > (*scene.tank)[3]))
            file.section("gauges").problem(
                gauge.name, fmt::format("z = {:g} m lies outside the tank, z = {:g} to {:g} m", gauge.z,
                                        (*scene.tank)[2], (*scene.tank)[3]));
    }
}

bool check_distance_from_origin(const Section& section, const Scene& scene) {
    // geometry tells places apart by a nanometre, four units in the last place of numbers of this size
    constexpr double farthest = 1e6;  // m
    const bool is_offshore = std::abs(scene.offshore) > std::abs(scene.onshore);
    const double at = is_offshore ? scene.offshore : scene.onshore;
    if (std::abs(at) <= farthest) return true;
    section.problem(is_offshore ? "offshore" : "onshore",
                    fmt::format("x = {:g} m is too far from the origin, at most {:g} m: put the scene's "
                                "origin nearer",
                                at, farthest));
    return false;
}

void check_water_at_gauges(const common::SceneFile& file, const Scene& scene) {
    using Kind = common::Gauge::Kind;
    if (scene.gauges.empty()) return;
    const Solid solid = make_solid(scene);
    const double l0 = scene.settings.spacing, top = out_of_reach(scene), bottom = lowest_bottom(scene) - l0;
    const bool ends_at_structure = scene.has_effect("overtopping_basin") || scene.crest_is_out_of_reach;
    const double rear = ends_at_structure ? rear_of_structure(scene, solid) : scene.onshore;
    const auto is_solid = [&](double x) {
        return solid.free_intervals(x - 0.01 * l0, bottom, top).empty() &&
               solid.free_intervals(x + 0.01 * l0, bottom, top).empty();
    };
    for (const common::Gauge& gauge : scene.gauges) {
        if (gauge.kind == Kind::overtopping) continue;  // counts what passes, and need not stand in it
        if (gauge.x < scene.offshore || gauge.x > scene.onshore) continue;  // another stage's
        const bool has_level = gauge.kind == Kind::pressure || gauge.kind == Kind::velocity;
        std::string why;
        if (gauge.x > rear + 1e-9)
            why = fmt::format("water behind the structure, whose rear is at x = {:g} m, is {}", rear,
                              scene.crest_is_out_of_reach
                                  ? "out of reach"
                                  : "counted and not simulated (effects.overtopping_basin = \"off\", or "
                                    "cmps.water, would have it there)");
        else if (is_solid(gauge.x))
            why = "bed, structure or walls fill all of it";
        else if (scene.drive == Drive::piston && gauge.x < scene.offshore + scene.piston.least)
            why = fmt::format("it stands behind the piston, which goes back to x = {:g} m only",
                              scene.offshore + scene.piston.least);
        else if (has_level && gauge.z > top)
            why = fmt::format("no water rises above z = {:g} m", top);
        if (!why.empty())
            file.section("gauges").problem(gauge.name,
                                           fmt::format("no water in reach at x = {:g} m: {}", gauge.x, why));
    }
}

void check_geometry(const common::SceneFile& file, const Section& section, const Scene& scene) {
    check_places(section, scene);
    check_water_at_wall(section, scene);
    check_wall_path(section, scene);
    const Solid solid = make_solid(scene);
    check_structure_faces(section, scene, solid);
    check_narrow_places(section, scene, solid);
    check_gauges_in_solid(file, scene, solid);
}

}  // namespace cmps
