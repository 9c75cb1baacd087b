/// The tree behind SceneFile and Section: TOML, what has been declared, and the mistakes found. Only the
/// files of scene reading include it.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace common {

namespace fs = std::filesystem;

/// A key as it was declared and used.
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

    /// "scene.toml:12:5", or the --set word that gave the key.
    std::string where(const std::string& dotted, const toml::node* node) const;
    /// Adds a mistake about a key.
    void note(const std::string& dotted, const toml::node* node, const std::string& message);
};

/// "dem.blocks" and "rows" make "dem.blocks.rows".
std::string dotted_name(const std::string& section, std::string_view key);

}  // namespace common
