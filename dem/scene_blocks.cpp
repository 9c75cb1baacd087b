/// Shapes, placed blocks, mound and walls out of a scene.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "common/errors.hpp"
#include "dem/placement.hpp"
#include "dem/scene.hpp"

namespace dem {

using common::Range;
using common::SceneFile;
using common::Section;

namespace {

std::vector<Vector> vectors(const std::vector<std::vector<double>>& rows) {
    std::vector<Vector> result;
    for (const auto& row : rows) result.emplace_back(row[0], row[1], row[2]);
    return result;
}

/// Shapes in use, made once each.
class ShapeBook {
 public:
    ShapeBook(const SceneFile& file, Scene& scene) : file_(file), scene_(scene) {}

    /// Index of the shape `section.shape` names, as it displaces water there.
    int read(const Section& section) {
        const std::string name =
            section.text("shape", "built-in shape or TOML file with [dem.shape]", std::string("beehive96"));
        const double displaced =
            section.number("displaced_volume", "m3", "water displaced by one block; 0: by its elements",
                           Range::not_negative(), 0.0);
        if (const auto known = index_.find({name, displaced}); known != index_.end()) return known->second;
        try {
            const ShapeDescription description = find_shape(name, file_.path().parent_path());
            scene_.placed.shapes.push_back(make_shape(description, scene_.element, scene_.water.density));
        } catch (const std::exception& error) {
            // A line of its own for every mistake of another file would not say whose they are.
            const std::string message = error.what();
            const auto lines = std::count(message.begin(), message.end(), '\n');
            section.problem("shape", lines == 0 ? message
                                                : fmt::format("{} (and {} more)",
                                                              message.substr(0, message.find('\n')), lines));
            // A stand-in, so that the rest of the scene is read and its mistakes are told as well.
            scene_.placed.shapes.push_back(
                make_shape(find_shape("beehive96", "."), scene_.element, scene_.water.density));
        }
        if (displaced > 0) {
            Shape& shape = scene_.placed.shapes.back();
            shape.displaced_volume = displaced;
            shape.volume_per_sphere = displaced / static_cast<double>(shape.spheres.size());
        }
        return index_[{name, displaced}] = static_cast<int>(scene_.placed.shapes.size()) - 1;
    }

