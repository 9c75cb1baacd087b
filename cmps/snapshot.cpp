#include "cmps/snapshot.hpp"

#include <fmt/format.h>

#include <utility>

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
    const auto& count = state.at("/particles/count").integers();
    particles.dummies = static_cast<std::size_t>(count[0]);
    particles.walls = static_cast<std::size_t>(count[1]);
    particles.fluid = static_cast<std::size_t>(count[2]);
    for_each_real_array(particles, [&](const char* name, const char*, std::vector<double>& array) {
        array = state.at(fmt::format("/particles/{}", name)).doubles();
    });
    particles.identity = state.at("/particles/identity").integers();
    particles.body = state.at("/particles/body").integers();
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
