/// dem: armour blocks of spheres, their contacts and wires, moved by the near field.
#include <gsl/gsl_errno.h>

#include <optional>

#include "common/errors.hpp"
#include "common/parallel.hpp"
#include "common/stage_command.hpp"
#include "dem/run.hpp"

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
        const common::Section wires = (layout ? *layout : file).section("wires");
        if (command.from.empty() && wires.has("put_back"))
            wires.problem(
                "put_back",
                command.verb == Verb::pack
                    ? "puts blocks of an earlier run back; it does not belong in what is packed, but in "
                      "a layout for --wires"
                    : "puts blocks of an earlier run back to where they were packed; it needs --from");
        file.finish();
        if (layout) layout->finish();
        if (command.verb == Verb::check) dem::check(command, file, scene);
        if (command.verb == Verb::pack) dem::pack(command, file, scene);
        if (command.verb == Verb::run) dem::run(command, file, layout ? &*layout : nullptr, scene);
        return static_cast<int>(common::exit_done);
    });
}