 private:
    const SceneFile& file_;
    Scene& scene_;
    std::map<std::pair<std::string, double>, int> index_;
};

void judge_speeds(const Section& entry, const Scene& scene, int shape, bool fixed, const Vector& velocity,
                  const Vector& spin) {
    const Shape& form = scene.placed.shapes[static_cast<std::size_t>(shape)];
    const auto judge = [&](const char* key, double speed) {
        if (fixed && speed > 0) entry.problem(key, "a fixed block does not move");
        if (speed * scene.step.time_step > 0.5 * form.diameter)
            entry.problem(key, fmt::format("{:.3g} m in a step of {:.2g} s is more than the radius of the "
                                           "block's spheres: contacts would be "
                                           "missed; shorten dem.time_step",
                                           speed * scene.step.time_step, scene.step.time_step));
    };
    judge("velocity", velocity.norm());
    judge("angular_velocity", spin.norm() * form.radius);
}

void read_single_blocks(const Section& dem, ShapeBook& book, Scene& scene) {
    for (const Section& entry : dem.tables("block")) {
        const int shape = book.read(entry);
        const auto position = entry.numbers("position", "m", "centre of mass", 3, Range::any());
        const auto turn = entry.numbers("orientation", "-", "quaternion w, x, y, z", 4, Range::any(),
                                        std::vector<double>{1, 0, 0, 0});
        const auto velocity =
            entry.numbers("velocity", "m/s", "at the start", 3, Range::any(), std::vector<double>{0, 0, 0});
        const auto spin = entry.numbers("angular_velocity", "rad/s", "at the start, world axes", 3,
                                        Range::any(), std::vector<double>{0, 0, 0});
        const bool fixed = entry.boolean("fixed", "never moves", false);
        Quaternion orientation(turn[0], turn[1], turn[2], turn[3]);
        if (orientation.norm() < 1e-6) {
            entry.problem("orientation", "expected a quaternion other than zero");
            orientation.setIdentity();  // a stand-in, so that blocks keep their numbers
        }
        judge_speeds(entry, scene, shape, fixed, Vector(velocity[0], velocity[1], velocity[2]),
                     Vector(spin[0], spin[1], spin[2]));
        const Quaternion body =
            orientation.normalized() *
            scene.placed.shapes[static_cast<std::size_t>(shape)].body_from_file.conjugate();
        scene.placed.add(shape, Vector(position[0], position[1], position[2]), body, fixed,
                         Vector(velocity[0], velocity[1], velocity[2]), Vector(spin[0], spin[1], spin[2]));
    }
}

void read_walls(const Section& dem, Scene& scene) {
    std::vector<Section> leaning;
    for (const Section& entry : dem.tables("planes")) {
        const auto point = entry.numbers("point", "m", "a point of the plane", 3, Range::any());
        const auto normal = entry.numbers("normal", "-", "towards the blocks", 3, Range::any());
        const Vector direction(normal[0], normal[1], normal[2]);
        if (direction.norm() < 1e-12) {
            entry.problem("normal", "expected a vector other than zero");
            continue;
        }
        scene.surroundings.planes.push_back({Vector(point[0], point[1], point[2]), direction.normalized()});
        if (direction.y() != 0) leaning.push_back(entry);
    }
    scene.width = dem.number("width", "m", "of the armour along the breakwater; 0: unbounded",
                             Range::not_negative(), 0.0);
    const std::string sides = dem.choice("sides", "what bounds the width", {"walls", "periodic", "open"},
                                         scene.width > 0 ? "walls" : "open");
    if (sides != "open" && scene.width <= 0) dem.problem("sides", "needs dem.width");
    if (sides == "walls" && scene.width > 0) {
        scene.surroundings.planes.push_back({Vector(0, 0, 0), Vector(0, 1, 0)});
        scene.surroundings.planes.push_back({Vector(0, scene.width, 0), Vector(0, -1, 0)});
    }
    if (sides != "periodic") return;
    scene.surroundings.period = scene.width;
    for (const Section& entry : leaning)
        entry.problem("normal", "periodic sides need planes that do not face along y");
}

/// The mean mound and its rough columns; empty with mound = "none".
MoundDescription read_mound(const Section& dem, const Scene& scene, double block_height,
                            std::vector<Vector>& spheres) {
    MoundDescription mound;
    if (!dem.has("mound") || dem.is_text("mound")) {
        dem.choice("mound", "table with profile, roughness, seed", {"none"}, "none");
        return mound;
    }
    const Section section = dem.table("mound");
    mound.profile = section.points("profile", "m", "mean surface [[x, z], ...], x increasing");
    mound.roughness = section.number(
        "roughness", "m", "standard deviation of the columns' heights; default a third of the block height",
        Range::not_negative(), block_height / 3);
    mound.patch =
        section.number("patch", "m", "side of the patches of columns that share a height; 0: each its own",
                       Range::not_negative(), 0.0);
    mound.seed = static_cast<std::uint64_t>(
        // The generator takes 32 bits: beyond, seeds would repeat.
        section.integer("seed", "of the random heights", Range::between(0, 4294967295.0), 1));
    const auto y = section.numbers("y", "m", "extent along the breakwater", 2, Range::any(),
                                   std::vector<double>{0, scene.width > 0 ? scene.width : 1.0});
    mound.least_depth =
        section.number("least_depth", "m", "columns reach at least so far down", Range::not_negative(), 0.0);
    mound.y_begin = y[0];
    mound.y_end = y[1];
    mound.diameter = scene.element.diameter;
    mound.is_periodic = scene.surroundings.period > 0;
    // A rounding of the user's own numbers is far below, a column of the mound far above.
    if (mound.is_periodic && std::abs(y[1] - y[0] - scene.width) > 1e-6 * scene.width) {
        section.problem("y",
                        fmt::format("periodic sides need a mound as wide as dem.width, {} m", scene.width));
        mound.profile.clear();
        return mound;
    }
    bool good = mound.profile.size() >= 2 && y[1] > y[0];
    for (std::size_t i = 1; i < mound.profile.size(); ++i)
        good = good && mound.profile[i][0] > mound.profile[i - 1][0];
    if (!good) {
        section.problem("profile",
                        "expected at least two points with x increasing, and y = [from, to] with to > from");
        mound.profile.clear();
        return mound;
    }
    const double d = mound.diameter;
    double drop = 0;  // of the profile, which columns at its steps are filled down
    for (std::size_t i = 1; i < mound.profile.size(); ++i)
        drop += std::abs(mound.profile[i][1] - mound.profile[i - 1][1]);
    // The lowest of nine columns lies 1.5 standard deviations under the mean of all.
    const double needed = (y[1] - y[0]) / d *
                          (drop / d + (mound.profile.back()[0] - mound.profile.front()[0]) / d *
                                          (1 + (1.5 * mound.roughness + mound.least_depth) / d));
    constexpr double most = 2e7;
    if (needed > most) {
        section.problem(
            "profile",
            fmt::format("with its roughness and depth the mound would need {:.2g} spheres; at most {:.0g}",
                        needed, most));
        mound.profile.clear();
        return mound;
    }
    spheres = build_mound(mound);
    return mound;
}

/// Row by row from the shore, row 1 at `origin`, each row a pitch further offshore, columns towards larger y.
int read_armour(const Section& dem, ShapeBook& book, Scene& scene) {
    const Section blocks = dem.table("blocks");
    const int shape = book.read(blocks);
    scene.rows =
        static_cast<std::size_t>(blocks.integer("rows", "across the breakwater", Range::between(1, 10000)));
    scene.columns =
        static_cast<std::size_t>(blocks.integer("columns", "along the breakwater", Range::between(1, 10000)));
    return shape;
}

void place_armour(const Section& dem, Scene& scene, int shape, const FixedSpheres& mound) {
    const Section blocks = dem.table("blocks");
    const Shape& form = scene.placed.shapes[static_cast<std::size_t>(shape)];
    const auto origin = blocks.numbers("origin", "m", "x, y of block 1", 2, Range::any());
    const auto pitch = blocks.numbers("pitch", "m", "across and along", 2, Range::positive(),
                                      std::vector<double>{1.05 * form.length, 1.05 * form.length});
    const auto behind =
        blocks.integer("fixed_rows", "fixed rows between row 1 and the shore", Range::between(0, 100), 0);
    const bool has_level = blocks.has("level");
    const double level =
        has_level ? blocks.number("level", "m", "height of all centres; default: just above the mound",
                                  Range::any(), 0.0)
                  : 0;
    const auto layers =
        static_cast<std::size_t>(blocks.integer("layers", "on top of each other", Range::between(1, 100), 1));
    const double count = static_cast<double>(scene.rows + static_cast<std::size_t>(behind)) *
                         static_cast<double>(scene.columns * layers);
    constexpr double most = 1e6;
    if (count > most) {
        blocks.problem("rows", fmt::format("{:.2g} blocks; at most {:.0g}", count, most));
        scene.rows = scene.columns = 0;  // none are placed
        return;
    }
    if (!has_level && !dem.is_table("mound"))
        blocks.problem("level", "required where there is no mound: height of the blocks' centres");
    const ArmourPlan plan{.shape = shape,
                          .rows = scene.rows,
                          .columns = scene.columns,
                          .layers = layers,
                          .fixed_rows = static_cast<std::size_t>(behind),
                          .origin_x = origin[0],
                          .origin_y = origin[1],
                          .pitch_across = pitch[0],
                          .pitch_along = pitch[1],
                          .level = has_level ? std::optional<double>(level) : std::nullopt};
    place_blocks(scene.placed, plan, mound);
}

/// Notes mistakes about placed blocks where the scene speaks of them: at the `[[dem.block]]` table of a
/// single block, else at a key of `[dem.blocks]`.
class PlacementJudge {
 public:
    PlacementJudge(const Section& dem, const Scene& scene, const FixedSpheres& mound,
                   std::size_t placed_singly)
        : dem_(dem), scene_(scene), mound_(mound), placed_singly_(placed_singly) {}

