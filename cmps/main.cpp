/// cmps: the near field at the structure, with corrected moving particles (2D, free surface).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <stdexcept>

#include "cmps/effect_rules.hpp"
#include "cmps/expected_error.hpp"
#include "cmps/forecast.hpp"
#include "cmps/scene.hpp"
#include "cmps/scene_checks.hpp"
#include "cmps/scene_geometry.hpp"
#include "cmps/simulation.hpp"
#include "cmps/wave_sampling.hpp"
#include "common/check_report.hpp"
#include "common/errors.hpp"
#include "common/input_scene.hpp"
#include "common/output_folder.hpp"
#include "common/parallel.hpp"
#include "common/progress.hpp"
#include "common/run_record.hpp"
#include "common/stage_command.hpp"
#include "common/window_channel.hpp"

namespace {

const std::vector<common::ExpectedDataset> wave_datasets = {{"/time", "s", {"nt"}},
                                                            {"/x", "m", {"nx"}},
                                                            {"/still_water_depth", "m", {"nx"}},
                                                            {"/surface_elevation", "m", {"nt", "nx"}},
                                                            {"/velocity", "m/s", {"nt", "nx"}}};

/// Time at which the near field starts, s.
double start_time(const cmps::Scene& scene, cmps::WaveField* waves) {
    if (scene.start) return *scene.start;
    if (!waves || !scene.has_effect("start_at_arrival")) return 0.0;
    const double arrival = waves->arrival(scene.offshore, scene.arrival_threshold, 0.0);
    if (arrival < 0)
        throw common::InputError(fmt::format(
            "the waves never reach cmps.offshore = {:g} m: |surface elevation| stays below {:g} m",
            scene.offshore, scene.arrival_threshold));
    // On a grid of its own, so that the start, and every step after it, does not depend on the window length.
    constexpr double grain = 0.5;  // s: rounds down, and costs no more than that much of still water
    // Half a second ahead (in 0.4 m of water): what comes before the threshold is passed moves water too.
    const double ahead = 0.5 * scene.froude_time();
    return std::max(0.0, std::floor((arrival - ahead) / grain) * grain);
}

/// The waves that drive a run, opened and judged.
struct Upstream {
    common::WindowReader reader;
    std::string without_record;  // what to tell of windows made by hand
    cmps::WaveField waves;
    std::string coarse;  // what to tell of windows that lose more of the waves than they should

