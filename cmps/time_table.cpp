#include "cmps/time_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>

#include "common/errors.hpp"

namespace cmps {

namespace {

/// True for a line of words: "nan" and "inf" are numbers, though none that a table may hold.
bool is_head(const std::string& line) {
    std::istringstream words(line);
    std::string first;
    words >> first;
    char* end = nullptr;
    std::strtod(first.c_str(), &end);
    return end == first.c_str() || (*end != '\0' && std::isalpha(static_cast<unsigned char>(first[0])) != 0);
}

}  // namespace

TimeTable::TimeTable(const std::filesystem::path& file, std::size_t columns) : columns_(columns) {
    std::ifstream stream(file);
    if (!stream) throw common::InputError(fmt::format("{}: cannot be read", file.string()));
    std::string line;
    for (int number = 1; std::getline(stream, line); ++number) {
        std::replace(line.begin(), line.end(), ',', ' ');
        const auto start = line.find_first_not_of(" \t\r");
        if (start == std::string::npos || line[start] == '#') continue;
        if (columns_[0].empty() && is_head(line)) continue;
        std::istringstream words(line);
        for (std::size_t c = 0; c < columns; ++c) {
            double value = 0;
            if (!(words >> value) || !std::isfinite(value))
                throw common::InputError(
                    fmt::format("{}:{}: expected {} numbers", file.string(), number, columns));
            columns_[c].push_back(value);
        }
        const auto& t = columns_[0];
        if (t.size() > 1 && t.back() <= t[t.size() - 2])
            throw common::InputError(fmt::format("{}:{}: time does not increase", file.string(), number));
    }
    if (columns_[0].size() < 2)
        throw common::InputError(fmt::format("{}: expected at least two lines of numbers", file.string()));

    const auto& t = columns_[0];
    const std::size_t n = t.size();
    slopes_.assign(columns, std::vector<double>(n, 0.0));
    for (std::size_t c = 1; c < columns; ++c) {  // Steffen (1990), eq. 11 and its one-sided ends
        const auto& f = columns_[c];
        const auto secant = [&](std::size_t i) { return (f[i + 1] - f[i]) / (t[i + 1] - t[i]); };
        const auto sign = [](double a) { return a < 0 ? -1.0 : 1.0; };
        slopes_[c][0] = secant(0), slopes_[c][n - 1] = secant(n - 2);
        for (std::size_t i = 1; i + 1 < n; ++i) {
            const double left = t[i] - t[i - 1], right = t[i + 1] - t[i], a = secant(i - 1), b = secant(i);
            const double p = (a * right + b * left) / (left + right);
            slopes_[c][i] = (sign(a) + sign(b)) * std::min({std::abs(a), std::abs(b), 0.5 * std::abs(p)});
        }
    }
}

double TimeTable::value(std::size_t column, double time) const {
    const auto &t = columns_[0], &f = columns_[column], &slope = slopes_[column];
    if (time <= t.front()) return f.front();
    if (time >= t.back()) return f.back();
    const std::size_t k =
        static_cast<std::size_t>(std::upper_bound(t.begin(), t.end(), time) - t.begin()) - 1;
    const double h = t[k + 1] - t[k], s = (time - t[k]) / h;
    return (1 + 2 * s) * (1 - s) * (1 - s) * f[k] + s * (1 - s) * (1 - s) * h * slope[k] +
           s * s * (3 - 2 * s) * f[k + 1] + s * s * (s - 1) * h * slope[k + 1];
}

double TimeTable::mean(std::size_t column, double from, double to) const {
    const auto& t = columns_[0];
    double sum = 0, begin = from;
    for (auto knot = std::upper_bound(t.begin(), t.end(), from); begin < to; ++knot) {
        const double end = knot == t.end() ? to : std::min(*knot, to);
        // Simpson's rule: exact for the cubics between rows
        sum += (end - begin) / 6.0 *
               (value(column, begin) + 4.0 * value(column, 0.5 * (begin + end)) + value(column, end));
        if (knot == t.end()) break;
        begin = end;
    }
    return sum / (to - from);
}

std::array<double, 2> TimeTable::range(std::size_t column) const {
    const auto [least, greatest] = std::minmax_element(columns_[column].begin(), columns_[column].end());
    return {*least, *greatest};
}

double TimeTable::period(std::size_t column) const {
    const auto& values = columns_[column];
    const auto [least, greatest] = range(column);
    const double back = 0.1 * (greatest - least);
    std::size_t farthest = 0, turns = 0;
    double direction = 0, first = 0, last = 0;  // direction 0: it has not moved yet
    for (std::size_t i = 1; i < values.size(); ++i) {
        const double way = values[i] - values[farthest];
        if (direction * way > 0) farthest = i;
        if (direction * way > 0 || std::abs(way) <= back) continue;
        if (direction != 0) {
            last = columns_[0][farthest];
            if (++turns == 1) first = last;
        }
        direction = way > 0 ? 1.0 : -1.0, farthest = i;
    }
    return turns < 3 ? 0.0 : 2.0 * (last - first) / static_cast<double>(turns - 1);
}

double TimeTable::fastest(std::size_t column) const {
    double rate = 0;
    for (std::size_t i = 0; i + 1 < columns_[0].size(); ++i)
        rate = std::max(rate, std::abs(columns_[column][i + 1] - columns_[column][i]) /
                                  (columns_[0][i + 1] - columns_[0][i]));
    return rate;
}

}  // namespace cmps
