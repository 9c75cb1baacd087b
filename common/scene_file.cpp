#include "common/scene_file.hpp"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <sstream>

#include "common/digest.hpp"
#include "common/errors.hpp"

namespace common {

namespace fs = std::filesystem;

struct Declaration {
    std::string section, key, value, unit, about;
    bool is_default;
};

struct SceneData {
    fs::path path;
    toml::table tree;
    std::map<std::string, std::string> overridden;            // dotted key -> the --set word
    std::vector<Declaration> declarations;                    // in order
    std::map<std::string, std::set<std::string>> known;       // section -> keys declared
    std::map<std::string, const toml::table*> sections_read;  // sections whose keys are checked by finish()
    std::vector<std::pair<std::pair<std::uint32_t, std::uint32_t>, std::string>>
        problems;                                     // (line, column), text
    std::set<std::string> faulty;                     // dotted keys that have a problem
    std::set<std::string> has_stand_ins;              // tables with a value of the wrong type or range
    std::map<std::string, std::string> file_digests;  // key -> digest of the file it names

    std::string where(const std::string& dotted, const toml::node* node) const {
        if (const auto set = overridden.find(dotted); set != overridden.end()) return "--set " + set->second;
        if (node != nullptr && node->source().begin.line > 0)
            return fmt::format("{}:{}:{}", path.string(), node->source().begin.line,
                               node->source().begin.column);
        return path.string();
    }
    void note(const std::string& dotted, const toml::node* node, const std::string& message) {
        std::pair<std::uint32_t, std::uint32_t> position{0, 0};
        if (node != nullptr) position = {node->source().begin.line, node->source().begin.column};
        problems.emplace_back(position, fmt::format("{}: {}: {}", where(dotted, node), dotted, message));
        faulty.insert(dotted);
    }
};

namespace {

/// The sections of the contract: any other top-level table is a mistake.
const std::vector<std::string> known_sections = {"time", "flume", "waves", "gauges",  "boussinesq",
                                                 "cmps", "dem",   "wires", "effects", "initial"};
const std::vector<std::string> known_root_keys = {"title", "accuracy"};

/// Effects of all stages: a stage reads its own and lets the others' stand.
const std::vector<std::string> known_effects = {
    "dispersion",       "breaking",   "shoreline",     "friction",  // boussinesq
    "viscosity",        "turbulence", "wall_overflow", "overtopping_basin",  "relaxation_zone",
    "start_at_arrival",  // cmps
    "fluid_force",      "wires",      "wire_breaking", "tangential_history", "sleeping",
    "still_windows"};  // dem

std::string dotted_name(const std::string& section, std::string_view key) {
    if (section.empty()) return std::string(key);
    return key.empty() ? section : fmt::format("{}.{}", section, key);
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t above = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1])});
            diagonal = above;
        }
    }
    return row[b.size()];
}

template <class Names>
std::string nearest_name(std::string_view word, const Names& names) {
    std::string best;
    std::size_t least = word.size() / 2 + 2;
    for (const auto& name : names) {
        const std::size_t distance = edit_distance(word, name);
        if (distance < least) {
            least = distance;
            best = name;
        }
    }
    return best;
}

template <class Names>
std::string suggestion(std::string_view word, const Names& names) {
    const std::string best = nearest_name(word, names);
    return best.empty() ? std::string() : fmt::format("; did you mean '{}'?", best);
}

/// "a number from 1 to 5", "a whole number above 0"; `kind` is what stands before the range.
std::string describe(const Range& range, const std::string& kind = "a number") {
    const bool has_lowest = std::isfinite(range.lowest), has_highest = std::isfinite(range.highest);
    if (has_lowest && has_highest && !range.lowest_is_open && !range.highest_is_open)
        return fmt::format("{} from {} to {}", kind, range.lowest, range.highest);
    if (has_lowest && has_highest)
        return fmt::format("{} {} {} and {} {}", kind, range.lowest_is_open ? "above" : "from", range.lowest,
                           range.highest_is_open ? "below" : "at most", range.highest);
    if (has_lowest)
        return fmt::format("{} {} {}", kind, range.lowest_is_open ? "above" : "of at least", range.lowest);
    if (has_highest)
        return fmt::format("{} {} {}", kind, range.highest_is_open ? "below" : "of at most", range.highest);
    return kind;
}

