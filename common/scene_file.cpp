#include "common/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "common/digest.hpp"
#include "common/errors.hpp"
#include "common/scene_tree.hpp"
#include "common/scene_words.hpp"

namespace common {

namespace {

/// The sections of the contract: any other top-level table is a mistake.
const std::vector<std::string> known_sections = {"time", "flume", "waves", "gauges",  "boussinesq",
                                                 "cmps", "dem",   "wires", "effects", "initial"};
const std::vector<std::string> known_root_keys = {"title", "accuracy", "perturbation"};

/// Effects of all stages: a stage reads its own and lets the others' stand.
const std::vector<std::string> known_effects = {
    "dispersion",       "breaking",   "shoreline",     "friction",  // boussinesq
    "viscosity",        "turbulence", "wall_overflow", "overtopping_basin",  "relaxation_zone",
    "start_at_arrival",  // cmps
    "fluid_force",      "wires",      "wire_breaking", "tangential_history", "sleeping",
    "still_windows"};  // dem

/// Puts KEY=VALUE into the tree; VALUE is TOML, or plain text where it is not.
void apply_override(SceneData& scene, const std::string& word) {
    const auto equals = word.find('=');
    if (equals == std::string::npos || equals == 0)
        throw InputError(
            fmt::format("--set {}: expected KEY=VALUE, for instance --set waves.height=0.2", word));
    const std::string dotted = word.substr(0, equals), text = word.substr(equals + 1);
    toml::table parsed;
    try {
        parsed = toml::parse("value = " + text);
    } catch (const toml::parse_error&) {
        parsed.insert_or_assign("value", text);
    }
    if (parsed.size() != 1) throw InputError(fmt::format("--set {}: expected one value", word));
    toml::table* table = &scene.tree;
    std::size_t from = 0;
    for (auto dot = dotted.find('.'); dot != std::string::npos;
         from = dot + 1, dot = dotted.find('.', from)) {
        const std::string part = dotted.substr(from, dot - from);
        toml::node* inner = table->get(part);
        if (inner == nullptr) {
            table->insert_or_assign(part, toml::table{});
            inner = table->get(part);
        }
        table = inner->as_table();
        if (table == nullptr)
            throw InputError(fmt::format("--set {}: '{}' is not a table", word, dotted.substr(0, dot)));
    }
    const std::string key = dotted.substr(from);
    if (key.empty()) throw InputError(fmt::format("--set {}: the key is empty", word));
    table->insert_or_assign(key, *parsed.get("value"));
    scene.overridden[dotted] = word;
}

}  // namespace

SceneFile::SceneFile(std::unique_ptr<SceneData> data) : data_(std::move(data)) {}
SceneFile::~SceneFile() = default;
SceneFile::SceneFile(SceneFile&&) noexcept = default;
SceneFile& SceneFile::operator=(SceneFile&&) noexcept = default;

SceneFile SceneFile::read(const fs::path& path, std::span<const std::string> overrides) {
    std::ifstream stream(path, std::ios::binary);
    if (!stream || fs::is_directory(path))
        throw InputError(fmt::format("{}: cannot be read{}", path.string(),
                                     fs::is_directory(path) ? ": it is a folder"
                                     : fs::exists(path)     ? ""
                                                            : ": no such file"));
    std::ostringstream text;
    text << stream.rdbuf();
    return parse(text.str(), path.string(), overrides);
}

SceneFile SceneFile::parse(std::string_view text, const std::string& name,
                           std::span<const std::string> overrides) {
    auto data = std::make_unique<SceneData>();
    data->path = name;
    try {
        data->tree = toml::parse(text, name);
    } catch (const toml::parse_error& error) {
        throw InputError(fmt::format("{}:{}:{}: not valid TOML: {}", name, error.source().begin.line,
                                     error.source().begin.column, error.description()));
    }
    for (const auto& word : overrides) apply_override(*data, word);
    auto& root_keys = data->known[""];
    root_keys.insert(known_sections.begin(), known_sections.end());
    root_keys.insert(known_root_keys.begin(), known_root_keys.end());
    data->known["effects"].insert(known_effects.begin(), known_effects.end());
    data->sections_read[""] = &data->tree;
    return SceneFile(std::move(data));
}

Section SceneFile::root() const {
    return Section(data_.get(), "", &data_->tree);
}

Section SceneFile::section(std::string_view name) const {
    Section section = root();
    std::size_t from = 0;
    while (from <= name.size()) {
        const auto dot = std::min(name.find('.', from), name.size());
        section = section.table(name.substr(from, dot - from));
        from = dot + 1;
    }
    return section;
}

Section SceneFile::foreign_section(std::string_view name) const {
    const auto* table = data_->tree.get_as<toml::table>(name);
    return Section(data_.get(), std::string(name), table);
}

bool SceneFile::has_section(std::string_view name) const {
    return static_cast<bool>(data_->tree.at_path(name));
}

Accuracy SceneFile::accuracy() const {
    const std::string word = root().choice("accuracy", "resolution and schemes of every stage",
                                           {"draft", "standard", "fine"}, "standard");
    return word == "draft" ? Accuracy::draft : word == "fine" ? Accuracy::fine : Accuracy::standard;
}

std::int64_t SceneFile::perturbation() const {
    return root().integer("perturbation",
                          "seed of a perturbation of the first state by rounding, 0: none; members of an "
                          "ensemble differ by it",
                          Range::between(0, 1e9), 0);
}

bool SceneFile::has_problems() const {
    return !data_->problems.empty();
}

void SceneFile::finish() const {
    auto problems = data_->problems;
    for (const auto& [name, table] : data_->sections_read) {
        if (table == nullptr) continue;
        const auto& known = data_->known[name];
        for (const auto& [key, node] : *table) {
            const std::string word(key.str());
            if (known.contains(word)) continue;
            const std::string dotted = dotted_name(name, word);
            problems.emplace_back(
                std::pair{key.source().begin.line, key.source().begin.column},
                fmt::format("{}: {}: unknown {}{}",
                            data_->overridden.contains(dotted) || key.source().begin.line == 0
                                ? data_->where(dotted, &node)
                                : fmt::format("{}:{}:{}", data_->path.string(), key.source().begin.line,
                                              key.source().begin.column),
                            dotted, node.is_table() ? "section" : "key", suggestion(word, known)));
        }
    }
    if (problems.empty()) return;
    std::stable_sort(problems.begin(), problems.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::string message;
    for (const auto& [position, text] : problems) message += (message.empty() ? "" : "\n") + text;
    throw InputError(message);
}

std::vector<SceneValue> SceneFile::values() const {
    std::vector<SceneValue> values;
    for (const auto& d : data_->declarations) {
        const auto file = data_->file_digests.find(dotted_name(d.section, d.key));
        values.push_back({d.section, d.key, d.value, d.unit, d.about, d.is_default,
                          file != data_->file_digests.end() ? file->second : std::string()});
    }
    return values;
}

std::string SceneFile::reference() const {
    std::vector<std::string> order;
    std::map<std::string, std::vector<const Declaration*>> by_section;
    for (const auto& declaration : data_->declarations) {
        if (!by_section.contains(declaration.section)) order.push_back(declaration.section);
        by_section[declaration.section].push_back(&declaration);
    }
    // Keys of the top level must stand before the first table.
    std::stable_partition(order.begin(), order.end(), [](const auto& name) { return name.empty(); });
    std::string text, last_list;
    for (const auto& section : order) {
        if (!section.empty()) {
            const auto bracket = section.find('[');
            const std::string name = section.substr(0, bracket);
            text += bracket == std::string::npos ? fmt::format("\n[{}]\n", name)
                                                 : fmt::format("\n[[{}]]\n", name);
        }
        for (const auto* d : by_section[section]) {
            const bool is_plain =
                !d->key.empty() && std::all_of(d->key.begin(), d->key.end(), [](unsigned char c) {
                    return std::isalnum(c) != 0 || c == '_' || c == '-';
                });
            text += fmt::format("{:<40}  # {}{}{}{}\n",
                                fmt::format("{} = {}", is_plain ? d->key : in_quotes(d->key), d->value),
                                d->unit.empty() || d->unit == "-" ? "" : d->unit + "; ", d->about,
                                d->is_default ? "; default" : "", "");
        }
    }
    return text;
}

std::string SceneFile::digest(std::string_view upstream) const {
    std::map<std::string, std::string> lines;
    for (const auto& d : data_->declarations) {
        const std::string dotted = dotted_name(d.section, d.key);
        if (dotted == "title") continue;
        if (dotted == "perturbation" && d.value == "0") continue;  // a scene without it is the same scene
        const auto file = data_->file_digests.find(dotted);
        lines[dotted] = file != data_->file_digests.end() ? file->second : d.value;
    }
    std::string text = fmt::format("upstream={}\n", upstream);
    for (const auto& [key, value] : lines) text += fmt::format("{}={}\n", key, value);
    return digest_of(text);
}

const fs::path& SceneFile::path() const {
    return data_->path;
}

EffectWish read_effect_wish(const SceneFile& scene, std::string_view effect) {
    const std::string word = scene.section("effects").choice(effect, "whether this effect is simulated",
                                                             {"auto", "on", "off"}, "auto");
    return word == "on" ? EffectWish::on : word == "off" ? EffectWish::off : EffectWish::automatic;
}

}  // namespace common
