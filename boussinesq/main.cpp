/// boussinesq: one-dimensional waves over a flume, from a scene to windows.
#include <gsl/gsl_errno.h>

#include <utility>

#include "boussinesq/build_simulation.hpp"
#include "boussinesq/check.hpp"
#include "boussinesq/effect_watch.hpp"
#include "boussinesq/report.hpp"
#include "boussinesq/scene.hpp"
#include "boussinesq/window_output.hpp"
#include "common/errors.hpp"
#include "common/output_folder.hpp"
#include "common/parallel.hpp"
#include "common/progress.hpp"
#include "common/stage_command.hpp"
#include "common/window_clock.hpp"

namespace {

using namespace boussinesq;

int run(const common::StageCommand& command, const common::SceneFile& file, const Scene& scene) {
    Simulation simulation = build_simulation(scene);
    common::OutputFolder folder(command.out,
                                {.stage = "boussinesq", .scene_digest = file.digest(), .input_digest = ""},
                                command.resume);
    if (folder.start() == common::OutputFolder::Start::nothing_to_do) return common::exit_done;
    const common::WindowClock clock(0.0, scene.time.end, scene.time.window);
    WindowOutput output(simulation, clock, scene.output_interval, gauges_of(scene));
    Report report(command.out, file, scene, simulation);
    EffectWatch watch(scene);
    common::Progress progress("boussinesq", 0.0, scene.time.end, command.quiet);
    if (scene.waves.share_left_out > 0.01) progress.say(scene.waves.record_note);
    for (const std::string* note : {&scene.sponge_note, &scene.sampling_note})
        if (!note->empty()) progress.say(*note);
    const auto save = [&] {
        common::DataFile state = simulation.save();
        report.save(state);
        watch.save(state);
        return state;
    };
    const auto step = [&] {
        simulation.advance();
        report.look();
        if (const auto change = watch.look(simulation)) {
            report.note(*change);
            progress.say(change->message);
        }
    };

    const bool goes_on = folder.start() == common::OutputFolder::Start::go_on;
    if (goes_on) {
        watch.restore(simulation, folder.state());
        simulation.restore(folder.state());
        report.restore(folder.state());
        read_gauges(folder.path(), folder.next_window(), output.gauges());
    }
    folder.write_geometry(geometry_of(scene, simulation));
    try {
        // The state to go on from is the one before the step that crossed the end of the last window.
        common::DataFile before_crossing = save();
        if (goes_on) {
            simulation.next_step();
            step();
        }
        for (std::int64_t window = folder.next_window(); window < clock.window_count(); ++window) {
            output.begin(window);
            output.collect();
            while (!output.is_complete()) {
                common::check_for_interrupt();
                if (simulation.time() + simulation.next_step() >= output.end()) before_crossing = save();
                step();
                output.collect();
                progress.update(simulation.time());
            }
            // One step may cross the ends of several short windows: all go on from the state before it.
            const bool is_needed_again =
                window + 1 < clock.window_count() && simulation.time() >= clock.end_of(window + 1);
            folder.publish(output.take(),
                           is_needed_again ? before_crossing : std::exchange(before_crossing, {}));
            report.window_done(window + 1);
        }
    } catch (const common::Interrupted&) {
        report.end("interrupted", "interrupted", output.gauges());
        throw;
    } catch (const std::exception& error) {
        report.end("failed", error.what(), output.gauges());
        throw;
    }
    report.end("done", "", output.gauges());
    progress.finish(report.summary());
    return common::exit_done;
}

}  // namespace

int main(int argc, char** argv) {
    return common::run_guarded("boussinesq", [&] {
        gsl_set_error_handler_off();
        common::watch_for_interrupts();
        const auto command =
            common::read_stage_command(argc, argv,
                                       {.program = "boussinesq",
                                        .description = "waves over the flume (1D, Serre-Green-Naghdi)",
                                        .upstream_option = ""});
        common::use_threads(command.threads);
        const auto file = common::SceneFile::read(command.scene, command.overrides);
        const Scene scene = read_scene(file);
        if (command.verb == common::StageCommand::Verb::check) {
            print_check(file, scene, command.all);
            return static_cast<int>(common::exit_done);
        }
        return run(command, file, scene);
    });
}
