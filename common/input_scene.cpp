#include "common/input_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "common/digest.hpp"
#include "common/errors.hpp"
#include "common/scene_tree.hpp"

namespace common {

namespace {

using Json = nlohmann::ordered_json;

/// A value as run.json records it.
Json json_of(const toml::node& node) {
    if (const auto* text = node.as_string()) return text->get();
    if (const auto* flag = node.as_boolean()) return flag->get();
    if (const auto* whole = node.as_integer()) return whole->get();
    if (const auto* number = node.as_floating_point()) return number->get();
    if (const auto* list = node.as_array()) {
        Json items = Json::array();
        for (const auto& item : *list) items.push_back(json_of(item));
        return items;
    }
    return {};
}

/// The table of a section as it is named in run.json ("boussinesq", "dem.blocks", "wires.link[2]").
const toml::table* table_of(const toml::table& root, const std::string& section) {
    const toml::table* table = &root;
    std::istringstream parts(section);
    for (std::string part; table != nullptr && std::getline(parts, part, '.');) {
        const auto bracket = part.find('[');
        const toml::node* node = table->get(part.substr(0, bracket));
        if (node != nullptr && bracket != std::string::npos) {
            const auto* list = node->as_array();
            node = list != nullptr ? list->get(std::stoul(part.substr(bracket + 1)) - 1) : nullptr;
        }
        table = node != nullptr ? node->as_table() : nullptr;
    }
    return table;
}

bool may_differ(const std::string& section, const std::string& key) {
    if (section.empty()) return key == "title" || key == "perturbation";
    return section == "time" || section == "gauges" || section.starts_with("gauges.");
}

/// Sections of which a stage reads every key: one that it has not recorded was not there.
std::set<std::string> sections_of(const std::string& stage) {
    if (stage == "boussinesq") return {"flume", "waves", "boussinesq"};
    return {stage};
}

std::string digest_of_file(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream content;
    content << stream.rdbuf();
    return stream ? digest_of(content.str()) : std::string();
}

/// Text short enough for a line with several.
std::string short_text(const Json& value) {
    constexpr std::size_t longest = 40;
    std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.size() > longest) text = text.substr(0, longest) + "...";
    return text;
}

/// A key as recorded and as given now.
class Comparison {
 public:
    Comparison(const SceneData& scene, const std::string& stage, std::vector<std::string>& differences)
        : scene_(scene), stage_(stage), differences_(differences) {}

    void look(const std::string& section, const std::string& key, const Json& recorded) {
        if (may_differ(section, key)) return;
        const toml::table* table = table_of(scene_.tree, section);
        const toml::node* node = table != nullptr ? table->get(key) : nullptr;
        const Json& value = recorded.at("value");
        if (node == nullptr) {
            if (recorded.value("default", false)) return;
            note(section, key, short_text(value) + " there, not given here");
        } else if (recorded.contains("digest")) {
            const auto name = node->value<std::string>();
            if (!name || digest_of_file(scene_.path.parent_path() / *name) != recorded.at("digest"))
                note(section, key, "a file of other content");
        } else {
            const Json now = json_of(*node);
            // One polygon is recorded as a list of one.
            if (now != value && Json::array({now}) != value)
                note(section, key, fmt::format("{} there, {} here", short_text(value), short_text(now)));
        }
    }

    /// Keys of the scene that the stage would have recorded.
    void look_for_more(const Json& values) {
        for (const auto& section : sections_of(stage_))
            if (const auto* table = scene_.tree.get_as<toml::table>(section))
                descend(section, *table, values);
    }

 private:
    void descend(const std::string& section, const toml::table& table, const Json& values) {
        for (const auto& [name, node] : table) {
            const std::string key(name.str());
            const bool is_recorded = values.contains(section) && values.at(section).contains(key);
            if (is_recorded) continue;
            if (const auto* inner = node.as_table()) {
                descend(dotted_name(section, key), *inner, values);
            } else if (const auto* list = node.as_array();
                       list != nullptr && !list->empty() && list->get(0)->is_table()) {
                for (std::size_t i = 0; i < list->size(); ++i)
                    if (const auto* item = list->get(i)->as_table())
                        descend(fmt::format("{}[{}]", dotted_name(section, key), i + 1), *item, values);
            } else {
                note(section, key, "not given there, " + short_text(json_of(node)) + " here");
            }
        }
    }

    void note(const std::string& section, const std::string& key, const std::string& how) {
        const std::string name = dotted_name(section, key);
        // A stage and the one before it may both have recorded a key.
        for (const auto& text : differences_)
            if (text.starts_with(name + " (")) return;
        differences_.push_back(fmt::format("{} ({})", name, how));
    }

    const SceneData& scene_;
    const std::string& stage_;
    std::vector<std::string>& differences_;
};

}  // namespace

std::string require_same_scene(const SceneFile& scene, const fs::path& folder, const std::string& digest) {
    const fs::path path = folder / "run.json";
    std::ifstream stream(path);
    const Json record = stream ? Json::parse(stream, nullptr, false) : Json::object();
    const auto refuse_damaged = [&] {
        throw InputError(fmt::format("{}: damaged, or not the record of a run", path.string()));
    };
    if (!record.is_object()) refuse_damaged();
    if (!record.contains("scene"))
        return fmt::format("{}: windows without a scene record: whether they belong to {} is not checked",
                           folder.string(), scene.path().string());
    std::vector<std::string> differences;
    std::string stage;
    try {
        stage = record.at("stage");
        if (record.at("scene_digest") != digest)
            throw InputError(
                fmt::format("{}: is of another run than the windows beside it (digests differ); run {} anew",
                            path.string(), stage));
        for (const Json* input = &record; input->is_object() && input->contains("scene");
             input = &input->at("input")) {
            const std::string name = input->at("stage");
            const Json& values = input->at("scene").at("values");
            Comparison comparison(*scene.data_, name, differences);
            for (const auto& [section, keys] : values.items())
                for (const auto& [key, recorded] : keys.items()) comparison.look(section, key, recorded);
            comparison.look_for_more(values);
            if (!input->contains("input")) break;
        }
    } catch (const Json::exception&) {
        refuse_damaged();
    }
    if (differences.empty()) return {};
    constexpr std::size_t most = 5;
    const std::size_t left_out = differences.size() - std::min(differences.size(), most);
    differences.resize(differences.size() - left_out);
    throw InputError(
        fmt::format("{}: computed from another scene than {}: {}{}; give the scene it was computed "
                    "from, or run {} with this one",
                    folder.string(), scene.path().string(), fmt::join(differences, ", "),
                    left_out > 0 ? fmt::format(" and {} more keys", left_out) : "", stage));
}

}  // namespace common
