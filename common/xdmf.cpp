#include "common/xdmf.hpp"

#include <fmt/format.h>

#include <vector>

#include "common/data_file.hpp"
#include "common/window_channel.hpp"

namespace common {

namespace {

/// Reference to one dataset, or to its slice number `sample` along the first axis.
class Item {
 public:
    Item(const Window& window, const std::string& name)
        : file_(window_path({}, window.index).filename().string()), name_(name), dataset_(window.at(name)) {}

    std::string whole() const { return reference(dataset_.shape); }

    std::string slice(std::size_t sample) const {
        const auto& shape = dataset_.shape;
        std::vector<std::size_t> start(shape.size(), 0), stride(shape.size(), 1), count = shape;
        start[0] = sample;
        count[0] = 1;
        return fmt::format(
            "<DataItem ItemType=\"HyperSlab\" Dimensions=\"{}\"><DataItem Dimensions=\"3 {}\" "
            "Format=\"XML\">{} {} {}"
            "</DataItem>{}</DataItem>",
            words({shape.begin() + 1, shape.end()}), shape.size(), words(start), words(stride), words(count),
            reference(shape));
    }

    std::size_t extent(std::size_t axis) const { return dataset_.shape.at(axis); }

 private:
    static std::string words(const std::vector<std::size_t>& numbers) {
        return fmt::format("{}", fmt::join(numbers, " "));
    }
    std::string reference(const std::vector<std::size_t>& shape) const {
        const bool is_integer = std::holds_alternative<std::vector<std::int32_t>>(dataset_.values);
        const bool is_double = std::holds_alternative<std::vector<double>>(dataset_.values);
        return fmt::format(
            "<DataItem Dimensions=\"{}\" NumberType=\"{}\" Precision=\"{}\" Format=\"HDF\">{}:{}</DataItem>",
            words(shape), is_integer ? "Int" : "Float", is_double ? 8 : 4, file_, name_);
    }
    std::string file_, name_;
    const Dataset& dataset_;
};

std::string attribute(const std::string& name, const std::string& type, const std::string& item) {
    return fmt::format("<Attribute Name=\"{}\" AttributeType=\"{}\" Center=\"Node\">{}</Attribute>", name,
                       type, item);
}

std::string grid(const std::string& name, double time, const std::string& body) {
    return fmt::format("<Grid Name=\"{}\"><Time Value=\"{:.9g}\"/>{}</Grid>\n", name, time, body);
}

std::string points(std::size_t count, const std::string& geometry_type, const std::string& geometry) {
    return fmt::format(
        "<Topology TopologyType=\"Polyvertex\" NumberOfElements=\"{}\"/><Geometry "
        "GeometryType=\"{}\">{}</Geometry>",
        count, geometry_type, geometry);
}

/// Surface over x: a curve of a rectilinear grid one node high, with the elevation as a field.
std::string surface_grids(const Window& window) {
    const auto times = window.at("/time").as_double();
    const Item x(window, "/x"), elevation(window, "/surface_elevation"), velocity(window, "/velocity");
    std::string text;
    for (std::size_t k = 0; k < times.size(); ++k) {
        text += grid(
            "surface", times[k],
            fmt::format(
                "<Topology TopologyType=\"2DRectMesh\" Dimensions=\"1 {}\"/><Geometry "
                "GeometryType=\"VXVY\">{}<DataItem Dimensions=\"1\" Format=\"XML\">0</DataItem></Geometry>",
                x.extent(0), x.whole()) +
                attribute("surface_elevation", "Scalar", elevation.slice(k)) +
                attribute("velocity", "Scalar", velocity.slice(k)));
    }
    return text;
}

std::string particle_grids(const Window& window) {
    const auto times = window.at("/particles/time").as_double();
    const Item position(window, "/particles/position"), velocity(window, "/particles/velocity"),
        pressure(window, "/particles/pressure"), kind(window, "/particles/kind");
    std::string text;
    for (std::size_t k = 0; k < times.size(); ++k)
        text += grid("particles", times[k],
                     points(position.extent(1), "XY", position.slice(k)) +
                         attribute("velocity", "Matrix", velocity.slice(k)) +
                         attribute("pressure", "Scalar", pressure.slice(k)) +
                         attribute("kind", "Scalar", kind.whole()));
    return text;
}

std::string flow_grids(const Window& window) {
    const auto times = window.at("/flow/time").as_double();
    const Item x(window, "/flow/x"), z(window, "/flow/z"), velocity(window, "/flow/velocity"),
        acceleration(window, "/flow/acceleration"), wet(window, "/flow/wet");
    std::string text;
    for (std::size_t k = 0; k < times.size(); ++k)
        text += grid("flow", times[k],
                     fmt::format("<Topology TopologyType=\"2DRectMesh\" Dimensions=\"{} {}\"/><Geometry "
                                 "GeometryType=\"VXVY\">{}{}</Geometry>",
                                 z.extent(0), x.extent(0), x.whole(), z.whole()) +
                         attribute("velocity", "Matrix", velocity.slice(k)) +
                         attribute("acceleration", "Matrix", acceleration.slice(k)) +
                         attribute("wet", "Scalar", wet.slice(k)));
    return text;
}

std::string block_grids(const Window& window) {
    const auto times = window.at("/time").as_double();
    const Item position(window, "/blocks/position"), velocity(window, "/blocks/velocity"),
        orientation(window, "/blocks/orientation"), angular(window, "/blocks/angular_velocity");
    std::string text;
    for (std::size_t k = 0; k < times.size(); ++k)
        text += grid("blocks", times[k],
                     points(position.extent(1), "XYZ", position.slice(k)) +
                         attribute("velocity", "Vector", velocity.slice(k)) +
                         attribute("orientation", "Matrix", orientation.slice(k)) +
                         attribute("angular_velocity", "Vector", angular.slice(k)));
    return text;
}

}  // namespace

void XdmfIndex::add(const Window& window) {
    if (window.datasets.contains("/surface_elevation"))
        grids_["surface"][window.index] = surface_grids(window);
    if (window.datasets.contains("/particles/position"))
        grids_["particles"][window.index] = particle_grids(window);
    if (window.datasets.contains("/flow/velocity")) grids_["flow"][window.index] = flow_grids(window);
    if (window.datasets.contains("/blocks/position")) grids_["blocks"][window.index] = block_grids(window);
}

std::string XdmfIndex::text() const {
    // As long as the run: no second copy of it, and no room to grow into.
    std::size_t length = 256;
    for (const auto& [name, windows] : grids_) {
        length += 128;
        for (const auto& [index, grids] : windows) length += grids.size();
    }
    std::string body;
    body.reserve(length);
    body += "<?xml version=\"1.0\"?>\n<Xdmf Version=\"3.0\"><Domain>\n";
    for (const auto& [name, windows] : grids_) {
        body += fmt::format("<Grid Name=\"{}\" GridType=\"Collection\" CollectionType=\"Temporal\">\n", name);
        for (const auto& [index, grids] : windows) body += grids;
        body += "</Grid>\n";
    }
    body += "</Domain></Xdmf>\n";
    return body;
}

void XdmfIndex::write(const std::filesystem::path& folder, const std::string& stage) const {
    if (!grids_.empty()) write_text_file(folder / (stage + ".xdmf"), text());
}

}  // namespace common
