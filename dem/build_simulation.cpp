#include "dem/build_simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "common/digest.hpp"
#include "common/errors.hpp"
#include "common/window_channel.hpp"
#include "dem/sound_state.hpp"

namespace dem {

namespace {

std::unique_ptr<Simulation> build_with(Blocks blocks, const Scene& scene, bool with_water) {
    auto simulation = std::make_unique<Simulation>(
        std::move(blocks), scene.surroundings,
        make_contact_model(scene.contact, scene.material, scene.element.diameter, scene.reference_overlap),
        scene.gravity, scene.step);
    if (with_water && scene.effects.fluid_force)
        simulation->add_water({.water = scene.water, .element = scene.element, .gravity = scene.gravity},
                              scene.uniform_water);
    if (scene.effects.sleeping) simulation->add_sleeping(scene.sleep);
    return simulation;
}

}  // namespace

std::unique_ptr<Simulation> build_simulation(const Scene& scene, bool with_water) {
    return build_with(scene.placed, scene, with_water);
}

std::unique_ptr<Simulation> build_packing(const Scene& scene) {
    Blocks blocks = scene.placed;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (!blocks.is_thrown(i)) continue;
        blocks.is_fixed[i] = 1;
        blocks.place(i, blocks.position[i], blocks.orientation[i], Vector::Zero(), Vector::Zero());
    }
    auto simulation = build_with(std::move(blocks), scene, true);
    if (simulation->water() != nullptr)
        simulation->water()->set_motion(UniformWater{.element_diameter = scene.element.diameter});
    return simulation;
}

void settle(Simulation& simulation, const PackingRules& rules, const std::string& when,
            const std::function<void(double)>& progress) {
    simulation.start(0);
    int calm = 0;
    while (simulation.time() < rules.longest) {
        simulation.advance(simulation.time() + rules.look_interval);
        progress(simulation.time());
        double fastest = 0;
        for (std::size_t i = 0; i < simulation.blocks.size(); ++i)
            if (!simulation.blocks.is_fixed[i])
                fastest = std::max(fastest, simulation.blocks.velocity[i].norm() +
                                                simulation.blocks.angular_velocity[i].norm() *
                                                    simulation.blocks.shape_of(i).radius);
        // Calm over several looks: a block at the top of a bounce is slow for an instant only.
        calm = fastest < rules.speed ? calm + 1 : 0;
        if (calm >= 5) return;
    }
    throw common::RunError(
        fmt::format("{}: blocks still move after {} s; raise dem.packing.longest or dem.packing.speed", when,
                    rules.longest));
}

void throw_held(Blocks& blocks, const Scene& scene) {
    const Blocks& placed = scene.placed;
    blocks.is_fixed = placed.is_fixed;
    for (std::size_t i = 0; i < blocks.size(); ++i)
        if (placed.is_thrown(i))
            blocks.place(i, blocks.position[i], blocks.orientation[i], placed.velocity[i],
                         placed.angular_velocity[i]);
}

PackedPoses poses_of(const Blocks& blocks) {
    return {blocks.position, blocks.orientation};
}

void take_over(Simulation& simulation, const PackedPoses& packed, const std::vector<TouchingPair>& contacts) {
    for (std::size_t i = 0; i < simulation.blocks.size(); ++i)
        simulation.blocks.place(i, packed.position[i], packed.orientation[i], Vector::Zero(), Vector::Zero());
    Simulation::Memory memory = simulation.memory();
    memory.pairs = contacts;
    memory.sleeping.reset();
    simulation.restore(memory);
}