bool contains(const Range& range, double value) {
    if (!std::isfinite(value)) return false;
    if (range.lowest_is_open ? value <= range.lowest : value < range.lowest) return false;
    return !(range.highest_is_open ? value >= range.highest : value > range.highest);
}

/// A number inside the range, to go on with after a mistake.
double some_value_in(const Range& range) {
    const bool has_lowest = std::isfinite(range.lowest), has_highest = std::isfinite(range.highest);
    if (has_lowest && has_highest) return 0.5 * (range.lowest + range.highest);
    if (has_lowest) return range.lowest + 1;
    return has_highest ? range.highest - 1 : 1;
}

std::string kind_of(const toml::node& node) {
    if (node.is_string()) return fmt::format("text \"{}\"", node.as_string()->get());
    if (node.is_boolean()) return node.as_boolean()->get() ? "true" : "false";
    if (node.is_integer()) return fmt::format("{}", node.as_integer()->get());
    if (node.is_floating_point()) return fmt::format("{}", node.as_floating_point()->get());
    if (node.is_array()) return fmt::format("a list of {}", node.as_array()->size());
    if (node.is_table()) return "a table";
    return "a date or time";
}

std::string in_quotes(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + "\"";
}

template <class T>
std::string list_text(const std::vector<T>& items) {
    std::string text = "[";
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (i > 0) text += ", ";
        if constexpr (std::is_arithmetic_v<T>)
            text += fmt::format("{}", items[i]);
        else
            text += list_text(std::vector(items[i].begin(), items[i].end()));
    }
    return text + "]";
}

/// One reading of one key: finds the node, tells whether it is there, and records what was used.
class Reading {
 public:
    Reading(SceneData& scene, const std::string& section, const void* table, std::string_view key,
            std::string_view unit, std::string_view about)
        : scene_(scene), section_(section), key_(key), unit_(unit), about_(about) {
        scene_.known[section_].insert(key_);
        table_ = static_cast<const toml::table*>(table);
        if (table_ != nullptr) node_ = table_->get(key);
    }
    const toml::node* node() const { return node_; }
    void mistake(const std::string& message, const toml::node* at = nullptr) {
        scene_.has_stand_ins.insert(section_);
        scene_.note(dotted_name(section_, key_),
                    at != nullptr      ? at
                    : node_ != nullptr ? node_
                                       : table_,
                    message);
    }
    void missing(const std::string& expected) {
        mistake(fmt::format("required key is missing: {} ({}{}{})", about_, expected,
                            unit_.empty() || unit_ == "-" ? "" : ", ", unit_ == "-" ? "" : unit_));
    }
    void expected(const std::string& what, const toml::node& got) {
        mistake(fmt::format("expected {}{}{}, got {}", what, unit_.empty() || unit_ == "-" ? "" : " in ",
                            unit_ == "-" ? "" : unit_, kind_of(got)),
                &got);
    }
    void record(const std::string& value, bool is_default) {
        for (auto& declared : scene_.declarations)
            if (declared.section == section_ && declared.key == key_) {
                declared.value = value;
                return;
            }
        scene_.declarations.push_back({section_, key_, value, unit_, about_, is_default});
    }
    /// A number out of `got`; notes a mistake and returns a stand-in when it is none or out of range.
    double number_from(const toml::node& got, const Range& range) {
        const auto value = got.is_number() ? got.value<double>() : std::nullopt;
        if (!value || !contains(range, *value)) {
            expected(describe(range), got);
            return some_value_in(range);
        }
        return *value;
    }

