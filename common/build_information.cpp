#include "common/build_information.hpp"

#include <fmt/format.h>

#include <fstream>

#include "common/build_revision.hpp"
#include "common/processor_check.h"

#if defined(__x86_64__)
#include <cpuid.h>

#include <array>
#include <cstring>
#endif

#if defined(__AVX512F__)
extern "C" const unsigned tsunagi_required_instructions = TSUNAGI_X86_64_V3 | TSUNAGI_X86_64_V4;
#elif defined(__AVX2__)
extern "C" const unsigned tsunagi_required_instructions = TSUNAGI_X86_64_V3;
#else
extern "C" const unsigned tsunagi_required_instructions = 0;
#endif

namespace {

// Nothing calls the check: it runs by itself, where the linker takes it in.
[[gnu::used]] const int* const check_of_the_processor = &tsunagi_processor_is_checked;

}  // namespace

namespace common {

const BuildInformation& build_information() {
    static const BuildInformation information{TSUNAGI_VERSION, TSUNAGI_REVISION, TSUNAGI_COMPILER,
                                              TSUNAGI_FLAGS};
    return information;
}

std::string processor_name() {
#if defined(__x86_64__)
    // The brand string: sixteen bytes of name in each of three leaves. An emulated processor gives its own.
    std::array<unsigned, 12> words{};
    for (unsigned leaf = 0; leaf < 3; ++leaf) {
        unsigned* word = &words[4 * leaf];
        if (__get_cpuid(0x80000002u + leaf, &word[0], &word[1], &word[2], &word[3]) == 0) return "unknown";
    }
    std::array<char, 49> text{};
    std::memcpy(text.data(), words.data(), 48);
    std::string name = text.data();
    const auto begin = name.find_first_not_of(' ');
    return begin == std::string::npos ? "unknown"
                                      : name.substr(begin, name.find_last_not_of(' ') + 1 - begin);
#else
    std::ifstream information("/proc/cpuinfo");
    for (std::string line; std::getline(information, line);)
        for (const char* key : {"model name", "Model", "CPU part"})
            if (line.starts_with(key)) return line.substr(line.find(':') + 2);
    return "unknown";
#endif
}

std::string version_text(const std::string& program) {
    const BuildInformation& build = build_information();
    return fmt::format("{} {}\nrevision   {}\ncompiler   {}, {}\nprocessor  {}", program, build.version,
                       build.revision, build.compiler, build.flags, processor_name());
}

}  // namespace common
