/// Scene reading: one TOML file, typed keys with unit, range and default.
///
/// The same declarations that read a key also check it, print it (`check --all`), list it in run.json and
/// put it in the digest. Mistakes are collected, so that one run reports them all, a line each.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace common {

/// Interval of allowed values; open ends exclude the bound itself.
struct Range {
    double lowest = -std::numeric_limits<double>::infinity();
    double highest = std::numeric_limits<double>::infinity();
    bool lowest_is_open = false;
    bool highest_is_open = false;

    static Range any() { return {}; }
    static Range positive() { return {.lowest = 0, .lowest_is_open = true}; }
    static Range not_negative() { return {.lowest = 0}; }
    static Range between(double lowest, double highest) { return {.lowest = lowest, .highest = highest}; }
    static Range at_least(double lowest) { return {.lowest = lowest}; }
};

enum class Accuracy { draft, standard, fine };

using Point = std::array<double, 2>;  ///< x, z in m (or another pair of numbers)

class SceneFile;
struct SceneData;  // toml tree and what has been declared; only scene_file.cpp knows it

/// One table of the scene. Cheap to copy; refers to the SceneFile it came from.
///
/// Each read declares a key: `unit` ("m", "s", "-", ...), `about` (one phrase for the reference), the range
/// and the default; without a default the key is required. On a mistake the problem is noted and the default
/// (or a value inside the range) comes back, so that reading goes on; SceneFile::finish() throws if there was
/// any.
class Section {
 public:
    double number(std::string_view key, std::string_view unit, std::string_view about, Range range,
                  std::optional<double> fallback = {}) const;
    std::int64_t integer(std::string_view key, std::string_view about, Range range,
                         std::optional<std::int64_t> fallback = {}) const;
    bool boolean(std::string_view key, std::string_view about, std::optional<bool> fallback = {}) const;
    std::string text(std::string_view key, std::string_view about,
                     std::optional<std::string> fallback = {}) const;
    /// One of the listed words.
    std::string choice(std::string_view key, std::string_view about, const std::vector<std::string>& words,
                       std::optional<std::string> fallback = {}) const;
    /// A file name, taken relative to the scene's folder; must exist when given. Its content enters the
    /// digest. Empty path: not given (only with `required` false).
    std::filesystem::path file(std::string_view key, std::string_view about, bool required) const;
    /// [a, b, ...]; `count` 0 means any length.
    std::vector<double> numbers(std::string_view key, std::string_view unit, std::string_view about,
                                std::size_t count, Range range,
                                std::optional<std::vector<double>> fallback = {}) const;
    /// [[a, b, ...], ...] with `width` numbers in each row.
    std::vector<std::vector<double>> rows(
        std::string_view key, std::string_view unit, std::string_view about, std::size_t width,
        std::optional<std::vector<std::vector<double>>> fallback = {}) const;
    /// [[x, z], ...]
    std::vector<Point> points(std::string_view key, std::string_view unit, std::string_view about,
                              std::optional<std::vector<Point>> fallback = {}) const;
    /// [[[x, z], ...], ...]; a single polygon [[x, z], ...] is taken as a list of one.
    std::vector<std::vector<Point>> polygons(
        std::string_view key, std::string_view unit, std::string_view about,
        std::optional<std::vector<std::vector<Point>>> fallback = {}) const;

    /// The inner table `key`; reads of an absent one yield defaults. An inline table works the same way.
    Section table(std::string_view key) const;
    /// [[key]]: an array of tables, possibly empty.
    std::vector<Section> tables(std::string_view key) const;
    /// Keys present in this table, in file order, for tables with free names such as [gauges]: all count as
    /// known.
    std::vector<std::string> keys() const;
    /// True where the file (or --set) gives `key`.
    bool has(std::string_view key) const;
    /// True where the value of `key` is a table.
    bool is_table(std::string_view key) const;
    /// True where the value of `key` is a plain number.
    bool is_number(std::string_view key) const;
    /// True where the value of `key` is text.
    bool is_text(std::string_view key) const;

    /// Notes a mistake about `key` that only the stage can see ("gauge outside the flume"); finish() reports
    /// it with file, line and key. An empty key means the table itself. A key that already has a mistake gets
    /// no second one, and a table with a value of the wrong type or range is not judged further.
    void problem(std::string_view key, const std::string& message) const;

    /// Dotted name of this table ("dem.blocks").
    const std::string& name() const { return name_; }

 private:
    friend class SceneFile;
    Section(SceneData* scene, std::string name, const void* node)
        : scene_(scene), name_(std::move(name)), node_(node) {}
    SceneData* scene_;
    std::string name_;
    const void* node_;  // toml::table, null when absent
};

/// A key as it was used by this run.
struct SceneValue {
    std::string section, key, value, unit, about;
    bool is_default;
    std::string file_digest;  ///< of the file it names, empty for all other values
};

/// One scene (or layout) file with its overrides.
class SceneFile {
 public:
    /// Reads and parses. `overrides` are KEY=VALUE words of --set (dotted keys). Unknown sections are
    /// refused. Throws InputError when the file cannot be read or is not TOML.
    static SceneFile read(const std::filesystem::path& path, std::span<const std::string> overrides = {});
    /// The same from text, for tests and generated scenes; `name` stands for the path in messages.
    static SceneFile parse(std::string_view text, const std::string& name,
                           std::span<const std::string> overrides = {});
    ~SceneFile();
    SceneFile(SceneFile&&) noexcept;
    SceneFile& operator=(SceneFile&&) noexcept;

    /// Top-level table ("cmps", "dem"); dotted names reach inner ones ("cmps.flow").
    Section section(std::string_view name) const;
    /// A table that belongs to another stage, to read single keys of it: its other keys are not judged here.
    Section foreign_section(std::string_view name) const;
    /// The top level itself, for `title`.
    Section root() const;
    /// True where the scene says anything under this name, be it of the wrong kind.
    bool has_section(std::string_view name) const;
    /// `accuracy`, default standard.
    Accuracy accuracy() const;
    /// `perturbation`: member of an ensemble, 0: none (common/perturbation.hpp). In the digest unless 0.
    std::int64_t perturbation() const;

    /// True once a mistake was noted: what was read since holds stand-ins, and judging it would find mistakes
    /// that the user did not make.
    bool has_problems() const;
    /// Refuses unknown keys in every section that was read (nearest known name offered) and throws InputError
    /// with one line per mistake if there was any. Call it when everything has been read, before anything
    /// runs.
    void finish() const;

    /// Every declared key in order of declaration, with the value used.
    std::vector<SceneValue> values() const;
    /// The scene with every default filled in, as TOML with units and phrases: what `check --all` prints.
    std::string reference() const;
    /// Hexadecimal digest of the values used and of the files named, title left out; `upstream` (a digest) is
    /// mixed in.
    std::string digest(std::string_view upstream = {}) const;

    const std::filesystem::path& path() const;

 private:
    friend std::string require_same_scene(const SceneFile&, const std::filesystem::path&, const std::string&);
    explicit SceneFile(std::unique_ptr<SceneData> data);
    std::unique_ptr<SceneData> data_;
};

/// [effects] name = "auto" | "on" | "off".
enum class EffectWish { automatic, on, off };
EffectWish read_effect_wish(const SceneFile& scene, std::string_view effect);

}  // namespace common
