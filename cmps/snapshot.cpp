#include "cmps/snapshot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/errors.hpp"

namespace cmps {
namespace {

template <class Particles, class Visit>
void for_each_real_array(Particles& particles, const Visit& visit) {
    visit("x", "m", particles.x), visit("z", "m", particles.z);
    visit("u", "m/s", particles.u), visit("w", "m/s", particles.w);
    visit("pressure", "Pa", particles.pressure);
    visit("path_u1", "m/s", particles.path_u[0]), visit("path_w1", "m/s", particles.path_w[0]);
    visit("path_u2", "m/s", particles.path_u[1]), visit("path_w2", "m/s", particles.path_w[1]);
    visit("path_u3", "m/s", particles.path_u[2]), visit("path_w3", "m/s", particles.path_w[2]);
    visit("normal_x", "-", particles.normal_x), visit("normal_z", "-", particles.normal_z);
}

struct Box {
    double x0 = 1e300, x1 = -1e300, z0 = 1e300, z1 = -1e300;
};

Box box_of(const Particles& particles) {
    Box box;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        box.x0 = std::min(box.x0, particles.x[i]), box.x1 = std::max(box.x1, particles.x[i]);
        box.z0 = std::min(box.z0, particles.z[i]), box.z1 = std::max(box.z1, particles.z[i]);
    }
    return box;
}

/// Water stays between the walls of the start, or is thrown a little way off: what lies farther than their
/// extent again was not written so.
void check_places(const Particles& particles, const Box& start) {
    const double reach = std::max(start.x1 - start.x0, start.z1 - start.z0);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const double x = particles.x.at(i), z = particles.z.at(i);
        const bool is_near =
            x >= start.x0 - reach && x <= start.x1 + reach && z >= start.z0 - reach && z <= start.z1 + reach;
        if (!is_near)
            throw common::InputError(
                fmt::format("/particles: particle {} at ({:g}, {:g}) m is nowhere near the scene", i, x, z));
        constexpr double most_speed = 1e5;  // m/s
        const double speed = std::hypot(particles.u.at(i), particles.w.at(i));
        if (!(speed <= most_speed))
            throw common::InputError(fmt::format("/particles: particle {} moves at {:g} m/s", i, speed));
    }
}

}  // namespace

void save(const NearField& field, common::DataFile& state) {
    const Particles& particles = field.particles;
    auto& data = state.datasets;
    const std::size_t n = particles.size();
    data["/particles/count"] = common::integer32(
        "-", {3},
        {static_cast<std::int32_t>(particles.dummies), static_cast<std::int32_t>(particles.walls),
         static_cast<std::int32_t>(particles.fluid)});
    for_each_real_array(particles, [&](const char* name, const char* unit, const std::vector<double>& array) {
        data[fmt::format("/particles/{}", name)] = common::real64(unit, {n}, array);
    });
    data["/particles/identity"] = common::integer32("-", {n}, particles.identity);
    data["/particles/body"] = common::integer32("-", {n}, particles.body);
    data["/walls/face_pressure"] = common::real64("Pa", {particles.walls}, field.face_pressure);
    const std::size_t listed = field.search.built_x().size();
    data["/lists/x"] = common::real64("m", {listed}, field.search.built_x());
    data["/lists/z"] = common::real64("m", {listed}, field.search.built_z());
    const auto step = field.step_state();
    data["/step"] = common::real64("-", {step.size()}, step);
    const StepCounts& counts = field.counts;
    data["/counts"] = common::unsigned64(
        {5}, {counts.steps, counts.iterations, counts.list_builds, counts.unconverged, counts.closed});
    for (std::size_t e = 0; e < field.effects.size(); ++e) {
        const auto values = field.effects[e]->state();
        if (!values.empty())
            data[fmt::format("/effects/{}", e)] = common::real64("-", {values.size()}, values);
    }
}

void restore(NearField& field, const common::DataFile& state) {
    Particles& particles = field.particles;
    const Box before = box_of(particles);
    const auto& count = state.at("/particles/count").integers();
    particles.dummies = static_cast<std::size_t>(count[0]);
    particles.walls = static_cast<std::size_t>(count[1]);
    particles.fluid = static_cast<std::size_t>(count[2]);
    for_each_real_array(particles, [&](const char* name, const char*, std::vector<double>& array) {
        array = state.at(fmt::format("/particles/{}", name)).doubles();
    });
    particles.identity = state.at("/particles/identity").integers();
    particles.body = state.at("/particles/body").integers();
    check_places(particles, before);
    field.face_pressure = state.at("/walls/face_pressure").doubles();
    field.search.restore(particles, state.at("/lists/x").doubles(), state.at("/lists/z").doubles());
    field.restore_step_state(state.at("/step").doubles());
    const auto& counts = state.at("/counts").words();
    field.counts = {.steps = counts[0],
                    .iterations = counts[1],
                    .list_builds = counts[2],
                    .unconverged = counts[3],
                    .closed = counts[4]};
    for (std::size_t e = 0; e < field.effects.size(); ++e) {
        const std::string name = fmt::format("/effects/{}", e);
        if (state.has(name)) field.effects[e]->restore(state.at(name).doubles());
    }
}

}  // namespace cmps
