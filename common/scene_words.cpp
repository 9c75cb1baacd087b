#include "common/scene_words.hpp"

#include <algorithm>
#include <cmath>

namespace common {

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

std::string describe(const Range& range, const std::string& kind) {
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

double some_value_in(const Range& range) {
    const bool has_lowest = std::isfinite(range.lowest), has_highest = std::isfinite(range.highest);
    if (has_lowest && has_highest) return 0.5 * (range.lowest + range.highest);
    if (has_lowest) return range.lowest + 1;
    return has_highest ? range.highest - 1 : 1;
}

std::string in_quotes(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') result += '\\';
        result += c;
    }
    return result + "\"";
}

}  // namespace common