 private:
    SceneData& scene_;
    std::string section_, key_, unit_, about_;
    const toml::table* table_ = nullptr;
    const toml::node* node_ = nullptr;
};

std::vector<std::vector<double>> rows_from(Reading& reading, const toml::node& node, std::size_t width) {
    std::vector<std::vector<double>> rows;
    const auto* outer = node.as_array();
    if (outer == nullptr) {
        reading.expected(fmt::format("a list of lists of {} numbers", width), node);
        return rows;
    }
    for (const auto& item : *outer) {
        const auto* inner = item.as_array();
        if (inner == nullptr || inner->size() != width) {
            reading.expected(fmt::format("a list of {} numbers", width), item);
            continue;
        }
        std::vector<double> row;
        for (const auto& number : *inner) row.push_back(reading.number_from(number, Range::any()));
        rows.push_back(row);
    }
    return rows;
}

std::vector<Point> points_of(const std::vector<std::vector<double>>& rows) {
    std::vector<Point> points;
    for (const auto& row : rows) points.push_back({row[0], row[1]});
    return points;
}

}  // namespace

// ---------------------------------------------------------------- Section

double Section::number(std::string_view key, std::string_view unit, std::string_view about, Range range,
                       std::optional<double> fallback) const {
    Reading reading(*scene_, name_, node_, key, unit, about);
    double value = fallback.value_or(some_value_in(range));
    if (reading.node() != nullptr)
        value = reading.number_from(*reading.node(), range);
    else if (!fallback)
        reading.missing(describe(range));
    reading.record(fmt::format("{}", value), reading.node() == nullptr);
    return value;
}

std::int64_t Section::integer(std::string_view key, std::string_view about, Range range,
                              std::optional<std::int64_t> fallback) const {
    Reading reading(*scene_, name_, node_, key, "", about);
    std::int64_t value = fallback.value_or(static_cast<std::int64_t>(some_value_in(range)));
    if (const auto* node = reading.node()) {
        const auto* whole = node->as_integer();
        if (whole == nullptr || !contains(range, static_cast<double>(whole->get())))
            reading.expected(describe(range, "a whole number"), *node);
        else
            value = whole->get();
    } else if (!fallback) {
        reading.missing("a whole number");
    }
    reading.record(fmt::format("{}", value), reading.node() == nullptr);
    return value;
}

bool Section::boolean(std::string_view key, std::string_view about, std::optional<bool> fallback) const {
    Reading reading(*scene_, name_, node_, key, "", about);
    bool value = fallback.value_or(false);
    if (const auto* node = reading.node()) {
        if (const auto* given = node->as_boolean())
            value = given->get();
        else
            reading.expected("true or false", *node);
    } else if (!fallback) {
        reading.missing("true or false");
    }
    reading.record(value ? "true" : "false", reading.node() == nullptr);
    return value;
}

std::string Section::text(std::string_view key, std::string_view about,
                          std::optional<std::string> fallback) const {
    Reading reading(*scene_, name_, node_, key, "", about);
    std::string value = fallback.value_or("");
    if (const auto* node = reading.node()) {
        if (const auto* given = node->as_string())
            value = given->get();
        else
            reading.expected("text", *node);
    } else if (!fallback) {
        reading.missing("text");
    }
    reading.record(in_quotes(value), reading.node() == nullptr);
    return value;
}

std::string Section::choice(std::string_view key, std::string_view about,
                            const std::vector<std::string>& words,
                            std::optional<std::string> fallback) const {
    Reading reading(*scene_, name_, node_, key, "", fmt::format("{}: {}", about, fmt::join(words, " | ")));
    std::string value = fallback.value_or(words.front());
    if (const auto* node = reading.node()) {
        const auto* given = node->as_string();
        if (given != nullptr && std::find(words.begin(), words.end(), given->get()) != words.end())
            value = given->get();
        else
            reading.mistake(fmt::format("expected one of {}, got {}{}", fmt::join(words, ", "),
                                        kind_of(*node),
                                        given != nullptr ? suggestion(given->get(), words) : ""));
    } else if (!fallback) {
        reading.missing(fmt::format("one of {}", fmt::join(words, ", ")));
    }
    reading.record(in_quotes(value), reading.node() == nullptr);
    return value;
}

