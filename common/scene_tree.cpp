#include "common/scene_tree.hpp"

#include <fmt/format.h>

namespace common {

std::string SceneData::where(const std::string& dotted, const toml::node* node) const {
    if (const auto set = overridden.find(dotted); set != overridden.end()) return "--set " + set->second;
    if (node != nullptr && node->source().begin.line > 0)
        return fmt::format("{}:{}:{}", path.string(), node->source().begin.line, node->source().begin.column);
    return path.string();
}

void SceneData::note(const std::string& dotted, const toml::node* node, const std::string& message) {
    std::pair<std::uint32_t, std::uint32_t> position{0, 0};
    if (node != nullptr) position = {node->source().begin.line, node->source().begin.column};
    problems.emplace_back(position, fmt::format("{}: {}: {}", where(dotted, node), dotted, message));
    faulty.insert(dotted);
}

std::string dotted_name(const std::string& section, std::string_view key) {
    if (section.empty()) return std::string(key);
    return key.empty() ? section : fmt::format("{}.{}", section, key);
}

}  // namespace common