    /// How far the wall may come off its place with the waves still known there, m: a breaking wave moves
    /// water by half a depth each way.
    static double play(const cmps::Scene& scene) { return 1.25 * scene.settings.depth; }
    /// How far behind the wall the waves are needed, m; all over the near field when it starts in waves.
    static double reach(const cmps::Scene& scene) {
        if (scene.start) return scene.onshore - scene.offshore;
        double ahead = scene.has_effect("relaxation_zone") ? scene.relaxation_length : 0.0;
        if (scene.has_effect("absorption")) ahead = std::max(ahead, scene.absorption_reach());
        if (scene.has_effect("wall_overflow")) ahead = std::max(ahead, scene.overflow_zone());
        return play(scene) + ahead;
    }
    Upstream(const common::StageCommand& command, const common::SceneFile& file, const cmps::Scene& scene)
        : reader(command.upstream, "boussinesq", wave_datasets, command.follow),
          without_record(common::require_same_scene(file, command.upstream, reader.first().scene_digest)),
          waves(reader, scene.offshore - play(scene), scene.offshore + reach(scene), scene.time.end) {
        waves.check_depth([&](double x) { return -cmps::bottom_level(scene, x); });
        const cmps::SamplingVerdict sampling =
            cmps::judge_sampling(scene, common::Interpolation::cubic_slopes, waves.sample_interval());
        if (!sampling.text.empty())
            coarse = fmt::format("{}: samples every {} (boussinesq.output_interval)",
                                 command.upstream.string(), sampling.text);
        if (sampling.is_refused) throw common::InputError(coarse);
        if (!command.follow && reader.available_until() < scene.time.end - 1e-9)
            throw common::InputError(
                fmt::format("{}: the wave windows end at t = {:g} s, before time.end = {:g} s",
                            command.upstream.string(), reader.available_until(), scene.time.end));
    }
};

void check_start(double start, const cmps::Scene& scene) {
    if (start >= scene.time.end)
        throw common::InputError(fmt::format(
            "time.end = {:g} s lies before the near field starts, t = {:g} s", scene.time.end, start));
}

void check_water(const cmps::Scene& scene) {
    if (cmps::initial_particles(scene, cmps::make_solid(scene), nullptr).fluid == 0)
        throw common::InputError(
            fmt::format("there is no water: nothing of cmps.water is as wide as cmps.particle_spacing = {:g} "
                        "m and outside "
                        "the structure",
                        scene.settings.spacing));
}

int check(const common::StageCommand& command, const common::SceneFile& file, const cmps::Scene& scene) {
    if (command.all) {
        std::cout << file.reference();
        return common::exit_done;
    }
    check_water(scene);
    double start = -1;
    std::string coarse;
    if (!command.upstream.empty() && scene.drive == cmps::Drive::waves) {
        Upstream upstream(command, file, scene);
        start = start_time(scene, &upstream.waves);
        check_start(start, scene);
        coarse = upstream.coarse;
    }
    const cmps::Forecast forecast = cmps::make_forecast(scene, start);
    const bool start_is_guess = start < 0 && !scene.start && forecast.start > 0;
    std::vector<common::ForecastLine> lines = {
        {"particles", fmt::format("{} in the water, {} in walls; spacing {:.4g} m", forecast.fluid,
                                  forecast.boundary, scene.settings.spacing)}};
    if (forecast.start >= scene.time.end) {  // a guess: of waves that are there the run itself is refused
        lines.push_back(
            {"time", fmt::format("nothing to simulate: waves reach cmps.offshore = {:g} m at about "
                                 "{:.1f} s, after time.end = {:g} s; --waves says when exactly",
                                 scene.offshore, forecast.start, scene.time.end)});
    } else {
        lines.push_back({"time", fmt::format("from {}{:.1f} s to {:g} s", start_is_guess ? "about " : "",
                                             forecast.start, scene.time.end)});
        lines.push_back({"steps", fmt::format("about {:.0f} of {:.2g} s", forecast.steps, forecast.step)});
        lines.push_back({"run time", fmt::format("about {} on this machine, one thread",
                                                 common::run_time_text(forecast.seconds))});
    }
    lines.push_back({"memory", fmt::format("about {:.0f} MB", forecast.memory / 1e6)});
    lines.push_back({"error", cmps::expected_error_text(scene.settings.depth / scene.settings.spacing,
                                                        scene.settings.kernel_radius_ratio)});
    for (const cmps::Remark& remark : scene.remarks) lines.push_back({"note", remark.text});
    if (!coarse.empty()) lines.push_back({"note", coarse});
    common::print_check_report(scene.effects, lines);
    return common::exit_done;
}

void restore(cmps::Simulation& simulation, const common::OutputFolder& folder) {
    const auto refuse = [&](const std::string& what) {
        throw common::InputError(
            fmt::format("{}: {}: it is damaged, or another version of cmps wrote it; without --resume the "
                        "run begins anew",
                        (folder.path() / "state.h5").string(), what));
    };
    try {
        simulation.restore(folder.state());
    } catch (const common::InputError& error) {
        refuse(error.what());
    } catch (const std::out_of_range&) {
        refuse("a dataset has fewer values than are needed");
    }
}

int run(const common::StageCommand& command, const common::SceneFile& file, const cmps::Scene& scene) {
    std::optional<Upstream> upstream;
    std::string upstream_digest;
    if (scene.drive == cmps::Drive::waves) {
        if (command.upstream.empty())
            throw common::InputError("cmps run: --waves DIR is needed, for cmps.drive = \"waves\"");
        upstream.emplace(command, file, scene);
        upstream_digest = upstream->reader.first().scene_digest;
    }
    cmps::WaveField* const waves = upstream ? &upstream->waves : nullptr;
    // whatever can be wrong is found before an earlier run's windows make room; waves that are still being
    // made cannot be judged yet
    if (!command.follow) check_start(start_time(scene, waves), scene);
    check_water(scene);
    common::OutputFolder folder(command.out, {"cmps", file.digest(upstream_digest), upstream_digest},
                                command.resume);
    if (folder.start() == common::OutputFolder::Start::nothing_to_do) return common::exit_done;
    const bool goes_on = folder.start() == common::OutputFolder::Start::go_on;
    const double start = goes_on ? folder.state().at("/run").doubles()[0] : start_time(scene, waves);
    check_start(start, scene);
    if (waves) waves->cover(start, start);

    common::RunRecord record(command.out, "cmps");
    record.describe_scene(file);
    record.set_digests(file.digest(upstream_digest), upstream_digest);
    record.set_effects(scene.effects);
    if (upstream) record.describe_input(command.upstream);
    cmps::Simulation simulation(scene, waves, start);
    if (goes_on)
        restore(simulation, folder);
    else
        folder.write_geometry(simulation.geometry());

    const common::WindowClock clock(start, scene.time.end, scene.time.window);
    common::Progress progress("cmps", start, scene.time.end, command.quiet);
    if (upstream && !upstream->without_record.empty()) {
        record.set_note("input", upstream->without_record);
        if (!goes_on) progress.say(upstream->without_record);
    }
    if (upstream && !upstream->coarse.empty()) {
        record.set_note("waves.sampling", upstream->coarse);
        if (!goes_on) progress.say(upstream->coarse);
    }
    for (const cmps::Remark& remark : scene.remarks) {
        record.set_note(remark.name, remark.text);
        if (!goes_on) progress.say(remark.text);
    }
    record.set_windows(folder.next_window());
    record.write_running();
    try {
        for (std::int64_t index = folder.next_window(); index < clock.window_count(); ++index) {
            common::Window window = simulation.advance_window(
                clock, index,
                [&](double time) {
                    progress.update(time, fmt::format("{} particles", simulation.field().particles.fluid));
                    common::check_for_interrupt();
                },
                [&](const std::string& message) {
                    progress.say(message);
                    simulation.describe(record);
                    record.write_running();
                });
            folder.publish(std::move(window), simulation.state());
            record.add_window();
            simulation.describe(record);
            record.write_running();
        }
    } catch (const common::Interrupted&) {
        record.write_ended("interrupted");
        throw;
    } catch (const std::exception& error) {
        simulation.describe(record);
        record.write_ended("failed", error.what());
        throw;
    }
    const cmps::PhaseSeconds& seconds = simulation.field().seconds;
    record.add_phase_time("neighbours", seconds.neighbours);
    record.add_phase_time("geometry", seconds.geometry);
    record.add_phase_time("assembly", seconds.assembly);
    record.add_phase_time("pressure solve", seconds.solve);
    record.add_phase_time("gradient", seconds.gradient);
    record.add_phase_time("motion", seconds.motion);
    for (const auto& effect : simulation.field().effects)
        record.add_phase_time(effect->name(), effect->seconds);
    record.write_ended("done");
    progress.finish(fmt::format("{} steps", simulation.field().counts.steps));
    return common::exit_done;
}

}  // namespace

int main(int argc, char** argv) {
    return common::run_guarded("cmps", [&] {
        const auto command = common::read_stage_command(
            argc, argv,
            {.program = "cmps",
             .description = "near field at the structure: corrected moving particles",
             .upstream_option = "--waves"});
        common::use_threads(command.threads);
        const auto file = common::SceneFile::read(command.scene, command.overrides);
        cmps::Scene scene = cmps::read_scene(file);
        cmps::decide_effects(file, scene);
        if (!file.has_problems()) cmps::check_water_at_gauges(file, scene);
        file.finish();
        if (command.verb == common::StageCommand::Verb::check) return check(command, file, scene);
        return run(command, file, scene);
    });
}