fs::path Section::file(std::string_view key, std::string_view about, bool required) const {
    Reading reading(*scene_, name_, node_, key, "", about);
    fs::path value;
    if (const auto* node = reading.node()) {
        if (const auto* given = node->as_string()) {
            value = fs::path(given->get()).is_absolute() ? fs::path(given->get())
                                                         : scene_->path.parent_path() / given->get();
            std::ifstream stream(value, std::ios::binary);
            if (!stream || !fs::is_regular_file(value)) {
                reading.mistake(fmt::format("cannot read file '{}'", value.string()));
            } else {
                std::ostringstream content;
                content << stream.rdbuf();
                scene_->file_digests[dotted_name(name_, key)] = digest_of(content.str());
            }
        } else {
            reading.expected("a file name", *node);
        }
    } else if (required) {
        reading.missing("a file name");
    }
    if (reading.node() != nullptr) reading.record(in_quotes(value.string()), false);
    return value;
}

std::vector<double> Section::numbers(std::string_view key, std::string_view unit, std::string_view about,
                                     std::size_t count, Range range,
                                     std::optional<std::vector<double>> fallback) const {
    Reading reading(*scene_, name_, node_, key, unit, about);
    const std::string wanted = count > 0 ? fmt::format("a list of {} numbers", count) : "a list of numbers";
    std::vector<double> values = fallback.value_or(std::vector<double>(count, some_value_in(range)));
    if (const auto* node = reading.node()) {
        const auto* list = node->as_array();
        if (list == nullptr || (count > 0 && list->size() != count)) {
            reading.expected(wanted, *node);
        } else {
            values.clear();
            for (const auto& item : *list) values.push_back(reading.number_from(item, range));
        }
    } else if (!fallback) {
        reading.missing(wanted);
    }
    reading.record(list_text(values), reading.node() == nullptr);
    return values;
}

std::vector<std::vector<double>> Section::rows(
    std::string_view key, std::string_view unit, std::string_view about, std::size_t width,
    std::optional<std::vector<std::vector<double>>> fallback) const {
    Reading reading(*scene_, name_, node_, key, unit, about);
    std::vector<std::vector<double>> values = fallback.value_or(std::vector<std::vector<double>>{});
    if (const auto* node = reading.node())
        values = rows_from(reading, *node, width);
    else if (!fallback)
        reading.missing(fmt::format("a list of lists of {} numbers", width));
    reading.record(list_text(values), reading.node() == nullptr);
    return values;
}

std::vector<Point> Section::points(std::string_view key, std::string_view unit, std::string_view about,
                                   std::optional<std::vector<Point>> fallback) const {
    Reading reading(*scene_, name_, node_, key, unit, about);
    std::vector<Point> values = fallback.value_or(std::vector<Point>{});
    if (const auto* node = reading.node())
        values = points_of(rows_from(reading, *node, 2));
    else if (!fallback)
        reading.missing("a list of pairs");
    reading.record(list_text(values), reading.node() == nullptr);
    return values;
}

std::vector<std::vector<Point>> Section::polygons(
    std::string_view key, std::string_view unit, std::string_view about,
    std::optional<std::vector<std::vector<Point>>> fallback) const {
    Reading reading(*scene_, name_, node_, key, unit, about);
    std::vector<std::vector<Point>> values = fallback.value_or(std::vector<std::vector<Point>>{});
    if (const auto* node = reading.node()) {
        values.clear();
        const auto* outer = node->as_array();
        const auto* first = outer != nullptr && !outer->empty() ? outer->front().as_array() : nullptr;
        const bool is_single = first != nullptr && !first->empty() && first->front().is_number();
        if (outer == nullptr) {
            reading.expected("a list of polygons", *node);
        } else if (is_single) {
            values.push_back(points_of(rows_from(reading, *node, 2)));
        } else {
            for (const auto& item : *outer) values.push_back(points_of(rows_from(reading, item, 2)));
        }
    } else if (!fallback) {
        reading.missing("a list of polygons");
    }
    reading.record(list_text(values), reading.node() == nullptr);
    return values;
}

