#include "common/stage_command.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "common/build_information.hpp"
#include "common/errors.hpp"

namespace common {

StageCommand read_stage_command(int argc, char** argv, const StageGrammar& grammar) {
    StageCommand command;
    CLI::App app{grammar.description, grammar.program};
    app.set_version_flag("--version", version_text(grammar.program));
    app.require_subcommand(1);
    app.footer(
        "Exit status: 0 done, 1 failed while running, 2 bad input or usage, 130 after Ctrl-C, SIGTERM or "
        "SIGHUP.");

    const auto add_common = [&](CLI::App* verb) {
        verb->add_option("SCENE", command.scene, "scene file (TOML)")->required();
        verb->add_option("--set", command.overrides, "KEY=VALUE: override a scene key; repeatable")
            ->allow_extra_args(false)
            ->expected(1)
            ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
        verb->add_option("--threads", command.threads, "number of threads")->check(CLI::Range(1, 1024));
    };
    const auto add_output = [&](CLI::App* verb) {
        verb->add_option("--out", command.out, "output folder")->required();
        verb->add_flag("--resume", command.resume,
                       "go on from the last finished window in the output folder");
        verb->add_flag("--quiet", command.quiet, "no progress line");
    };
    CLI::App* run = app.add_subcommand("run", "simulate the scene");
    add_common(run);
    add_output(run);
    CLI::Option* follow =
        run->add_flag("--follow", command.follow, "wait for the next upstream window instead of stopping");
    CLI::App* check =
        app.add_subcommand("check", "validate the scene and say what would be simulated; run nothing");
    add_common(check);
    check->add_flag("--all", command.all, "print every key with its default and unit");
    CLI::App* pack = nullptr;
    if (grammar.has_pack) {
        pack = app.add_subcommand("pack", "let the blocks settle on the mound in still water, without wires");
        add_common(pack);
        add_output(pack);
    }
    for (CLI::App* verb : {run, check}) {
        if (!grammar.upstream_option.empty()) {
            CLI::Option* upstream = verb->add_option(grammar.upstream_option, command.upstream,
                                                     "folder with the windows of the stage before");
            if (verb == run) follow->needs(upstream);  // without it there is nothing to wait for
        }
        if (grammar.has_layouts) {
            verb->add_option("--wires", command.wires, "layout file (TOML) in place of the scene's [wires]");
            verb->add_option("--from", command.from, "state or window of an earlier run to start from");
        }
    }
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
        app.exit(help_or_version);
        std::exit(exit_done);
    } catch (const CLI::ParseError& error) {
        throw InputError(fmt::format("{}; see {} --help", error.what(), grammar.program));
    }
    command.verb = check->parsed()                     ? StageCommand::Verb::check
                   : pack != nullptr && pack->parsed() ? StageCommand::Verb::pack
                                                       : StageCommand::Verb::run;
    return command;
}

}  // namespace common
