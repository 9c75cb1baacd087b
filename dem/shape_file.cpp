/// Shapes by name: those compiled in, and TOML files of the user.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <string_view>
#include <utility>

#include "common/errors.hpp"
#include "dem/scene.hpp"

namespace dem {

using common::Range;
using common::SceneFile;

namespace {

/// name, content of dem/shapes/<name>.toml
constexpr std::pair<std::string_view, std::string_view> shape_texts[] = {
#include "shape_texts.inc"
};

ShapeDescription read_shape(const SceneFile& file, const std::string& name) {
    for (const auto& key : file.root().keys())
        if (key != "dem" && key != "title")
            file.root().problem(key, "does not belong in a shape, which holds [dem.shape] only");
    const common::Section section = file.section("dem.shape");
    ShapeDescription shape;
    shape.name = name;
    for (const auto& row : section.rows("spheres", "d", "centres of the spheres", 3))
        shape.spheres.emplace_back(row[0], row[1], row[2]);
    shape.diameter = section.number("diameter", "d", "of the spheres", Range::positive(), 1.0);
    shape.elements = section.number("elements", "-", "elements the shape stands for; 0: as many as spheres",
                                    Range::not_negative(), 0.0);
    if (section.has("mass"))
        shape.mass =
            section.number("mass", "kg", "dry; default: that of the elements", Range::positive(), 1.0);
    if (section.has("inertia")) {
        const auto i = section.numbers("inertia", "kg m2", "dry, about the centre of mass along the axes", 3,
                                       Range::positive());
        shape.inertia = Vector(i[0], i[1], i[2]);
    }
    file.finish();
    return shape;
}

}  // namespace

std::vector<std::string> built_in_shapes() {
    std::vector<std::string> names;
    for (const auto& [name, text] : shape_texts) names.emplace_back(name);
    return names;
}

ShapeDescription find_shape(const std::string& name, const std::filesystem::path& scene_folder) {
    for (const auto& [known, text] : shape_texts)
        if (name == known) return read_shape(SceneFile::parse(text, fmt::format("shape {}", name)), name);
    if (!name.ends_with(".toml"))
        throw common::InputError(fmt::format("unknown shape '{}'; there are {}, or the name of a .toml file",
                                             name, fmt::join(built_in_shapes(), ", ")));
    const std::filesystem::path path =
        std::filesystem::path(name).is_absolute() ? std::filesystem::path(name) : scene_folder / name;
    return read_shape(SceneFile::read(path), path.stem().string());
}

}  // namespace dem
