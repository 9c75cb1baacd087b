#include "boussinesq/csv_table.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <string_view>

#include "common/errors.hpp"

namespace boussinesq {
namespace {

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> words(1);
    for (const char c : line) {
        if (c == ',')
            words.emplace_back();
        else if (c != ' ' && c != '\t' && c != '\r')
            words.back() += c;
    }
    return words;
}

}  // namespace

const std::vector<double>* CsvTable::column(const std::vector<std::string>& aliases) const {
    for (const auto& alias : aliases)
        for (std::size_t i = 0; i < names.size(); ++i)
            if (names[i] == alias) return &columns[i];
    return nullptr;
}

CsvTable read_csv(const std::filesystem::path& path) {
    std::ifstream input(path);
    if (!input) throw common::InputError(fmt::format("{}: cannot be read", path.string()));
    CsvTable table;
    std::string line;
    for (std::size_t number = 1; std::getline(input, line); ++number) {
        if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // byte order mark
        if (line.empty() || line[0] == '#' || line == "\r") continue;
        const auto words = split(line);
        if (table.names.empty()) {
            table.names = words;
            for (std::size_t i = 0; i < words.size(); ++i)
                for (std::size_t j = 0; j < i; ++j)
                    if (words[i] == words[j])
                        throw common::InputError(fmt::format("{}:{}: two columns are named '{}'",
                                                             path.string(), number, words[i]));
            table.columns.resize(words.size());
            continue;
        }
        if (words.size() != table.names.size())
            throw common::InputError(fmt::format("{}:{}: {} values, but the header names {} columns",
                                                 path.string(), number, words.size(), table.names.size()));
        for (std::size_t i = 0; i < words.size(); ++i) {
            double value = 0;
            const auto [end, error] =
                std::from_chars(words[i].data(), words[i].data() + words[i].size(), value);
            if (error != std::errc() || end != words[i].data() + words[i].size() || !std::isfinite(value))
                throw common::InputError(fmt::format("{}:{}: column '{}': '{}' is not a finite number",
                                                     path.string(), number, table.names[i], words[i]));
            table.columns[i].push_back(value);
        }
        table.lines.push_back(number);
    }
    if (table.lines.empty())
        throw common::InputError(
            fmt::format("{}: expected a header line and rows of numbers", path.string()));
    return table;
}

}  // namespace boussinesq
