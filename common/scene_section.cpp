#include <fmt/format.h>

#include <fmt/ranges.h>
#include <cmath>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "common/digest.hpp"
#include "common/scene_file.hpp"
#include "common/scene_tree.hpp"
#include "common/scene_words.hpp"

namespace common {

namespace {

std::string kind_of(const toml::node& node) {
    if (node.is_string()) return fmt::format("text \"{}\"", node.as_string()->get());
    if (node.is_boolean()) return node.as_boolean()->get() ? "true" : "false";
    if (node.is_integer()) return fmt::format("{}", node.as_integer()->get());
    if (node.is_floating_point()) return fmt::format("{}", node.as_floating_point()->get());
    if (node.is_array()) return fmt::format("a list of {}", node.as_array()->size());
    if (node.is_table()) return "a table";
    return "a date or time";
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
        // Products of such numbers leave the range of floating point, far from the key that is to blame.
        const double size = std::abs(*value);
        if (std::isfinite(size) && size != 0.0 && (size < 1e-30 || size > 1e30)) {
            expected("a number whose size can be reckoned with, 1e-30 to 1e30", got);
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

}  // namespace common