    /// Stops at the first kind of mistake: blocks that the mound lets through, a block beside the mound,
    /// inside it, or in another.
    void judge() const {
        if (!are_held_by_the_mound() || !stand_over_the_mound() || !stand_above_the_mound()) return;
        const double allowed = scene_.step.element_overlap_allowed * scene_.element.diameter;
        if (!stand_outside_each_other(allowed) || !stand_near_the_origin()) return;
        const auto clash = deepest_overlap(scene_.placed, scene_.surroundings);
        if (clash.depth > allowed)
            problem(clash.block, "origin",
                    fmt::format("block {} starts {:.2g} m deep in {}; at most {:.2g} m", clash.block + 1,
                                clash.depth, clash.partner, allowed));
    }

 private:
    void problem(std::size_t block, const char* key_of_armour, const std::string& message,
                 const char* key_of_single = "position") const {
        const auto tables = dem_.tables("block");
        if (block >= placed_singly_ && block - placed_singly_ < tables.size())
            tables[block - placed_singly_].problem(key_of_single, message);
        else
            dem_.table("blocks").problem(key_of_armour, message);
    }

    /// Columns stand d apart: between four of them is room for spheres of 0.41 d.
    bool are_held_by_the_mound() const {
        const double gap = (std::sqrt(2.0) - 1) * scene_.element.diameter;
        for (std::size_t i = 0; i < scene_.placed.size() && !scene_.mound.empty(); ++i) {
            const double diameter = scene_.placed.shape_of(i).diameter;
            if (scene_.placed.is_fixed[i] || diameter > gap) continue;
            problem(
                i, "shape",
                fmt::format("spheres of {:.2g} m fall through the mound, between whose columns are {:.2g} m",
                            diameter, gap),
                "shape");
            return false;
        }
        return true;
    }