namespace {

double distance(const Blocks& blocks, const WirePlace& place, double image) {
    return (blocks.sphere_centre(place.block_b, place.sphere_b) + Vector(0, image, 0) -
            blocks.sphere_centre(place.block_a, place.sphere_a))
        .norm();
}

void check_same_scene(const std::string& digest, const Scene& scene, const std::filesystem::path& from) {
    if (digest != placement_digest(scene.placed, scene.surroundings))
        throw common::InputError(fmt::format(
            "{}: a state of another scene (shapes, places, mound or walls differ)", from.string()));
}

/// The sample of a window closest to `time` (the last one without), with packed poses and wires of its
/// geometry file.
Snapshot snapshot_from_window(const std::filesystem::path& from, const Scene& scene) {
    const common::Window window =
        common::read_window(from, "dem",
                            {{"/time", "s", {"nt"}},
                             {"/blocks/position", "m", {"nt", "nb", "3"}},
                             {"/blocks/orientation", "-", {"nt", "nb", "4"}},
                             {"/blocks/velocity", "m/s", {"nt", "nb", "3"}},
                             {"/blocks/angular_velocity", "rad/s", {"nt", "nb", "3"}}});
    const common::DataFile geometry = common::read_data_file(from.parent_path() / "geometry.h5");
    check_same_scene(geometry.text("placement_digest"), scene, from);
    const auto times = window.at("/time").as_double();
    std::size_t sample = times.size() - 1;
    if (scene.restart_time) {
        const auto close = std::find_if(times.begin(), times.end(),
                                        [&](double t) { return std::abs(t - *scene.restart_time) < 1e-6; });
        if (close == times.end())
            throw common::InputError(fmt::format(
                "{}: no sample at dem.restart.time = {} s; it holds {:.10g} to {:.10g} s every {:.10g} s",
                from.string(), *scene.restart_time, times.front(), times.back(),
                times.size() > 1 ? times[1] - times[0] : 0.0));
        sample = static_cast<std::size_t>(close - times.begin());
    }
    Snapshot snapshot;
    snapshot.t = times[sample];
    snapshot.packed.position = vectors_from(geometry.at("/packed/position"));
    snapshot.packed.orientation = quaternions_from(geometry.at("/packed/orientation"));
    const std::size_t count = scene.placed.size();
    for (std::size_t i = 0; i < std::min(count, snapshot.packed.orientation.size()); ++i)
        snapshot.packed.orientation[i] *= scene.placed.shape_of(i).body_from_file.conjugate();
    const auto position = vectors_from(window.at("/blocks/position"));
    const auto orientation = quaternions_from(window.at("/blocks/orientation"));
    const auto velocity = vectors_from(window.at("/blocks/velocity"));
    const auto spin = vectors_from(window.at("/blocks/angular_velocity"));
    if (position.size() != times.size() * count)
        throw common::InputError(fmt::format("{}: holds {} blocks, the scene {}", from.string(),
                                             position.size() / times.size(), count));
    snapshot.blocks.shapes = scene.placed.shapes;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t k = sample * count + i;
        const Shape& shape = scene.placed.shape_of(i);
        snapshot.blocks.add(scene.placed.shape[i], position[k],
                            orientation[k] * shape.body_from_file.conjugate(), scene.placed.is_fixed[i] != 0,
                            velocity[k], spin[k]);
    }
    snapshot.wires.law = geometry.integer("wire_law") == 0 ? WireLaw::hooke : WireLaw::progressive;
    snapshot.wires.longest_stretch = geometry.number("longest_stretch");
    const auto& ends = geometry.at("/wires/ends").integers();
    const auto& rest = geometry.at("/wires/rest_length").doubles();
    const auto& stiffness = geometry.at("/wires/stiffness").doubles();
    const auto& image = geometry.at("/wires/image_offset").doubles();
    std::vector<std::uint8_t> intact;
    for (const double flag : window.at("/wires/intact").as_double()) intact.push_back(flag > 0.5);
    if (intact.size() != times.size() * rest.size())
        throw common::InputError(fmt::format("{}: holds {} wires, geometry.h5 {}", from.string(),
                                             intact.size() / times.size(), rest.size()));
    for (std::size_t w = 0; w < rest.size(); ++w) {
        snapshot.wires.add(static_cast<std::uint32_t>(ends[4 * w]),
                           static_cast<std::uint32_t>(ends[4 * w + 1]),
                           static_cast<std::uint32_t>(ends[4 * w + 2]),
                           static_cast<std::uint32_t>(ends[4 * w + 3]), rest[w], stiffness[w], image[w]);
        snapshot.wires.is_intact[w] = intact[sample * rest.size() + w];
        // A window tells at which of its samples a wire was first found broken, not when it broke.
        for (std::size_t k = sample + 1; k-- > 0 && !intact[k * rest.size() + w];)
            snapshot.wires.broken_at[w] = times[k];
    }
    snapshot.memory.time = snapshot.t;
    snapshot.memory.waves_reach_blocks = -1;
    if (sample + 1 == times.size())
        snapshot.memory.pairs = contacts_from(window.at("/contacts/bodies"), window.at("/contacts/spheres"),
                                              window.at("/contacts/springs"), nullptr);
    else
        snapshot.without_springs = fmt::format(
            "{}: t = {} s lies inside the window, where contacts have no tangential springs stored: blocks "
            "jump by some thousandths of an element; its end, t = {} s, has them",
            from.string(), snapshot.t, times.back());
    return snapshot;
}

