/// Words of messages about scenes: ranges, values as text, the nearest known name.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "common/scene_file.hpp"

namespace common {

/// Letters to change, add or leave out to get from one word to the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// "; did you mean 'height'?", or nothing when no name is near.
template <class Names>
std::string suggestion(std::string_view word, const Names& names) {
    std::string best;
    std::size_t least = word.size() / 2 + 2;
    for (const auto& name : names) {
        const std::size_t distance = edit_distance(word, name);
        if (distance < least) {
            least = distance;
            best = name;
        }
    }
    return best.empty() ? std::string() : fmt::format("; did you mean '{}'?", best);
}

/// "a number from 1 to 5", "a whole number above 0"; `kind` is what stands before the range.
std::string describe(const Range& range, const std::string& kind = "a number");
bool contains(const Range& range, double value);
/// A number inside the range, to go on with after a mistake.
double some_value_in(const Range& range);

/// The text as TOML writes it.
std::string in_quotes(const std::string& text);

/// "[1, 2]", "[[0, 1], [2, 3]]"
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

}  // namespace common
