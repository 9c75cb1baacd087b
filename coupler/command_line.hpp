/// The command line of the coupler.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace coupler {

/// The command line as read.
struct Command {
    enum class Verb { run, status, verify } verb = Verb::run;
    std::filesystem::path scene;         ///< run
    std::filesystem::path folder;        ///< the chain's folder
    std::filesystem::path wires;         ///< layout file, or empty
    std::vector<std::string> overrides;  ///< KEY=VALUE of --set
    int threads = 1;                     ///< for each stage
    bool resume = false, quiet = false;
};

/// --help and --version print and end the program with 0; mistakes throw InputError.
Command read_command(int argc, char** argv);

}  // namespace coupler