    /// A block at rest with no mound and no floor under it would fall for ever.
    bool stand_over_the_mound() const {
        if (scene_.mound.empty() || scene_.gravity.norm() == 0) return true;
        for (const auto& plane : scene_.surroundings.planes)
            if (plane.normal.dot(scene_.gravity) < -0.1 * scene_.gravity.norm()) return true;
        for (std::size_t i = 0; i < scene_.placed.size(); ++i) {
            const Vector& p = scene_.placed.position[i];
            if (scene_.placed.is_fixed[i] || scene_.placed.velocity[i].norm() > 0 ||
                std::isfinite(
                    scene_.surroundings.fixed_spheres.highest_near(p.x(), p.y(), scene_.element.diameter)))
                continue;
            problem(
                i, "origin",
                fmt::format("block {} starts beside the mound (x = {:.4g}, y = {:.4g} m) with nothing below "
                            "to hold it",
                            i + 1, p.x(), p.y()));
            return false;
        }
        return true;
    }

    bool stand_above_the_mound() const {
        for (std::size_t i = 0; i < scene_.placed.size(); ++i) {
            const Vector& p = scene_.placed.position[i];
            const double top = mound_.highest_near(p.x(), p.y(), 0.75 * scene_.element.diameter);
            if (scene_.placed.is_fixed[i] || p.z() >= top) continue;
            problem(i, "level",
                    fmt::format("block {} starts inside the mound: its centre is at z = {:.4g} m, the mound "
                                "there reaches {:.4g} m",
                                i + 1, p.z(), top + 0.5 * scene_.element.diameter));
            return false;
        }
        return true;
    }

    /// Contacts are sought at spheres that can be touched from outside: a block within another would meet
    /// none.
    bool stand_outside_each_other(double allowed) const {
        const Blocks& blocks = scene_.placed;
        const PairList list(blocks, scene_.surroundings, scene_.step.skin);
        for (const auto& pair : list.pairs()) {
            if (!list.is_block(pair.partner)) continue;
            const Shape &a = blocks.shape_of(pair.block), &b = blocks.shape_of(pair.partner);
            const Vector image(0, pair.image * scene_.surroundings.period, 0);
            const double apart = (blocks.position[pair.partner] + image - blocks.position[pair.block]).norm();
            if (apart > std::max(a.radius, b.radius)) continue;
            for (std::size_t k = 0; k < a.spheres.size(); ++k)
                for (std::size_t l = 0; l < b.spheres.size(); ++l) {
                    const double depth =
                        0.5 * (a.diameter + b.diameter) -
                        (blocks.sphere_centre(pair.partner, l) + image - blocks.sphere_centre(pair.block, k))
                            .norm();
                    if (depth <= allowed) continue;
                    problem(pair.partner, "origin",
                            fmt::format("block {} starts {:.2g} m deep in block {}; at most {:.2g} m",
                                        pair.partner + 1, depth, pair.block + 1, allowed));
                    return false;
                }
        }
        return true;
    }

    /// Contacts live in hundredths of a thousandth of an element: positions must tell them apart.
    bool stand_near_the_origin() const {
        const double least = 1e-6 * scene_.element.diameter;
        for (std::size_t i = 0; i < scene_.placed.size(); ++i) {
            const double rounding =
                scene_.placed.position[i].cwiseAbs().maxCoeff() * std::numeric_limits<double>::epsilon();
            if (rounding <= least) continue;
            problem(
                i, "origin",
                fmt::format("block {} is so far from the origin that its place is rounded to {:.1g} m; at "
                            "most {:.1g} m",
                            i + 1, rounding, least));
            return false;
        }
        return true;
    }

