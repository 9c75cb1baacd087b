/// The command line that boussinesq, cmps and dem share.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace common {

/// What differs between the stages' command lines.
struct StageGrammar {
    std::string program;          ///< "cmps"
    std::string description;      ///< one line for --help
    std::string upstream_option;  ///< "--waves", "--flow"; empty: none
    bool has_layouts = false;     ///< dem: --wires LAYOUT.toml, --from STATE.h5
    bool has_pack = false;        ///< dem pack
};

/// The command line as read.
struct StageCommand {
    enum class Verb { run, check, pack } verb = Verb::run;
    std::filesystem::path scene, out, upstream, wires, from;
    std::vector<std::string> overrides;  ///< KEY=VALUE of --set
    int threads = 1;
    bool resume = false, follow = false, quiet = false, all = false;
};

/// Reads the command line. --help and --version print and end the program with 0; mistakes throw InputError.
StageCommand read_stage_command(int argc, char** argv, const StageGrammar& grammar);

}  // namespace common
