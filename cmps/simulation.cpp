#include "cmps/simulation.hpp"

#include <algorithm>

#include "cmps/effects/relaxation_zone.hpp"
#include "cmps/effects/turbulence.hpp"
#include "cmps/effects/viscosity.hpp"
#include "cmps/initial_state.hpp"
#include "cmps/scene_geometry.hpp"
#include "cmps/snapshot.hpp"

namespace cmps {
namespace {

constexpr std::size_t steps_between_stocks = 400;  // a stock costs as much as one or two steps

}  // namespace

Simulation::Simulation(const Scene& scene, WaveField* waves, double start)
    : scene_(scene), solid_(make_solid(scene)), waves_(waves), start_(start), time_(start) {
    if (waves_) waves_->go_to(start);
    const bool starts_in_waves = waves_ && scene_.start;
    field_ = std::make_unique<NearField>(
        scene_.settings, initial_particles(scene_, solid_, starts_in_waves ? waves_ : nullptr));
    constexpr int settling_sweeps = 100;  // the spread of n beside slopes has stopped falling
    field_->settle(settling_sweeps, highest_water(scene_));
    perturb(field_->particles, scene_.settings.spacing, scene_.perturbation);
    if (scene_.has_flow) field_->path_average.emplace(scene_.flow_smoothing, field_->particles);
    compose_effects();
    watch_.emplace(scene_, solid_);
    balance_.emplace(scene_, solid_, *field_);
    output_.emplace(scene_, solid_, field_->particles);
}

template <class Kind, class... Arguments>
Kind* Simulation::add_effect(Arguments&&... arguments) {
    auto effect = std::make_unique<Kind>(std::forward<Arguments>(arguments)...);
    Kind* const added = effect.get();
    field_->effects.push_back(std::move(effect));
    return added;
}

void Simulation::compose_effects() {
    containment_ = add_effect<Containment>(solid_);
    if (scene_.drive == Drive::waves) add_offshore_boundary();
    if (scene_.drive == Drive::piston) {
        const auto path = std::make_shared<TimeTable>(scene_.piston_file, 2);
        wall_ = add_effect<MovingWall>(
            scene_.wall_at_start(),
            [path](double time, double step, double) {
                return (path->value(1, time + step) - path->value(1, time)) / step;
            },
            [this](double x) { return bottom_level(scene_, x); });
    }
    if (!scene_.gravity_file.empty())
        gravity_ = add_effect<GravityHistory>(TimeTable(scene_.gravity_file, 3));
    if (scene_.has_effect("viscosity")) add_effect<Viscosity>(scene_.viscosity);
    for (const char* const effect : {"turbulence", "overtopping_basin"})
        if (scene_.has_effect(effect)) switch_on(effect);
}

void Simulation::switch_on(const std::string& effect) {
    if (effect == "turbulence") add_effect<Turbulence>(scene_.smagorinsky);
    if (effect == "overtopping_basin")
        basin_ = add_effect<OvertoppingBasin>(rear_of_structure(scene_, solid_));
}

void Simulation::add_offshore_boundary() {
    wall_ = add_effect<MovingWall>(
        scene_.offshore,
        [this](double time, double step, double x) {
            waves_->go_to(time + 0.5 * step);
            const double taken = absorption_ ? absorption_->velocity() : 0.0;
            return returning_wall_velocity(waves_->mean_velocity(x) + taken, x - scene_.offshore,
                                           scene_.return_time);
        },
        [this](double x) { return bottom_level(scene_, x); });
    if (scene_.has_effect("absorption"))
        absorption_ = add_effect<Absorption>(*waves_, *wall_, solid_, scene_.celerity, scene_.absorption,
                                             scene_.absorption_reach());
    if (scene_.has_effect("wall_overflow"))
        overflow_ =
            add_effect<WallOverflow>(*field_, *waves_, *wall_, scene_.crest_lowering, scene_.overflow_zone());
    if (scene_.has_effect("relaxation_zone"))
        add_effect<RelaxationZone>(*waves_, *wall_, scene_.relaxation_length, scene_.relaxation_strength,
                                   scene_.return_time);
}

common::Window Simulation::advance_window(const common::WindowClock& clock, std::int64_t index,
                                          const std::function<void(double)>& on_step,
                                          const std::function<void(const std::string&)>& say) {
    const double end = clock.end_of(index);
    output_->begin(clock, index);
    while (!output_->is_complete()) {
        const double next = time_ + field_->largest_step();
        if (waves_) waves_->cover(time_, next);
        if (next >= end) {
            take_stock();
            before_crossing_ = save_state();
        }
        output_->before_step(time_, next, *field_, overtopped());
        if (field_->counts.steps % steps_between_stocks == 0) take_stock();
        if (field_->counts.steps % EffectWatch::interval == 0)
            for (const EffectChange& change : watch_->look(*field_, time_, wall_position())) {
                switch_on(change.effect);
                say(change.message);
            }
        field_->advance(time_, next - time_);
        output_->add_step(next - time_, *field_);
        time_ = next;
        output_->after_step(time_, *field_, overtopped());
        on_step(time_);
    }
    return output_->take();
}

Work Simulation::work() const {
    Work work;
    if (wall_ && scene_.drive == Drive::piston) work = work + wall_->work();
    if (gravity_) work = work + gravity_->work();
    return work;
}

void Simulation::take_stock() {
    balance_->update(*field_, wall_position(), work());
    balance_->judge(*field_, time_, containment_->returned());
}

common::DataFile Simulation::save_state() const {
    common::DataFile state;
    save(*field_, state);
    state.datasets["/run"] = common::real64("s", {2}, {start_, time_});
    if (const auto means = output_->state(); !means.empty())
        state.datasets["/pressures"] = common::real64("-", {means.size()}, means);
    const auto balance = balance_->state();
    watch_->save(state);
    state.datasets["/balance"] = common::real64("-", {balance.size()}, balance);
    return state;
}

void Simulation::restore(const common::DataFile& state) {
    watch_->restore(state);
    for (const std::string& effect : watch_->switched_on()) switch_on(effect);
    cmps::restore(*field_, state);
    time_ = state.at("/run").doubles().at(1);
    steps_before_ = field_->counts.steps;
    if (state.has("/pressures")) output_->restore(state.at("/pressures").doubles());
    balance_->restore(state.at("/balance").doubles());
}

void Simulation::describe(common::RunRecord& record) const {
    const NearField& field = *field_;
    const std::size_t waiting = overflow_ ? overflow_->waiting() : 0;
    watch_->describe(record);
    balance_->describe(record, field, overtopped() + waiting);
    const double count = static_cast<double>(field.particles.size()),
                 steps = static_cast<double>(field.counts.steps);
    record.set_figure("particles.fluid", static_cast<double>(field.particles.fluid));
    record.set_figure("particles.all", count);
    if (overflow_) {
        record.set_figure("particles.waiting", static_cast<double>(waiting));
        record.set_figure("particles.passed_wall", static_cast<double>(overflow_->passed()));
    }
    record.set_figure("particles.returned_from_solid", static_cast<double>(containment_->returned()));
    record.set_figure("particles.overtopped", static_cast<double>(overtopped()));
    record.set_figure("overtopped_volume",
                      static_cast<double>(overtopped()) * scene_.settings.spacing * scene_.settings.spacing);
    record.set_figure("start_time", start_);
    record.set_figure("steps", steps);
    if (steps > 0)
        record.set_figure("iterations_per_step", static_cast<double>(field.counts.iterations) / steps);
    if (const std::size_t timed = field.counts.steps - steps_before_; timed > 0) {
        const PhaseSeconds& s = field.seconds;
        const double total = s.neighbours + s.geometry + s.assembly + s.solve + s.gradient + s.motion;
        record.set_figure("nanoseconds_per_particle_step", total / static_cast<double>(timed) / count * 1e9);
    }
}

}  // namespace cmps