/// What `read` gives; the message of an InputError begins with the file's name, as some do by themselves.
Snapshot named(const std::filesystem::path& from, const std::function<Snapshot()>& read) {
    try {
        return read();
    } catch (const common::InputError& fault) {
        const std::string message = fault.what();
        const bool is_named = message.starts_with(from.string()) ||
                              message.starts_with((from.parent_path() / "geometry.h5").string());
        throw common::InputError(is_named ? message : fmt::format("{}: {}", from.string(), message));
    }
}

}  // namespace

Snapshot read_start(const std::filesystem::path& from, const Scene& scene) {
    if (from.filename().string().starts_with("window_"))
        return named(from, [&] {
            Snapshot snapshot = snapshot_from_window(from, scene);
            require_sound(snapshot, scene.placed);
            return snapshot;
        });
    const common::DataFile file = common::read_data_file(from);
    if (file.text("schema") != "tsunagi.dem.state/1")
        throw common::InputError(
            fmt::format("{}: not a state of dem (schema '{}')", from.string(), file.text("schema")));
    check_same_scene(file.text("placement_digest"), scene, from);
    Snapshot snapshot = named(from, [&] {
        Snapshot read = snapshot_from(file);
        require_sound(read, scene.placed);
        return read;
    });
    if (scene.restart_time && std::abs(*scene.restart_time - snapshot.t) > 1e-6)
        throw common::InputError(
            fmt::format("{}: holds t = {} s only; dem.restart.time = {} s needs the window of that instant",
                        from.string(), snapshot.t, *scene.restart_time));
    return snapshot;
}

std::string rest_digest(const Scene& scene) {
    const auto of = [](const Vector& v) { return fmt::format("{} {} {} ", v.x(), v.y(), v.z()); };
    const Material& material = scene.material;
    const Water& water = scene.water;
    const UniformWater& uniform = scene.uniform_water;
    const Effects& effects = scene.effects;
    return common::digest_of(of(scene.gravity) + of(uniform.velocity) + of(uniform.acceleration) +
                             fmt::format("{} {} {} {} {} {} {} ", material.young_modulus,
                                         material.poisson_ratio, material.friction, material.damping_ratio,
                                         static_cast<int>(scene.contact), scene.reference_overlap,
                                         scene.still_outside) +
                             fmt::format("{} {} {} {} ", water.density, water.viscosity,
                                         water.added_mass_coefficient, water.drag_coefficient) +
                             fmt::format("{} {} {} {} {} {}", scene.sleep.rest_time,
                                         scene.sleep.rest_displacement, scene.sleep.wake_load,
                                         effects.fluid_force, effects.tangential_history, effects.sleeping));
}

void restore(Simulation& simulation, const Snapshot& snapshot) {
    const auto shapes = simulation.blocks.shapes;
    simulation.blocks = snapshot.blocks;
    simulation.blocks.shapes = shapes;
    simulation.restore(snapshot.memory);
}

