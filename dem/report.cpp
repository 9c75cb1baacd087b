#include "dem/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/errors.hpp"
#include "dem/damage.hpp"

namespace dem {

namespace {

const std::string warning_key = "warning ";  // of state.h5, before the name of the warning

}  // namespace

Report::Report(const std::filesystem::path& folder, const common::SceneFile& file, const Scene& scene,
               const std::string& scene_digest, const std::string& input_digest)
    : record_(folder, "dem"), scene_(scene), smallest_limit_(std::numeric_limits<double>::infinity()) {
    record_.describe_scene(file);
    record_.set_digests(scene_digest, input_digest);
    record_.set_effects(scene.effects.records);
    record_.set_figure("blocks", static_cast<double>(scene.placed.size()));
    record_.set_figure("time_step", scene.step.time_step);
    record_.write_running();
}

void Report::add_time(const std::string& phase, double seconds) {
    record_.add_phase_time(phase, seconds);
    if (phase == "steps") stepping_seconds_ += seconds;
}

void Report::begin_books(const Simulation& simulation) {
    first_energy_ = simulation.energy();
    first_block_steps_ = simulation.awake_block_steps();
}

double exchanged_energy(const EnergyBudget& energy, const EnergyBudget& first, double trifle) {
    return std::max(trifle, std::abs(energy.dissipated - first.dissipated) + energy.gross_water_work -
                                first.gross_water_work + std::max(energy.largest_kinetic, first.kinetic) +
                                first.contacts + first.wires);
}

double trifling_energy(const Scene& scene, const EnergyBudget& energy) {
    // A contact of two elements holds so much at an overlap of 1e-6 d: far below what puts a block to sleep.
    const double d = scene.element.diameter, springs = 1e-15 * scene.material.young_modulus * d * d * d;
    constexpr double rounding = 1e-13;  // of sums over 1e3 terms
    return std::max(springs, rounding * (std::abs(energy.potential) + std::abs(energy.water_work)));
}

double closure_error(const EnergyBudget& energy, const EnergyBudget& first, double trifle) {
    const double exchanged = exchanged_energy(energy, first, trifle);
    return exchanged > 0 ? (energy.balance() - first.balance()) / exchanged : 0;
}

void Report::look(const Simulation& simulation) {
    // Sleepers are not stepped; those that were never awake at a look are judged once.
    const auto [limit, set_by] = simulation.step_limit(std::isinf(smallest_limit_));
    smallest_limit_ = std::min(smallest_limit_, limit);
    // A hit lowers the limit for an instant; a bed that stays past it trembles for ever.
    past_limit_ = simulation.rules().time_step > time_step_margin * limit ? past_limit_ + 1 : 0;
    if (past_limit_ >= 2)
        throw common::RunError(
            fmt::format("t = {:.5f} s: the time step of {:.2g} s is past the limit of {:.2g} s that {}; "
                        "shorten dem.time_step",
                        simulation.time(), simulation.rules().time_step, limit, set_by));
    const EnergyBudget energy = simulation.energy();
    const double trifle = trifling_energy(scene_, energy),
                 error = closure_error(energy, first_energy_, trifle),
                 dissipated = energy.dissipated - first_energy_.dissipated;
    // Contacts take energy, they never give any; and a balance a third off is no error of a usable step.
    if (dissipated < -0.1 * (exchanged_energy(energy, first_energy_, trifle) - std::abs(dissipated)) ||
        std::abs(error) > 1.0 / 3)
        throw common::RunError(
            fmt::format("t = {:.5f} s: the energy budget does not close ({:.2g} J dissipated, balance off by "
                        "{:.2g} of what was exchanged); "
                        "shorten dem.time_step",
                        simulation.time(), dissipated, error));
}

void Report::window_done(const Simulation& simulation, const PackedPoses& packed, std::int64_t windows) {
    const EnergyBudget energy = simulation.energy();
    const auto moved = displacements(simulation.blocks, packed.position, packed.orientation);
    const Damage damage = assess_damage(simulation.blocks, moved, scene_.width);
    const double d = scene_.element.diameter;
    record_.set_windows(windows);
    record_.set_invariant(
        {"energy_closure", closure_error(energy, first_energy_, trifling_energy(scene_, energy)), "-", 0.1});
    record_.set_invariant(
        {"largest_overlap", simulation.largest_overlap() / d, "d", scene_.step.overlap_limit / d});
    record_.set_figure("deep_contact_steps", static_cast<double>(simulation.deep_contact_steps()));
    record_.set_figure("time_step_limit", smallest_limit_);
    record_.set_figure("steps", static_cast<double>(simulation.steps()));
    record_.set_figure("contacts", static_cast<double>(simulation.pair_list().contact_count()));
    if (simulation.awake_block_steps() > 0)
        record_.set_figure("nanoseconds_per_awake_block_step",
                           1e9 * stepping_seconds_ /
                               static_cast<double>(simulation.awake_block_steps() - first_block_steps_));
    record_.set_figure("awake_block_steps", static_cast<double>(simulation.awake_block_steps()));
    record_.set_figure("blocks_asleep", static_cast<double>(simulation.asleep_count()));
    record_.set_figure("energy.kinetic", energy.kinetic);
    record_.set_figure("energy.potential", energy.potential);
    record_.set_figure("energy.contacts", energy.contacts);
    record_.set_figure("energy.wires", energy.wires);
    record_.set_figure("energy.dissipated", energy.dissipated);
    record_.set_figure("energy.water_work", energy.water_work);
    record_.set_figure("damage.free_blocks", static_cast<double>(damage.free_blocks));
    record_.set_figure("damage.beyond_quarter_length", static_cast<double>(damage.moved[0]));
    record_.set_figure("damage.beyond_half_length", static_cast<double>(damage.moved[1]));
    record_.set_figure("damage.beyond_length", static_cast<double>(damage.moved[2]));
    record_.set_figure("damage.number", damage.number);
    record_.set_figure("damage.mean_displacement", damage.mean_displacement);
    record_.set_figure("damage.mean_offshore", damage.mean_offshore);
    record_.set_figure("damage.largest_displacement", damage.largest_displacement);
    // The clock of the whole chain, and that of the paper, which starts when waves reach the blocks.
    record_.set_figure("clock.end", simulation.time());
    if (simulation.water() != nullptr && simulation.water()->waves_reach_blocks >= 0)
        record_.set_figure("clock.waves_reach_blocks", simulation.water()->waves_reach_blocks);
    const Wires& wires = simulation.wires;
    record_.set_figure("wires.count", static_cast<double>(wires.size()));
    record_.set_figure("wires.broken", static_cast<double>(wires.size() - wires.intact_count()));
    if (wires.size() > 0 && std::isfinite(wires.longest_stretch))
        record_.set_figure("wires.largest_share_of_breaking", wires.largest_share_of_breaking());
    record_.set_figure("wires.largest_tension",
                       wires.size() > 0
                           ? *std::max_element(wires.largest_tension.begin(), wires.largest_tension.end())
                           : 0.0);
    record_.write_running();
}

void Report::warn(const std::string& name, const std::string& message) {
    fmt::print(stderr, "dem: warning: {}\n", message);
    keep_warning(name, message);
}

void Report::say(const std::string& name, const std::string& message) {
    fmt::print(stderr, "dem: {}\n", message);
    record_.set_note(name, message);
}

void Report::keep_warning(const std::string& name, const std::string& message) {
    warnings_[name] = message;
    record_.set_note(name, message);
}

void Report::began_calm(const CalmRecord& record) {
    calm_ = record;
    record_.set_figure("restart.settling_time", record.settling);
    if (scene_.wires.put_back.empty()) return;
    record_.set_figure("put_back.blocks", static_cast<double>(record.blocks));
    record_.set_figure("put_back.mean_distance_placed", record.mean_placed);
    record_.set_figure("put_back.largest_distance_placed", record.largest_placed);
    record_.set_figure("put_back.mean_distance_settled", record.mean_settled);
    record_.set_figure("put_back.largest_distance_settled", record.largest_settled);
}

void Report::store(common::DataFile& state) const {
    for (const auto& [name, message] : warnings_) state.attributes[warning_key + name] = message;
    if (calm_)
        state.datasets["/calm"] =
            common::real64("-, m, m, m, m, s", {6},
                           {static_cast<double>(calm_->blocks), calm_->mean_placed, calm_->largest_placed,
                            calm_->mean_settled, calm_->largest_settled, calm_->settling});
    state.attributes["first_kinetic"] = first_energy_.kinetic;
    state.attributes["first_potential"] = first_energy_.potential;
    state.attributes["first_contacts"] = first_energy_.contacts;
    state.attributes["first_wires"] = first_energy_.wires;
    state.attributes["first_dissipated"] = first_energy_.dissipated;
    state.attributes["first_water_work"] = first_energy_.water_work;
    state.attributes["first_gross_water_work"] = first_energy_.gross_water_work;
    state.attributes["smallest_limit"] = smallest_limit_;
    state.attributes["past_limit"] = static_cast<std::int64_t>(past_limit_);
}

void Report::restore(const common::DataFile& state) {
    first_energy_ = {.kinetic = state.number("first_kinetic"),
                     .potential = state.number("first_potential"),
                     .contacts = state.number("first_contacts"),
                     .wires = state.number("first_wires"),
                     .dissipated = state.number("first_dissipated"),
                     .water_work = state.number("first_water_work"),
                     .gross_water_work = state.number("first_gross_water_work")};
    smallest_limit_ = state.number("smallest_limit");
    past_limit_ = static_cast<int>(state.integer("past_limit"));
    for (const auto& [key, value] : state.attributes)
        if (key.starts_with(warning_key)) keep_warning(key.substr(warning_key.size()), state.text(key));
    if (state.has("/calm")) {
        const auto& kept = state.at("/calm").doubles();
        began_calm({static_cast<std::size_t>(kept.at(0)), kept.at(1), kept.at(2), kept.at(3), kept.at(4),
                    kept.at(5)});
    }
    first_block_steps_ = static_cast<std::uint64_t>(state.integer("awake_block_steps"));
}

void Report::end(const std::string& status, const std::string& message) {
    record_.write_ended(status, message);
}

}  // namespace dem
