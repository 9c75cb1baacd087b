#include "boussinesq/build_simulation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "boussinesq/effects/friction.hpp"
#include "boussinesq/effects/relaxation_zone.hpp"
#include "boussinesq/waves/permanent_wave.hpp"
#include "boussinesq/waves/solitary_wave.hpp"
#include "common/perturbation.hpp"

namespace boussinesq {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

/// Rounds elevations otherwise, by up to 1e-14 of each: still water stays as still as it was.
void perturb(std::span<double> elevation, std::int64_t seed) {
    if (seed == 0) return;
    for (std::size_t i = 0; i < elevation.size(); ++i)
        elevation[i] *= 1.0 + 1e-14 * common::perturbation(seed, i);
}

/// Waves whose elevation is rounded otherwise, at every place always in the same way.
class PerturbedWave : public IncidentWave {
 public:
    PerturbedWave(std::unique_ptr<IncidentWave> wave, std::int64_t seed)
        : wave_(std::move(wave)), seed_(seed) {}
    void at(double t, std::span<const double> x, std::span<double> elevation,
            std::span<double> velocity) const override {
        wave_->at(t, x, elevation, velocity);
        perturb(elevation, seed_);
    }

 private:
    std::unique_ptr<IncidentWave> wave_;
    std::int64_t seed_;
};

/// Still water, with [initial] or a solitary wave in it.
WaveState initial_state(const Scene& scene, const Bed& bed) {
    const Grid& grid = scene.grid;
    WaveState state(grid);
    std::vector<double> x(grid.cells), elevation(grid.cells, 0.0), velocity(grid.cells, 0.0);
    for (std::size_t i = 0; i < grid.cells; ++i) x[i] = grid.centre(i);
    const WaveSection& waves = scene.waves;
    if (waves.kind == WaveKind::solitary) {
        SolitaryWave(scene.terms.dispersion ? scene.flow.alpha : 1.0, waves.height, waves.depth,
                     waves.position)
            .at(0.0, x, elevation, velocity);
    } else if (!waves.initial_x.empty()) {
        std::size_t row = 0;
        for (std::size_t i = 0; i < grid.cells; ++i) {
            while (row + 2 < waves.initial_x.size() && waves.initial_x[row + 1] < x[i]) ++row;
            const double share =
                (x[i] - waves.initial_x[row]) / (waves.initial_x[row + 1] - waves.initial_x[row]);
            elevation[i] = waves.initial_elevation[row] +
                           share * (waves.initial_elevation[row + 1] - waves.initial_elevation[row]);
            if (!waves.initial_velocity.empty())
                velocity[i] = waves.initial_velocity[row] +
                              share * (waves.initial_velocity[row + 1] - waves.initial_velocity[row]);
        }
    }
    perturb(elevation, scene.perturbation);
    for (std::size_t i = 0; i < grid.cells; ++i) {
        const std::size_t k = i + ghost_cells;
        state.depth[k] = std::max(elevation[i] - bed.level(k), 0.0);
        state.discharge[k] = state.depth[k] * velocity[i];
    }
    return state;
}

std::unique_ptr<IncidentWave> incident_wave(const Scene& scene) {
    const WaveSection& waves = scene.waves;
    const LinearDispersion dispersion{.alpha = scene.flow.alpha, .is_dispersive = scene.terms.dispersion};
    switch (waves.kind) {
        case WaveKind::regular:
            if (scene.terms.dispersion)
                return std::make_unique<RegularWave>(
                    permanent_form(scene.flow.alpha, waves.height, waves.period, waves.depth),
                    waves.position);
            else {  // shallow water carries no wave of permanent form: the linear one
                const double w = two_pi / waves.period, k = dispersion.wave_number(w, waves.depth);
                const double quarter = -0.5 * std::numbers::pi;
                return std::make_unique<ComponentWave>(
                    std::vector<WaveComponent>{
                        {.angular_frequency = w,
                         .wave_number = k,
                         .elevation_amplitude = 0.5 * waves.height,
                         .elevation_phase = quarter + 0.5 * std::numbers::pi,
                         .velocity_amplitude = 0.5 * waves.height * w / (k * waves.depth),
                         .velocity_phase = 0.0}},
                    waves.position, waves.period / 100.0);
            }
        case WaveKind::irregular: {
            auto components = sea_components(waves.sea, dispersion, waves.depth);
            std::optional<BoundWaves> bound;
            if (waves.has_bound_waves) {
                std::vector<double> wave_numbers, amplitudes;
                for (const WaveComponent& c : components) {
                    wave_numbers.push_back(c.wave_number);
                    amplitudes.push_back(c.elevation_amplitude);
                }
                bound = bound_waves(dispersion, waves.depth, wave_numbers, amplitudes);
            }
            return std::make_unique<ComponentWave>(std::move(components), waves.position,
                                                   waves.period / 100.0, std::move(bound));
        }
        case WaveKind::series: {
            const double begin = scene.grid.offshore_end - waves.position;
            const WaveDuration duration = record_duration(
                waves.record, begin, begin + scene.generation_length, waves.period, dispersion, waves.depth);
            // As long as the record is anywhere in the zone: its repetition has not begun by then.
            return std::make_unique<ComponentWave>(
                record_components(waves.record, duration.end - duration.begin, dispersion, waves.depth),
                waves.position, waves.period / 100.0, std::nullopt, duration);
        }
        case WaveKind::none:
        case WaveKind::solitary:
            break;
    }
    return nullptr;
}

std::vector<std::unique_ptr<StepEffect>> effects_of(const Scene& scene, const Bed& bed) {
    const Grid& grid = scene.grid;
    std::vector<std::unique_ptr<StepEffect>> effects;
    if (scene.has_friction)
        effects.push_back(std::make_unique<Friction>(grid, scene.friction, scene.friction_is_manning,
                                                     scene.flow.dry_depth));
    // Fast against the wave at the flume's end, slow where the zone begins (rates in README).
    const double rate = scene.waves.period > 0 ? 1.3 * two_pi / scene.waves.period
                                               : 5.0 * std::sqrt(gravity * scene.waves.depth) /
                                                     std::max(scene.offshore_sponge, scene.shoreward_sponge);
    auto wave = incident_wave(scene);
    if (wave && scene.perturbation != 0)
        wave = std::make_unique<PerturbedWave>(std::move(wave), scene.perturbation);
    if (wave)
        effects.push_back(std::make_unique<GenerationZone>(
            grid, bed,
            cubic_rates(grid, grid.offshore_end + scene.generation_length, grid.offshore_end, 5.0 * rate),
            std::move(wave), scene.waves.ramp));
    if (scene.offshore_sponge > 0)
        effects.push_back(std::make_unique<Sponge>(
            cubic_rates(grid, grid.offshore_end + scene.offshore_sponge, grid.offshore_end, rate)));
    if (scene.shoreward_sponge > 0)
        effects.push_back(std::make_unique<Sponge>(
            cubic_rates(grid, grid.shoreward_end() - scene.shoreward_sponge, grid.shoreward_end(), rate)));
    return effects;
}

}  // namespace

