/// boussinesq: one-dimensional waves over a flume, from a scene to windows.
#include <gsl/gsl_errno.h>

#include "boussinesq/build_simulation.hpp"
#include "boussinesq/report.hpp"
#include "boussinesq/scene.hpp"
#include "boussinesq/window_output.hpp"
#include "common/errors.hpp"
#include "common/output_folder.hpp"
#include "common/parallel.hpp"
#include "common/progress.hpp"
#include "common/run_record.hpp"
#include "common/stage_command.hpp"
#include "common/window_clock.hpp"

namespace {

int run(const common::StageCommand& command, const common::SceneFile& file, const boussinesq::Scene& scene) {
    common::OutputFolder folder(command.out,
                                {.stage = "boussinesq", .scene_digest = file.digest(), .input_digest = ""},
                                command.resume);
    if (folder.start() == common::OutputFolder::Start::nothing_to_do) return common::exit_done;
    boussinesq::Simulation simulation = boussinesq::build_simulation(scene);
    common::WindowClock clock(0.0, scene.time.end, scene.time.window);
    boussinesq::WindowOutput output(simulation, clock, scene.output_interval, boussinesq::gauges_of(scene));
    boussinesq::Report report(command.out, file, scene, simulation);
    const bool goes_on = folder.start() == common::OutputFolder::Start::go_on;
    if (goes_on) {
        simulation.restore(folder.state());
        report.restore(folder.state());
        boussinesq::read_gauges(folder.path(), folder.next_window(), output.gauges());
    }
    // The state to go on from is the one before the step that crossed the end of the last window.
    common::DataFile before_crossing = report.save(simulation.save());
    if (goes_on) {
        simulation.next_step();
        simulation.advance();
        report.look();
    }
    folder.write_geometry(boussinesq::geometry_of(scene, simulation));
    common::Progress progress("boussinesq", 0.0, scene.time.end, command.quiet);
    try {
        for (std::int64_t window = folder.next_window(); window < clock.window_count(); ++window) {
            output.begin(window);
            output.collect();
            while (!output.is_complete()) {
                common::check_for_interrupt();
                if (simulation.time() + simulation.next_step() >= output.end())
                    before_crossing = report.save(simulation.save());
                simulation.advance();
                report.look();
                output.collect();
                progress.update(simulation.time());
            }
            folder.publish(output.take(), before_crossing);
            report.window_done(window + 1, output.gauges());
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
        const boussinesq::Scene scene = boussinesq::read_scene(file);
        if (command.verb == common::StageCommand::Verb::check) {
            boussinesq::print_check(file, scene, command.all);
            return static_cast<int>(common::exit_done);
        }
        return run(command, file, scene);
    });
}
