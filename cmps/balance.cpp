#include "cmps/balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "cmps/gauges.hpp"
#include "cmps/scene_geometry.hpp"
#include "common/errors.hpp"

namespace cmps {

Balance::Balance(const Scene& scene, const Solid& solid, const NearField& field)
    : scene_(scene), solid_(solid), initial_fluid_(field.particles.fluid), initial_energy_(energy(field)) {
    if (!scene_.water.empty()) initial_area_ = initial_area(scene_, solid_, nullptr);
    if (scene_.water.empty())
        initial_volume_ =
            volume_by_surface(field.particles, solid_, scene_.settings.spacing, scene_.wall_at_start(),
                              end_of_water(scene_, solid_), lowest_bottom(scene_));
}

/// Kinetic and potential energy of the water, J per m of width, against its lowest place: water that leaves
/// takes some with it. Gravity from a table has no potential, its work is counted.
double Balance::energy(const NearField& field) const {
    const Particles& particles = field.particles;
    Settings settings = scene_.settings;
    if (!scene_.gravity_file.empty()) settings.gravity_x = settings.gravity_z = 0;
    const double lowest_x = settings.gravity_x > 0 ? scene_.onshore : scene_.offshore,
                 lowest_z = lowest_bottom(scene_);
    double sum = 0;
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
        sum += 0.5 * (particles.u[i] * particles.u[i] + particles.w[i] * particles.w[i]) -
               settings.gravity_x * (particles.x[i] - lowest_x) -
               settings.gravity_z * (particles.z[i] - lowest_z);
    return settings.pressure.density * settings.spacing * settings.spacing * sum;
}

/// Potential energy of the water standing at its depth, J per m of width.
double Balance::energy_scale() const {
    const Settings& settings = scene_.settings;
    const double weight = std::hypot(settings.gravity_x, settings.gravity_z);
    const double g = weight > 0 ? weight : 9.81;  // water that weighs nothing is measured as if it did
    return 0.5 * settings.pressure.density * g * settings.depth * settings.spacing * settings.spacing *
           static_cast<double>(initial_fluid_);
}

/// Volume is that of the surface profile, against the particles that stand in its reach: what compression or
/// voids have cost. Water that has gone over the structure is beyond it.
void Balance::update(const NearField& field, double wall, const Work& work) {
    const Particles& particles = field.particles;
    in_solid_ = 0, outside_ = 0;
    const double l0 = scene_.settings.spacing, bottom = lowest_bottom(scene_) - l0;
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
        in_solid_ += solid_.contains(particles.x[i], particles.z[i]),
            outside_ +=
            particles.x[i] < wall - l0 || particles.x[i] > scene_.onshore + l0 || particles.z[i] < bottom;
    const Settings& settings = scene_.settings;
    const double scale = energy_scale();
    work_ = {work.net / scale, work.gross / scale};
    energy_gain_ = (energy(field) - initial_energy_ - work.net) / scale;
    largest_energy_gain_ = std::max(largest_energy_gain_, energy_gain_);
    lowest_energy_gain_ = std::min(lowest_energy_gain_, energy_gain_);
    largest_energy_regain_ = std::max(largest_energy_regain_, energy_gain_ - lowest_energy_gain_);
    if (initial_volume_ <= 0) return;
    const double end = end_of_water(scene_, solid_);
    const double volume =
        volume_by_surface(particles, solid_, settings.spacing, wall, end, lowest_bottom(scene_));
    const auto beyond =
        std::count_if(particles.x.begin() + static_cast<std::ptrdiff_t>(particles.first_fluid()),
                      particles.x.end(), [&](double x) { return x > end; });
    const double expected = initial_volume_ *
                            (static_cast<double>(particles.fluid) - static_cast<double>(beyond)) /
                            static_cast<double>(initial_fluid_);
    volume_drift_ = volume / expected - 1.0;
    largest_volume_drift_ = std::max(largest_volume_drift_, std::abs(volume_drift_));
}

void Balance::judge(const NearField& field, double time, std::size_t returned) const {
    const auto stop = [&](const std::string& what) {
        throw common::RunError(fmt::format("unstable at t = {:.4f} s: {}", time, what));
    };
    const double steps = static_cast<double>(field.counts.steps), fluid = static_cast<double>(initial_fluid_);
    // no solve of any good run has failed to converge
    constexpr std::size_t few_solves = 5;
    constexpr double most_unconverged = 0.01;  // of all
    if (field.counts.unconverged > few_solves &&
        static_cast<double>(field.counts.unconverged) > most_unconverged * steps)
        stop(fmt::format("{} of {} pressure solves did not converge, bound {:.0f}", field.counts.unconverged,
                         field.counts.steps, std::max<double>(few_solves, most_unconverged * steps)));
    // eight particles over the depth under a solitary wave: 0.09
    constexpr double most_drift = 0.2;
    if (initial_volume_ > 0 && std::abs(volume_drift_) > most_drift)
        stop(fmt::format("the water's volume is off by {:+.0f} %, bound {:.0f} %", 100 * volume_drift_,
                         100 * most_drift));
    // What no work explains: friction and breaking only take energy away, so that what counts is the rise
    // from the least there was. Good runs rise by 0.02 at most, in tanks full to the lid; those that are
    // shaken and pistons at up to half the celerity by 0.04 beyond their work. A wall's pressure, and with it
    // its work, is known to a twentieth.
    constexpr double most_regain = 0.1, most_share_of_work = 0.1;
    const bool is_accounted = scene_.drive != Drive::waves && initial_fluid_ > 50 &&
                              std::hypot(scene_.settings.gravity_x, scene_.settings.gravity_z) > 0 &&
                              scene_.water_velocity.empty();
    const double regain = energy_gain_ - lowest_energy_gain_,
                 bound = most_regain + most_share_of_work * work_.gross;
    if (is_accounted && regain > bound)
        stop(work_.gross > 0
                 ? fmt::format("the water has gained {:.2f} of rho g h / 2, bound {:.2f}, beyond the work "
                               "of {:.2f} done on it",
                               regain, bound, work_.net)
                 : fmt::format("the water has gained {:.2f} of rho g h / 2, bound {:.2f}, and nothing does "
                               "work on it",
                               regain, bound));
    constexpr double most_by_waves = 1.5;  // waves of breaking height bring 0.3
    if (scene_.drive == Drive::waves && energy_gain_ > most_by_waves)
        stop(
            fmt::format("the water has gained {:.2f} of rho g h / 2, bound {:.2f}, more than waves can bring",
                        energy_gain_, most_by_waves));
    // sharp corners under impact return 2.5e-4 a particle and step, bodies too thin to hold water 8e-4 to
    // 2e-2
    constexpr std::size_t few_returned = 100;
    constexpr double most_returned = 6e-4;
    if (returned > few_returned && static_cast<double>(returned) > most_returned * steps * fluid)
        stop(
            fmt::format("particles had to be put back out of the solid {} times in {} steps of {} particles, "
                        "bound {:.0f}",
                        returned, field.counts.steps, initial_fluid_,
                        std::max<double>(few_returned, most_returned * steps * fluid)));
}

void Balance::describe(common::RunRecord& record, const NearField& field, std::size_t elsewhere) const {
    const double infinity = std::numeric_limits<double>::infinity();
    const auto missing =
        static_cast<double>(initial_fluid_) - static_cast<double>(field.particles.fluid + elsewhere) +
        static_cast<double>(outside_);  // over the moving wall, say: no part of the water any more
    record.set_invariant({"particle_ledger", missing, "particles", 0.5});
    if (initial_area_ > 0) {
        const double l0 = scene_.settings.spacing, count = static_cast<double>(initial_fluid_);
        record.set_invariant({"initial_volume", count * l0 * l0 / initial_area_ - 1.0, "-",
                              0.5 * static_cast<double>(scene_.water.size() + 1) / count});
    }
    if (initial_volume_ > 0) {
        record.set_invariant({"mass_drift", volume_drift_, "-", 0.02});
        record.set_invariant({"largest_mass_drift", largest_volume_drift_, "-", infinity});
    }
    // nothing does work on the water where no wall moves and gravity is constant
    const bool is_closed = scene_.drive == Drive::none && scene_.gravity_file.empty();
    if (work_.gross > 0) {
        record.set_figure("work.net", work_.net);
        record.set_figure("work.gross", work_.gross);
    }
    record.set_invariant({"energy_gain", energy_gain_, "of rho g h / 2", infinity});
    record.set_invariant(
        {"largest_energy_gain", largest_energy_gain_, "of rho g h / 2", is_closed ? 0.02 : infinity});
    record.set_invariant({"largest_energy_regain", largest_energy_regain_, "of rho g h / 2", infinity});
    record.set_invariant({"particles_in_solid", static_cast<double>(in_solid_), "particles", 0.5});
    // dam breaks of 3 to 30 particles over the height, steps up to 4 times the default: floor pressures leave
    // those of a fine run by more than 0.105 rho g H rms only where this is above 0.145; default steps make
    // 0.003 to 0.13. Without gravity water may move free of all pressure but that of a few steps.
    // A full box's pressure is known up to a constant.
    const bool has_weight = std::hypot(scene_.settings.gravity_x, scene_.settings.gravity_z) > 0 &&
                            2 * field.counts.closed < field.counts.steps;
    record.set_invariant({"pressure_change_per_step", field.pressure_change_per_step(), "of the pressure",
                          has_weight ? 0.145 : infinity});
    record.set_invariant(
        {"unconverged_solves", static_cast<double>(field.counts.unconverged), "-", infinity});
}

std::vector<double> Balance::state() const {
    return {static_cast<double>(initial_fluid_),
            initial_volume_,
            volume_drift_,
            largest_volume_drift_,
            initial_energy_,
            largest_energy_gain_,
            energy_gain_,
            work_.net,
            work_.gross,
            lowest_energy_gain_,
            largest_energy_regain_};
}

void Balance::restore(const std::vector<double>& state) {
    initial_fluid_ = static_cast<std::size_t>(state.at(0));
    initial_volume_ = state.at(1), volume_drift_ = state.at(2), largest_volume_drift_ = state.at(3);
    initial_energy_ = state.at(4), largest_energy_gain_ = state.at(5), energy_gain_ = state.at(6);
    work_ = {state.at(7), state.at(8)};
    lowest_energy_gain_ = state.at(9), largest_energy_regain_ = state.at(10);
}

}  // namespace cmps