    const Section& dem_;
    const Scene& scene_;
    const FixedSpheres& mound_;  // without other fixed spheres: below those there may be room
    std::size_t placed_singly_;
};

/// Two in one place would be one of twice the stiffness.
void judge_fixed_spheres(const Section& dem, const std::vector<Vector>& given) {
    std::map<std::tuple<double, double, double>, std::size_t> known;
    for (std::size_t i = 0; i < given.size(); ++i) {
        const auto [other, is_new] = known.try_emplace({given[i].x(), given[i].y(), given[i].z()}, i);
        if (!is_new)
            dem.problem("fixed_spheres",
                        fmt::format("spheres {} and {} are at the same place", other->second + 1, i + 1));
    }
}

/// Smaller spheres than a shape's own reach deeper into it, and overlaps are deep that would be shallow of
/// elements.
void mind_small_spheres(Scene& scene) {
    double smallest = scene.element.diameter;
    for (const auto& shape : scene.placed.shapes) smallest = std::min(smallest, shape.diameter);
    for (auto& shape : scene.placed.shapes)
        if (smallest < shape.diameter)
            shape.exposed = exposed_spheres(shape.spheres, shape.diameter, smallest);
    const double share = smallest / scene.element.diameter;
    for (double* overlap :
         {&scene.step.overlap_noted, &scene.step.overlap_limit, &scene.step.element_overlap_allowed})
        *overlap *= share;
}

/// Spheres that never move: those given one by one, and the mound's columns. Returns the latter.
FixedSpheres place_fixed_spheres(const Section& dem, Scene& scene, double block_height) {
    std::vector<Vector> fixed =
        vectors(dem.rows("fixed_spheres", "m", "centres of fixed spheres of diameter d", 3,
                         std::vector<std::vector<double>>{}));
    judge_fixed_spheres(dem, fixed);
    std::vector<Vector> columns;
    scene.mound = read_mound(dem, scene, block_height, columns).profile;
    fixed.insert(fixed.end(), columns.begin(), columns.end());
    if (!columns.empty()) {
        scene.surroundings.mound_floor = std::numeric_limits<double>::infinity();
        for (const auto& centre : columns)
            scene.surroundings.mound_floor = std::min(scene.surroundings.mound_floor, centre.z());
    }
    double largest = scene.element.diameter;
    for (const auto& shape : scene.placed.shapes) largest = std::max(largest, shape.diameter);
    const double reach = 0.5 * (largest + scene.element.diameter) + scene.step.skin;
    const double period = scene.surroundings.period;
    scene.surroundings.fixed_spheres = FixedSpheres(std::move(fixed), scene.element.diameter, reach, period);
    return FixedSpheres(std::move(columns), scene.element.diameter, reach, period);
}

}  // namespace

void read_blocks(const SceneFile& file, Scene& scene) {
    const Section dem = file.section("dem");
    ShapeBook book(file, scene);
    read_walls(dem, scene);
    double block_height = 3 * scene.element.diameter;
    std::optional<int> armour;
    if (dem.has("blocks")) {
        armour = read_armour(dem, book, scene);
        block_height = scene.placed.shapes[static_cast<std::size_t>(*armour)].height;
    }
    const FixedSpheres mound = place_fixed_spheres(dem, scene, block_height);
    if (armour) place_armour(dem, scene, *armour, scene.surroundings.fixed_spheres);
    const std::size_t placed_singly = scene.placed.size();
    read_single_blocks(dem, book, scene);
    mind_small_spheres(scene);
    if (scene.surroundings.period > 0) {
        double farthest = 0;
        for (const auto& shape : scene.placed.shapes) farthest = std::max(farthest, shape.radius);
        // Of a block's images only the nearest is felt.
        if (scene.width < 4 * farthest)
            dem.problem("width",
                        fmt::format("{} m is too narrow for periodic sides and blocks {:.3g} m across: "
                                    "expected at least {:.3g} m",
                                    scene.width, 2 * farthest, 4 * farthest));
    }
    if (scene.placed.size() == 0 && !file.has_problems())
        dem.problem("", "no blocks: give [dem.blocks] or [[dem.block]]");

    const Section packing = dem.table("packing");
    scene.packing.settle = packing.choice("method", "how blocks come to rest before the run",
                                          {"settle", "none"}, armour ? "settle" : "none") == "settle";
    // What is enough for the paper's elements; others fall by the root of their size. In three digits, to
    // read well.
    const auto rounded = [](double value) {
        return std::strtod(fmt::format("{:.3g}", value).c_str(), nullptr);
    };
    const double slower = scene.time_scale, length = scene.element.diameter / 0.008;
    scene.packing.longest =
        packing.number("longest", "s", "packing gives up after", Range::positive(), rounded(5.0 * slower));
    scene.packing.speed = packing.number("speed", "m/s", "slower blocks have settled", Range::positive(),
                                         rounded(1e-3 * length / slower));
    scene.packing.look_interval *= slower;
    if (!file.has_problems()) PlacementJudge(dem, scene, mound, placed_singly).judge();
}

}  // namespace dem
