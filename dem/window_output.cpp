#include "dem/window_output.hpp"

#include <algorithm>
#include <utility>

namespace dem {

using common::integer32;
using common::real32;
using common::real64;

namespace {

void append(std::vector<double>& values, const Vector& v) {
    values.insert(values.end(), v.data(), v.data() + 3);
}

/// Orientation of the shape as its file describes it.
Quaternion file_orientation(const Blocks& blocks, std::size_t block, const Quaternion& body) {
    return body * blocks.shape_of(block).body_from_file;
}

void append(std::vector<double>& values, const Quaternion& q) {
    values.insert(values.end(), {q.w(), q.x(), q.y(), q.z()});
}

}  // namespace

void WindowOutput::record(const Simulation& simulation, const PackedPoses& packed) {
    const Blocks& blocks = simulation.blocks;
    const Wires& wires = simulation.wires;
    blocks_ = blocks.size();
    wires_ = wires.size();
    time_.push_back(simulation.time());
    const auto moved = displacements(blocks, packed.position, packed.orientation);
    for (std::size_t i = 0; i < blocks_; ++i) {
        append(position_, blocks.position[i]);
        append(orientation_, file_orientation(blocks, i, blocks.orientation[i]));
        append(velocity_, blocks.velocity[i]);
        append(angular_velocity_, blocks.angular_velocity[i]);
        displacement_.insert(displacement_.end(), {moved[i].total, moved[i].offshore, moved[i].rotation});
    }
    tension_.insert(tension_.end(), wires.tension.begin(), wires.tension.end());
    intact_.insert(intact_.end(), wires.is_intact.begin(), wires.is_intact.end());
    // f_max and f_min of the paper's figure 9: over the wires under tension.
    double most = 0, least = 0;
    for (const double t : wires.tension) {
        most = std::max(most, t);
        if (t > 0 && (least == 0 || t < least)) least = t;
    }
    tension_range_.insert(tension_range_.end(), {least, most});
    const EnergyBudget energy = simulation.energy();
    energy_.insert(energy_.end(), {energy.kinetic, energy.potential, energy.contacts, energy.wires,
                                   energy.dissipated, energy.water_work});
    asleep_.push_back(static_cast<std::int32_t>(simulation.asleep_count()));
}

common::Window WindowOutput::take(std::int64_t index, const Simulation& simulation) {
    common::Window window;
    window.index = index;
    window.t_begin = time_.front();
    window.t_end = time_.back();
    const std::size_t nt = time_.size(), nb = blocks_, nw = wires_;
    auto& data = window.datasets;
    data["/time"] = real64("s", {nt}, std::move(time_));
    data["/blocks/position"] = real64("m", {nt, nb, 3}, std::move(position_));
    data["/blocks/orientation"] = real64("-", {nt, nb, 4}, std::move(orientation_));
    data["/blocks/velocity"] = real64("m/s", {nt, nb, 3}, std::move(velocity_));
    data["/blocks/angular_velocity"] = real64("rad/s", {nt, nb, 3}, std::move(angular_velocity_));
    data["/blocks/displacement"] = real64("m, m, rad", {nt, nb, 3}, std::move(displacement_));
    data["/blocks/asleep"] = integer32("-", {nt}, std::move(asleep_));
    data["/wires/tension"] = real64("N", {nt, nw}, std::move(tension_));
    data["/wires/intact"] = integer32("-", {nt, nw}, std::move(intact_));
    data["/wires/tension_range"] = real64("N", {nt, 2}, std::move(tension_range_));
    data["/energy"] = real64("J", {nt, 6}, std::move(energy_));
    store_contacts(simulation.pair_list().touching(), data);
    *this = WindowOutput{};
    return window;
}

common::DataFile geometry_of(const Simulation& simulation, const PackedPoses& packed,
                             const std::string& placement) {
    common::DataFile file;
    file.attributes["placement_digest"] = placement;
    const Blocks& blocks = simulation.blocks;
    const std::size_t nb = blocks.size();
    std::vector<std::int32_t> shape, fixed;
    std::vector<double> orientation;
    for (std::size_t i = 0; i < nb; ++i) {
        shape.push_back(blocks.shape[i]);
        fixed.push_back(blocks.is_fixed[i]);
        append(orientation, file_orientation(blocks, i, packed.orientation[i]));
    }
    for (std::size_t s = 0; s < blocks.shapes.size(); ++s) {
        const Shape& form = blocks.shapes[s];
        std::vector<Vector> spheres;
        for (const auto& sphere : form.spheres) spheres.push_back(form.body_from_file.conjugate() * sphere);
        const std::string group = "/shapes/" + std::to_string(s);
        file.datasets[group + "/spheres"] = real64("m", {spheres.size(), 3}, flat(spheres));
        file.datasets[group + "/diameter"] = real64("m", {1}, {form.diameter});
        file.datasets[group + "/mass"] = real64("kg", {1}, {form.mass});
        file.attributes["shape_" + std::to_string(s)] = form.name;
    }
    file.datasets["/blocks/shape"] = integer32("-", {nb}, std::move(shape));
    file.datasets["/blocks/fixed"] = integer32("-", {nb}, std::move(fixed));
    file.datasets["/packed/position"] = real64("m", {nb, 3}, flat(packed.position));
    file.datasets["/packed/orientation"] = real64("-", {nb, 4}, std::move(orientation));
    const auto& fixed_spheres = simulation.surroundings().fixed_spheres;
    file.datasets["/mound/spheres"] =
        real32("m", {fixed_spheres.size(), 3}, std::span<const double>(flat(fixed_spheres.centres())));
    file.datasets["/mound/diameter"] = real64("m", {1}, {fixed_spheres.diameter()});
    std::vector<double> planes;
    for (const auto& plane : simulation.surroundings().planes) {
        append(planes, plane.point);
        append(planes, plane.normal);
    }
    file.datasets["/planes"] =
        real64("m, -", {simulation.surroundings().planes.size(), 6}, std::move(planes));
    const Wires& wires = simulation.wires;
    std::vector<std::int32_t> ends;
    for (std::size_t k = 0; k < wires.size(); ++k)
        for (const auto number : {wires.block_a[k], wires.sphere_a[k], wires.block_b[k], wires.sphere_b[k]})
            ends.push_back(static_cast<std::int32_t>(number));
    file.attributes["wire_law"] = static_cast<std::int64_t>(wires.law);
    file.attributes["longest_stretch"] = wires.longest_stretch;
    file.datasets["/wires/ends"] = integer32("-", {wires.size(), 4}, std::move(ends));
    file.datasets["/wires/image_offset"] = real64("m", {wires.size()}, wires.image_offset);
    file.datasets["/wires/rest_length"] = real64("m", {wires.size()}, wires.rest_length);
    file.datasets["/wires/stiffness"] = real64("N/m", {wires.size()}, wires.stiffness);
    return file;
}

}  // namespace dem