Section Section::table(std::string_view key) const {
    scene_->known[name_].insert(std::string(key));
    const auto* table = static_cast<const toml::table*>(node_);
    const toml::node* node = table != nullptr ? table->get(key) : nullptr;
    const std::string name = dotted_name(name_, key);
    if (node != nullptr && !node->is_table())
        scene_->note(name, node, "expected a table, got " + kind_of(*node));
    const toml::table* inner = node != nullptr ? node->as_table() : nullptr;
    scene_->sections_read[name] = inner;
    return Section(scene_, name, inner);
}

std::vector<Section> Section::tables(std::string_view key) const {
    scene_->known[name_].insert(std::string(key));
    const auto* table = static_cast<const toml::table*>(node_);
    const toml::node* node = table != nullptr ? table->get(key) : nullptr;
    const std::string name = dotted_name(name_, key);
    std::vector<Section> sections;
    if (node == nullptr) return sections;
    const auto* list = node->as_array();
    if (list == nullptr) {
        scene_->note(name, node, fmt::format("expected [[{}]] tables, got {}", name, kind_of(*node)));
        return sections;
    }
    for (std::size_t i = 0; i < list->size(); ++i) {
        const auto* item = list->get(i)->as_table();
        const std::string item_name = fmt::format("{}[{}]", name, i + 1);
        if (item == nullptr) {
            scene_->note(item_name, list->get(i), "expected a table, got " + kind_of(*list->get(i)));
            continue;
        }
        scene_->sections_read[item_name] = item;
        sections.push_back(Section(scene_, item_name, item));
    }
    return sections;
}

std::vector<std::string> Section::keys() const {
    std::vector<std::pair<toml::source_position, std::string>> found;
    if (const auto* table = static_cast<const toml::table*>(node_))
        for (const auto& [key, value] : *table)
            found.emplace_back(value.source().begin, std::string(key.str()));
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> names;
    for (auto& [position, name] : found) {
        scene_->known[name_].insert(name);
        names.push_back(std::move(name));
    }
    return names;
}

namespace {
const toml::node* find_node(const void* table, std::string_view key) {
    return table != nullptr ? static_cast<const toml::table*>(table)->get(key) : nullptr;
}
}  // namespace

bool Section::has(std::string_view key) const {
    return find_node(node_, key) != nullptr;
}
bool Section::is_table(std::string_view key) const {
    const auto* node = find_node(node_, key);
    return node != nullptr && node->is_table();
}
bool Section::is_number(std::string_view key) const {
    const auto* node = find_node(node_, key);
    return node != nullptr && node->is_number();
}
bool Section::is_text(std::string_view key) const {
    const auto* node = find_node(node_, key);
    return node != nullptr && node->is_string();
}

void Section::problem(std::string_view key, const std::string& message) const {
    // A value of the wrong type or range was replaced by a stand-in: what follows from that is no mistake.
    if (scene_->has_stand_ins.contains(name_)) return;
    if (!key.empty() && scene_->faulty.contains(dotted_name(name_, key))) return;
    const auto* table = static_cast<const toml::table*>(node_);
    const toml::node* node = table != nullptr && !key.empty() ? table->get(key) : nullptr;
    scene_->note(dotted_name(name_, key), node != nullptr ? node : table, message);
}

// ---------------------------------------------------------------- SceneFile

namespace {

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
        throw InputError(fmt::format("{}: cannot read the scene", path.string()));
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
    for (const auto& d : data_->declarations)
        values.push_back({d.section, d.key, d.value, d.unit, d.about, d.is_default});
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
