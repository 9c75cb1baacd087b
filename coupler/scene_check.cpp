#include "coupler/scene_check.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <list>

#include "common/errors.hpp"
#include "common/scene_file.hpp"
#include "coupler/stage_process.hpp"

namespace coupler {

namespace fs = std::filesystem;

fs::path program_folder() {
    return fs::read_symlink("/proc/self/exe").parent_path();
}

std::vector<StagePlace> stages_of(const Command& command) {
    const auto scene = common::SceneFile::read(command.scene, command.overrides);
    std::vector<StagePlace> stages{chain_stages[0]};
    if (scene.has_section("cmps")) stages.push_back(chain_stages[1]);
    if (!scene.has_section("dem")) return stages;
    if (stages.size() < 2)
        throw common::InputError(
            fmt::format("{}: [dem] needs the near field: the scene has no [cmps]", command.scene.string()));
    stages.push_back(chain_stages[2]);
    return stages;
}

std::vector<std::string> override_words(const Command& command) {
    std::vector<std::string> words;
    for (const auto& setting : command.overrides) words.insert(words.end(), {"--set", setting});
    return words;
}

void check_scene(const Command& command, std::span<const StagePlace> stages) {
    std::list<StageProcess> checks;
    for (const auto& stage : stages) {
        std::vector<std::string> words{(program_folder() / stage.name).string(), "check",
                                       command.scene.string()};
        for (const auto& word : override_words(command)) words.push_back(word);
        if (stage.name == "dem" && !command.wires.empty())
            words.insert(words.end(), {"--wires", command.wires.string()});
        checks.emplace_back(words);
    }
    std::vector<std::string> mistakes;
    auto stage = stages.begin();
    for (auto& check : checks) {
        wait_for_end(check);
        const std::string prefix = (stage++)->name + ": ";
        const auto messages = check.take_messages();
        if (check.ending().is_done()) continue;
        if (check.ending().status != common::exit_bad_input)
            throw common::RunError(fmt::format("{}check: {}{}{}", prefix, check.ending().describe(),
                                               messages.empty() ? "" : ": ", fmt::join(messages, "; ")));
        for (const auto& message : messages) {
            const std::string line = message.starts_with(prefix) ? message.substr(prefix.size()) : message;
            if (std::find(mistakes.begin(), mistakes.end(), line) == mistakes.end()) mistakes.push_back(line);
        }
    }
    if (!mistakes.empty()) throw common::InputError(fmt::format("{}", fmt::join(mistakes, "\n")));
}

}  // namespace coupler
