#include "coupler/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "common/build_information.hpp"
#include "common/errors.hpp"

namespace coupler {

Command read_command(int argc, char** argv) {
    Command command;
    CLI::App app{"Runs the chain waves - near field - blocks and watches over it.", "coupler"};
    app.set_version_flag("--version", common::version_text("coupler"));
    app.require_subcommand(1);
    app.footer(
        "Exit status: 0 done, 1 failed while running, 2 bad input or usage, 130 after Ctrl-C, SIGTERM or "
        "SIGHUP.");

    CLI::App* run = app.add_subcommand(
        "run", "run boussinesq, cmps and dem side by side: DIR/waves, DIR/flow, DIR/blocks");
    run->add_option("SCENE", command.scene, "scene file (TOML)")->required();
    run->add_option("--out", command.folder, "folder of the chain")->required();
    run->add_option("--wires", command.wires, "layout file (TOML) in place of the scene's [wires]");
    run->add_option("--set", command.overrides, "KEY=VALUE: override a scene key; repeatable")
        ->allow_extra_args(false)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    run->add_option("--threads", command.threads, "number of threads of each stage")
        ->check(CLI::Range(1, 1024));
    run->add_flag("--resume", command.resume, "go on from the last finished windows");
    run->add_flag("--quiet", command.quiet, "no progress board");
    CLI::App* status = app.add_subcommand("status", "how the stages of a chain stand");
    CLI::App* verify =
        app.add_subcommand("verify", "read every window of a chain and check that all of it agrees");
    for (CLI::App* verb : {status, verify})
        verb->add_option("DIR", command.folder, "folder of the chain")->required();
    try {
        app.parse(argc, argv);
    } catch (const CLI::Success& help_or_version) {
        app.exit(help_or_version);
        std::exit(common::exit_done);
    } catch (const CLI::ParseError& error) {
        throw common::InputError(fmt::format("{}; see coupler --help", error.what()));
    }
    command.verb = status->parsed()   ? Command::Verb::status
                   : verify->parsed() ? Command::Verb::verify
                                      : Command::Verb::run;
    return command;
}

}  // namespace coupler
