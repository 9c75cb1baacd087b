/// The coupler: starts the stages of a chain, watches over them, and checks what they left.
#include "common/errors.hpp"
#include "coupler/chain.hpp"
#include "coupler/command_line.hpp"
#include "coupler/status.hpp"
#include "coupler/verify.hpp"

int main(int argc, char** argv) {
    return common::run_guarded("coupler", [&] {
        const coupler::Command command = coupler::read_command(argc, argv);
        switch (command.verb) {
            case coupler::Command::Verb::status:
                return coupler::show_status(command.folder);
            case coupler::Command::Verb::verify:
                return coupler::verify_chain(command.folder);
            case coupler::Command::Verb::run:
                return coupler::run_chain(command);
        }
        return static_cast<int>(common::exit_failed);
    });
}