namespace {

/// Number of each wire by its two ends.
std::map<WirePlace, std::size_t> places_of(const Wires& wires) {
    std::map<WirePlace, std::size_t> places;
    for (std::size_t k = 0; k < wires.size(); ++k)
        places[in_order({wires.block_a[k], wires.sphere_a[k], wires.block_b[k], wires.sphere_b[k]})] = k;
    return places;
}

bool is_put_back(const Scene& scene, const WirePlace& place) {
    const auto& chosen = scene.wires.put_back;
    return std::binary_search(chosen.begin(), chosen.end(), place.block_a) ||
           std::binary_search(chosen.begin(), chosen.end(), place.block_b);
}

/// The wires of the layout where blocks stand now; with `earlier`, those it already has between the same
/// spheres keep rest length and damage, unless one of their blocks was put back. `only_kept`: no others.
Wires layout_wires(const Blocks& blocks, const Scene& scene, const Wires* earlier, bool only_kept) {
    Wires wires;
    wires.law = scene.wires.law;
    wires.longest_stretch = scene.effects.wire_breaking ? scene.wires.psi * scene.element.diameter
                                                        : std::numeric_limits<double>::infinity();
    std::map<WirePlace, std::size_t> known;
    if (earlier != nullptr) known = places_of(*earlier);
    const double period = scene.surroundings.period;
    for (const auto& link : scene.wires.links)
        for (const auto& place : wires_of(scene.placed, link, period)) {
            const double stiffness = link.stiffness.value_or(scene.wires.stiffness);
            const auto old = known.find(in_order(place));
            const bool is_kept = old != known.end() && !is_put_back(scene, place);
            if (only_kept && !is_kept) continue;
            const double image = nearest_image(scene.placed, place.block_a, place.block_b, period);
            const double mounted = link.rest_length.value_or(distance(blocks, place, image) + link.slack);
            wires.add(place.block_a, place.sphere_a, place.block_b, place.sphere_b, mounted, stiffness,
                      image);
            if (!is_kept) continue;
            wires.rest_length.back() = earlier->rest_length[old->second];
            wires.is_intact.back() = earlier->is_intact[old->second];
            wires.broken_at.back() = earlier->broken_at[old->second];
        }
    return wires;
}

}  // namespace

void mount_layout(Simulation& simulation, const Scene& scene, const Wires* earlier) {
    if (scene.effects.wires) simulation.mount_wires(layout_wires(simulation.blocks, scene, earlier, false));
}

void require_holding_wires(const Blocks& blocks, const Scene& scene, const Wires* earlier, double margin) {
    if (!scene.effects.wires || !scene.effects.wire_breaking) return;
    std::map<WirePlace, std::size_t> known;
    if (earlier != nullptr) known = places_of(*earlier);
    const double period = scene.surroundings.period;
    for (const auto& link : scene.wires.links) {
        if (!link.rest_length) continue;
        const double longest = *link.rest_length + scene.wires.psi * scene.element.diameter;
        for (const auto& place : wires_of(scene.placed, link, period)) {
            if (known.contains(in_order(place)) && !is_put_back(scene, place)) continue;
            const double apart =
                distance(blocks, place, nearest_image(scene.placed, place.block_a, place.block_b, period));
            if (apart <= longest * (1 + 1e-12) + margin) continue;
            throw common::InputError(fmt::format(
                "wires: the link of blocks {} and {} (spheres {} and {}) has a rest_length of {:.6g} m and "
                "breaks beyond {:.10g} m, but is mounted at a distance of {:.10g} m: it would break at once; "
                "give it a longer rest_length, or none",
                place.block_a + 1, place.block_b + 1, place.sphere_a + 1, place.sphere_b + 1,
                *link.rest_length, longest, apart));
        }
    }
}

void require_kept_rest_lengths(const Scene& scene, const Wires& earlier) {
    const auto known = places_of(earlier);
    for (const auto& link : scene.wires.links) {
        if (!link.rest_length) continue;
        for (const auto& place : wires_of(scene.placed, link, scene.surroundings.period)) {
            const auto old = known.find(in_order(place));
            if (old == known.end() || is_put_back(scene, place)) continue;
            const double kept = earlier.rest_length[old->second];
            // As stored, but for a last digit that someone copied.
            if (std::abs(*link.rest_length - kept) > 1e-6 * kept)
                throw common::InputError(
                    fmt::format("wires: the layout gives the wire between blocks {} and {} a rest_length of "
                                "{:.6g} m, but "
                                "it goes on from the earlier run with {:.6g} m; leave rest_length out, or "
                                "put a block back",
                                place.block_a + 1, place.block_b + 1, *link.rest_length, kept));
        }
    }
}

Wires kept_wires(const Blocks& blocks, const Scene& scene, const Wires& earlier) {
    return layout_wires(blocks, scene, &earlier, true);
}

}  // namespace dem