Simulation build_simulation(const Scene& scene) {
    Bed bed(scene.grid, scene.bed);
    WaveState state = initial_state(scene, bed);
    auto effects = effects_of(scene, bed);
    Simulation simulation(scene.grid, std::move(bed), scene.flow, scene.terms, scene.courant,
                          std::move(state), std::move(effects));
    if (scene.has_breaking) add_breaking(simulation, scene);
    return simulation;
}

std::size_t first_breaking_cell(const Scene& scene) {
    return ghost_cells + 1 + scene.grid.cell_at(scene.grid.offshore_end + scene.generation_length);
}

void add_breaking(Simulation& simulation, const Scene& scene) {
    const std::size_t first = first_breaking_cell(scene);
    if (scene.breaks_as_bores) {
        auto bores = std::make_unique<HydrostaticBores>(scene.grid, simulation.bed(), scene.flow, first);
        simulation.flow().set_bores(bores->bores().cells());
        simulation.add_effect(std::move(bores));
    } else {
        auto viscosity =
            std::make_unique<EddyViscosity>(scene.grid, simulation.bed(), scene.flow, first, scene.breaking);
        if (scene.breaking.becomes_bore) simulation.flow().set_bores(viscosity->bores().cells());
        simulation.add_effect(std::move(viscosity));
    }
}

double shoreline_margin(const Scene& scene) {
    double least = scene.waves.depth;
    for (const auto& point : scene.bed) least = std::min(least, -point[1]);
    return std::max(0.1 * least, 100.0 * scene.flow.dry_depth);
}

}  // namespace boussinesq
