/// How this program was built and where it runs: for --version and run.json.
#pragma once

#include <string>

namespace common {

/// What two runs have to share to be the same bytes: see "The same bytes" in common/README.md.
struct BuildInformation {
    std::string version;  ///< of the project, "0.1.0"
    std::string
        revision;  ///< of the sources, "59a40df12345", with "+changes" when they held uncommitted ones
    std::string compiler;  ///< "GNU 12.2.0"
    std::string flags;     ///< those that bear on results, "Release -O3 -march=x86-64-v3 -ffp-contract=off"
};
const BuildInformation& build_information();

/// Name of the processor this runs on, as it gives it; "unknown" where it gives none.
std::string processor_name();

/// What --version prints: one line each for program, revision, compiler with flags, and processor.
std::string version_text(const std::string& program);

}  // namespace common
