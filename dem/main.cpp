/// dem: armour blocks of spheres, their contacts and wires, moved by the near field.
#include <fmt/format.h>
#include <gsl/gsl_errno.h>

#include <optional>
#include <utility>

#include "common/errors.hpp"
#include "common/parallel.hpp"
#include "common/stage_command.hpp"
#include "dem/run.hpp"
#include "dem/step_trial.hpp"

namespace {

/// Keys that change an earlier run mean nothing without one.
void refuse_without_earlier_run(const common::StageCommand& command, const common::SceneFile& file,
                                const common::SceneFile* layout) {
    if (!command.from.empty()) return;
    const auto refuse = [&](const common::Section& section, const char* key, const char* what) {
        if (!section.has(key)) return;
        section.problem(key,
                        command.verb == common::StageCommand::Verb::pack
                            ? fmt::format("{} an earlier run; it does not belong in what is packed", what)
                            : fmt::format("{} an earlier run; it needs --from", what));
    };
    refuse((layout != nullptr ? *layout : file).section("wires"), "put_back", "puts back blocks of");
    const common::Section restart = file.section("dem").table("restart");
    refuse(restart, "time", "chooses an instant of");
    refuse(restart, "calm", "lets settle the blocks of");
    refuse(restart, "clock", "sets the clock of a run that goes on from");
}

/// What stands for the water of a flow means nothing beside one.
void refuse_beside_a_flow(const common::StageCommand& command, const common::SceneFile& file,
                          const dem::UniformWater& water) {
    if (command.upstream.empty()) return;
    const common::Section dem = file.section("dem");
    for (const auto& [key, value] :
         {std::pair{"current", water.velocity}, {"current_acceleration", water.acceleration}})
        if (!value.isZero(0)) dem.problem(key, "stands for the water where there is no --flow");
    if (dem.boolean("dry", "no water at all", false))
        dem.problem("dry", "--flow brings water: it moves nothing where all is dry");
}

}  // namespace

int main(int argc, char** argv) {
    return common::run_guarded("dem", [&] {
        using Verb = common::StageCommand::Verb;
        gsl_set_error_handler_off();
        common::watch_for_interrupts();
        const auto command =
            common::read_stage_command(argc, argv,
                                       {.program = "dem",
                                        .description = "armour blocks and wires (3D distinct elements)",
                                        .upstream_option = "--flow",
                                        .has_layouts = true,
                                        .has_pack = true});
        common::use_threads(command.threads);
        const auto file = common::SceneFile::read(command.scene, command.overrides);
        std::optional<common::SceneFile> layout;
        if (!command.wires.empty()) {
            layout = common::SceneFile::read(command.wires);
            for (const auto& key : layout->root().keys())
                if (key != "wires" && key != "title")
                    layout->root().problem(key, "does not belong in a layout, which holds [wires] only");
        }
        const dem::Scene scene = dem::read_scene(file, layout ? &*layout : nullptr);
        refuse_without_earlier_run(command, file, layout ? &*layout : nullptr);
        refuse_beside_a_flow(command, file, scene.uniform_water);
        file.finish();
        if (layout) layout->finish();
        if (command.verb != Verb::check && !command.resume) dem::require_stable_step(file, scene);
        if (command.verb == Verb::check) dem::check(command, file, scene);
        if (command.verb == Verb::pack) dem::pack(command, file, scene);
        if (command.verb == Verb::run) dem::run(command, file, layout ? &*layout : nullptr, scene);
        return static_cast<int>(common::exit_done);
    });
}
