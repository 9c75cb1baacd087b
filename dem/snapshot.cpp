#include "dem/snapshot.hpp"

#include <cstring>

#include "common/digest.hpp"
#include "common/errors.hpp"
#include "dem/sound_state.hpp"

namespace dem {

using common::DataFile;
using common::Dataset;
using common::integer32;
using common::real64;
using common::unsigned64;

std::vector<double> flat(const std::vector<Vector>& vectors) {
    std::vector<double> values;
    values.reserve(3 * vectors.size());
    for (const auto& v : vectors) values.insert(values.end(), v.data(), v.data() + 3);
    return values;
}

std::vector<double> flat(const std::vector<Quaternion>& quaternions) {
    std::vector<double> values;
    values.reserve(4 * quaternions.size());
    for (const auto& q : quaternions) values.insert(values.end(), {q.w(), q.x(), q.y(), q.z()});
    return values;
}

std::vector<Vector> vectors_from(const Dataset& dataset) {
    const auto& values = dataset.doubles();
    std::vector<Vector> vectors;
    for (std::size_t i = 0; i + 2 < values.size(); i += 3)
        vectors.emplace_back(values[i], values[i + 1], values[i + 2]);
    return vectors;
}

std::vector<Quaternion> quaternions_from(const Dataset& dataset) {
    const auto& values = dataset.doubles();
    std::vector<Quaternion> quaternions;
    for (std::size_t i = 0; i + 3 < values.size(); i += 4)
        quaternions.emplace_back(values[i], values[i + 1], values[i + 2], values[i + 3]);
    return quaternions;
}

std::string placement_digest(const Blocks& placed, const Surroundings& surroundings) {
    std::vector<double> numbers;
    const auto append = [&](const std::vector<double>& more) {
        numbers.insert(numbers.end(), more.begin(), more.end());
    };
    for (const auto& shape : placed.shapes) {
        append(flat(shape.spheres));
        append({shape.diameter, shape.mass, shape.inertia.x(), shape.inertia.y(), shape.inertia.z()});
    }
    for (std::size_t i = 0; i < placed.size(); ++i)
        append({static_cast<double>(placed.shape[i]), static_cast<double>(placed.is_fixed[i])});
    append(flat(placed.position));
    append(flat(placed.orientation));
    append(flat(surroundings.fixed_spheres.centres()));
    for (const auto& plane : surroundings.planes)
        append(flat(std::vector<Vector>{plane.point, plane.normal}));
    append({surroundings.period});
    std::string bytes(numbers.size() * sizeof(double), '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return common::digest_of(bytes);
}

Snapshot take_snapshot(const Simulation& simulation, const PackedPoses& packed,
                       const std::string& placement) {
    Snapshot snapshot;
    snapshot.t = simulation.time();
    snapshot.placement_digest = placement;
    snapshot.blocks = simulation.blocks;
    snapshot.packed = packed;
    snapshot.wires = simulation.wires;
    snapshot.memory = simulation.memory();
    return snapshot;
}

namespace {

std::vector<std::int32_t> as_integers(const auto& values) {
    return {values.begin(), values.end()};
}

void store_sums(const std::vector<TouchingPair>& pairs, DataFile& file) {
    std::vector<double> sums;
    for (const auto& pair : pairs)
        for (const Vector& sum : {pair.last.force, pair.last.torque_on_block, pair.last.offset})
            sums.insert(sums.end(), sum.data(), sum.data() + 3);
    file.datasets["/contacts/sums"] = real64("N, N m, m", {pairs.size(), 9}, std::move(sums));
}

void store_wires(const Wires& wires, DataFile& file) {
    const std::size_t count = wires.size();
    std::vector<std::int32_t> ends;
    for (std::size_t k = 0; k < count; ++k)
        for (const auto number : {wires.block_a[k], wires.sphere_a[k], wires.block_b[k], wires.sphere_b[k]})
            ends.push_back(static_cast<std::int32_t>(number));
    file.attributes["wire_law"] = static_cast<std::int64_t>(wires.law);
    file.attributes["longest_stretch"] = wires.longest_stretch;
    file.attributes["energy_of_broken"] = wires.energy_of_broken;
    file.datasets["/wires/ends"] = integer32("-", {count, 4}, std::move(ends));
    file.datasets["/wires/rest_length"] = real64("m", {count}, wires.rest_length);
    file.datasets["/wires/stiffness"] = real64("N/m", {count}, wires.stiffness);
    file.datasets["/wires/image_offset"] = real64("m", {count}, wires.image_offset);
    file.datasets["/wires/intact"] = integer32("-", {count}, as_integers(wires.is_intact));
    file.datasets["/wires/tension"] = real64("N", {count}, wires.tension);
    file.datasets["/wires/largest_tension"] = real64("N", {count}, wires.largest_tension);
    file.datasets["/wires/broken_at"] = real64("s", {count}, wires.broken_at);
}

Wires wires_from(const DataFile& file) {
    Wires wires;
    wires.law = file.integer("wire_law") == 0 ? WireLaw::hooke : WireLaw::progressive;
    wires.longest_stretch = file.number("longest_stretch");
    wires.energy_of_broken = file.number("energy_of_broken");
    const auto& ends = file.at("/wires/ends").integers();
    wires.rest_length = file.at("/wires/rest_length").doubles();
    wires.stiffness = file.at("/wires/stiffness").doubles();
    // States of before periodic boxes had wires across their sides lack it.
    wires.image_offset.resize(wires.stiffness.size());
    if (file.has("/wires/image_offset")) wires.image_offset = file.at("/wires/image_offset").doubles();
    for (const auto flag : file.at("/wires/intact").integers())
        wires.is_intact.push_back(static_cast<std::uint8_t>(flag));
    wires.tension = file.at("/wires/tension").doubles();
    wires.largest_tension = file.at("/wires/largest_tension").doubles();
    wires.broken_at = file.at("/wires/broken_at").doubles();
    for (std::size_t k = 0; k < wires.rest_length.size(); ++k) {
        wires.block_a.push_back(static_cast<std::uint32_t>(ends.at(4 * k)));
        wires.sphere_a.push_back(static_cast<std::uint32_t>(ends.at(4 * k + 1)));
        wires.block_b.push_back(static_cast<std::uint32_t>(ends.at(4 * k + 2)));
        wires.sphere_b.push_back(static_cast<std::uint32_t>(ends.at(4 * k + 3)));
    }
    return wires;
}

}  // namespace

void store_contacts(const std::vector<TouchingPair>& pairs, std::map<std::string, Dataset>& datasets) {
    std::vector<std::int32_t> bodies, spheres;
    std::vector<double> springs;
    for (const auto& pair : pairs) {
        for (const auto number : {pair.block, pair.partner})
            bodies.push_back(static_cast<std::int32_t>(number));
        bodies.push_back(pair.image);
        bodies.push_back(static_cast<std::int32_t>(pair.contacts.size()));
        for (const auto& contact : pair.contacts) {
            spheres.push_back(static_cast<std::int32_t>(contact.a));
            spheres.push_back(static_cast<std::int32_t>(contact.b));
            springs.push_back(contact.stiffness);
            springs.insert(springs.end(), contact.spring.data(), contact.spring.data() + 3);
        }
    }
    const std::size_t contacts = spheres.size() / 2;
    datasets["/contacts/bodies"] = integer32("-", {pairs.size(), 4}, std::move(bodies));
    datasets["/contacts/spheres"] = integer32("-", {contacts, 2}, std::move(spheres));
    datasets["/contacts/springs"] = real64("N/m, N", {contacts, 4}, std::move(springs));
}

std::vector<TouchingPair> contacts_from(const Dataset& bodies_of, const Dataset& spheres_of,
                                        const Dataset& springs_of, const Dataset* sums) {
    const auto& bodies = bodies_of.integers();
    const auto& spheres = spheres_of.integers();
    const auto& springs = springs_of.doubles();
    std::vector<TouchingPair> pairs;
    std::size_t next = 0;
    for (std::size_t k = 0; 4 * k + 3 < bodies.size(); ++k) {
        TouchingPair pair;
        pair.block = static_cast<std::uint32_t>(bodies[4 * k]);
        pair.partner = static_cast<std::uint32_t>(bodies[4 * k + 1]);
        pair.image = bodies[4 * k + 2];
        if (sums != nullptr && 9 * k + 8 >= sums->doubles().size())
            throw common::InputError("/contacts/sums has fewer rows than /contacts/bodies");
        if (sums != nullptr) {
            const double* sum = sums->doubles().data() + 9 * k;
            pair.last.force = Vector(sum);
            pair.last.torque_on_block = Vector(sum + 3);
            pair.last.offset = Vector(sum + 6);
        }
        for (std::int32_t c = 0; c < bodies[4 * k + 3]; ++c, ++next) {
            if (2 * next + 1 >= spheres.size() || 4 * next + 3 >= springs.size())
                throw common::InputError("/contacts/bodies names more contacts than there are");
            pair.contacts.push_back({static_cast<std::uint32_t>(spheres[2 * next]),
                                     static_cast<std::uint32_t>(spheres[2 * next + 1]), springs[4 * next],
                                     Vector(springs.data() + 4 * next + 1)});
        }
        pairs.push_back(std::move(pair));
    }
    if (2 * next != spheres.size())
        throw common::InputError("/contacts/bodies names fewer contacts than there are");
    return pairs;
}

DataFile to_data_file(const Snapshot& snapshot) {
    DataFile file;
    const Blocks& blocks = snapshot.blocks;
    const std::size_t count = blocks.size();
    const auto& memory = snapshot.memory;
    file.attributes = {{"placement_digest", snapshot.placement_digest},
                       {"rest_digest", snapshot.rest_digest},
                       {"is_packing", static_cast<std::int64_t>(snapshot.is_packing)},
                       {"time", snapshot.t},
                       {"dissipated", memory.dissipated},
                       {"water_work", memory.water_work},
                       {"gross_water_work", memory.gross_water_work},
                       {"largest_kinetic", memory.largest_kinetic},
                       {"largest_overlap", memory.largest_overlap},
                       {"waves_reach_blocks", memory.waves_reach_blocks},
                       {"steps", static_cast<std::int64_t>(memory.steps)},
                       {"awake_block_steps", static_cast<std::int64_t>(memory.awake_block_steps)},
                       {"deep_contact_steps", static_cast<std::int64_t>(memory.deep_contact_steps)}};
    file.datasets["/blocks/shape"] = integer32("-", {count}, as_integers(blocks.shape));
    file.datasets["/blocks/fixed"] = integer32("-", {count}, as_integers(blocks.is_fixed));
    file.datasets["/blocks/position"] = real64("m", {count, 3}, flat(blocks.position));
    file.datasets["/blocks/orientation"] = real64("-", {count, 4}, flat(blocks.orientation));
    file.datasets["/blocks/velocity"] = real64("m/s", {count, 3}, flat(blocks.velocity));
    file.datasets["/blocks/angular_momentum"] = real64("kg m2/s", {count, 3}, flat(blocks.angular_momentum));
    file.datasets["/blocks/angular_velocity"] = real64("rad/s", {count, 3}, flat(blocks.angular_velocity));
    file.datasets["/blocks/mass_ratio"] = real64("-", {count}, blocks.mass_ratio);
    file.datasets["/blocks/force"] = real64("N", {count, 3}, flat(blocks.force));
    file.datasets["/blocks/torque"] = real64("N m", {count, 3}, flat(blocks.torque));
    file.datasets["/packed/position"] = real64("m", {count, 3}, flat(snapshot.packed.position));
    file.datasets["/packed/orientation"] = real64("-", {count, 4}, flat(snapshot.packed.orientation));
    store_wires(snapshot.wires, file);
    store_contacts(memory.pairs, file.datasets);
    store_sums(memory.pairs, file);
    if (memory.sleeping) {
        file.datasets["/sleeping/asleep"] = integer32("-", {count}, as_integers(memory.sleeping->asleep));
        file.datasets["/sleeping/position"] = real64("m", {count, 3}, flat(memory.sleeping->position));
        file.datasets["/sleeping/orientation"] = real64("-", {count, 4}, flat(memory.sleeping->orientation));
        file.datasets["/sleeping/force"] = real64("N", {count, 3}, flat(memory.sleeping->force));
        file.datasets["/sleeping/torque"] = real64("N m", {count, 3}, flat(memory.sleeping->torque));
        file.datasets["/sleeping/since"] = real64("s", {count}, memory.sleeping->since);
        file.datasets["/sleeping/wake_force"] = real64("N", {count}, memory.sleeping->wake_force);
    }
    return file;
}

Snapshot snapshot_from(const DataFile& file) {
    require_sound_datasets(file);
    Snapshot snapshot;
    snapshot.t = file.number("time");
    snapshot.placement_digest = file.text("placement_digest");
    snapshot.rest_digest = file.text("rest_digest");
    snapshot.is_packing = file.integer("is_packing") != 0;
    Blocks& blocks = snapshot.blocks;
    for (const auto shape : file.at("/blocks/shape").integers()) blocks.shape.push_back(shape);
    for (const auto fixed : file.at("/blocks/fixed").integers())
        blocks.is_fixed.push_back(static_cast<std::uint8_t>(fixed));
    blocks.position = vectors_from(file.at("/blocks/position"));
    blocks.orientation = quaternions_from(file.at("/blocks/orientation"));
    blocks.velocity = vectors_from(file.at("/blocks/velocity"));
    blocks.angular_momentum = vectors_from(file.at("/blocks/angular_momentum"));
    blocks.angular_velocity = vectors_from(file.at("/blocks/angular_velocity"));
    blocks.mass_ratio = file.at("/blocks/mass_ratio").doubles();
    blocks.force = vectors_from(file.at("/blocks/force"));
    blocks.torque = vectors_from(file.at("/blocks/torque"));
    for (const auto& q : blocks.orientation) blocks.rotation.push_back(q.toRotationMatrix());
    snapshot.packed.position = vectors_from(file.at("/packed/position"));
    snapshot.packed.orientation = quaternions_from(file.at("/packed/orientation"));
    snapshot.wires = wires_from(file);
    auto& memory = snapshot.memory;
    memory.pairs = contacts_from(file.at("/contacts/bodies"), file.at("/contacts/spheres"),
                                 file.at("/contacts/springs"), &file.at("/contacts/sums"));
    memory.time = snapshot.t;
    memory.dissipated = file.number("dissipated");
    memory.water_work = file.number("water_work");
    memory.gross_water_work = file.number("gross_water_work");
    memory.largest_kinetic = file.number("largest_kinetic");
    memory.largest_overlap = file.number("largest_overlap");
    memory.waves_reach_blocks = file.number("waves_reach_blocks");
    memory.steps = static_cast<std::uint64_t>(file.integer("steps"));
    memory.awake_block_steps = static_cast<std::uint64_t>(file.integer("awake_block_steps"));
    memory.deep_contact_steps = static_cast<std::uint64_t>(file.integer("deep_contact_steps"));
    if (file.has("/sleeping/asleep")) {
        Sleeping::Memory sleeping;
        for (const auto flag : file.at("/sleeping/asleep").integers())
            sleeping.asleep.push_back(static_cast<std::uint8_t>(flag));
        sleeping.position = vectors_from(file.at("/sleeping/position"));
        sleeping.orientation = quaternions_from(file.at("/sleeping/orientation"));
        sleeping.force = vectors_from(file.at("/sleeping/force"));
        sleeping.torque = vectors_from(file.at("/sleeping/torque"));
        sleeping.since = file.at("/sleeping/since").doubles();
        // A state from before it was kept: whoever sleeps wakes at any change.
        if (file.has("/sleeping/wake_force"))
            sleeping.wake_force = file.at("/sleeping/wake_force").doubles();
        else
            sleeping.wake_force.assign(sleeping.since.size(), 0);
        memory.sleeping = std::move(sleeping);
    }
    return snapshot;
}

}  // namespace dem
