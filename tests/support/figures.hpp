/// Published figures for GoogleTest: the C++ twin of figures.py, where the rules and the columns are told.
///     EXPECT_TRUE(figures::error("boussinesq", "solitary wave after 100 depths: shape over H", error));
#pragma once

#include <fcntl.h>
#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace figures {

struct Row {
    std::string kind, value, unit, reference, n, standard_deviation, bound, why;
};
using Table = std::map<std::string, Row>;

inline constexpr double false_alarm = 1e-5;  ///< of one ensemble figure
inline constexpr double factor = 3.0;        ///< an error may grow to so many times the published one
inline constexpr const char* header = "name,kind,value,unit,reference,n,standard_deviation,bound,why";

inline bool is_recording() {
    const char* word = std::getenv("TSUNAGI_RECORD");
    return word != nullptr && std::string(word) == "1";
}

inline std::string path_of(const std::string& stage) {
    return std::string(TSUNAGI_SOURCE_DIR) + "/results/" + stage + ".csv";
}

inline Table read(const std::string& stage) {
    Table table;
    std::ifstream file(path_of(stage));
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::vector<std::string> cells;
        std::stringstream stream(line);
        for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
        cells.resize(9);
        table[cells[0]] = {cells[1], cells[2], cells[3], cells[4], cells[5], cells[6], cells[7], cells[8]};
    }
    return table;
}

/// Half width about the published mean of `n` in which the mean of `count` further members lies.
inline double band(double n, double spread, double count) {
    return gsl_cdf_tdist_Pinv(1 - false_alarm / 2, n - 1) * spread * std::sqrt(1 / n + 1 / count);
}

inline ::testing::AssertionResult record(const std::string& stage, const std::string& name, const Row& row) {
    if ((name + row.unit + row.why).find_first_of(",\"\n") != std::string::npos)
        throw std::invalid_argument(name + ": a name, unit or reason holds a comma, a quote or a line break");
    const int lock =
        ::open((std::string(TSUNAGI_SOURCE_DIR) + "/results/.lock").c_str(), O_CREAT | O_RDWR, 0644);
    ::flock(lock, LOCK_EX);  // tests record side by side
    Table table = read(stage);
    table[name] = row;
    std::ofstream file(path_of(stage));
    file << header << '\n';
    for (const auto& [key, r] : table)
        file << fmt::format("{},{},{},{},{},{},{},{},{}\n", key, r.kind, r.value, r.unit, r.reference, r.n,
                            r.standard_deviation, r.bound, r.why);
    file.close();
    ::close(lock);
    return ::testing::AssertionSuccess();
}

inline ::testing::AssertionResult verdict(bool holds, const std::string& text) {
    fmt::print("    {}\n", text);
    return (holds ? ::testing::AssertionSuccess() : ::testing::AssertionFailure()) << text;
}

/// The published row of this kind, or null.
inline const Row* published(const Table& table, const std::string& name, const std::string& kind) {
    const auto found = table.find(name);
    return found != table.end() && found->second.kind == kind ? &found->second : nullptr;
}

/// No farther from `reference` than three times the published figure.
inline ::testing::AssertionResult error(const std::string& stage, const std::string& name, double value,
                                        const std::string& unit = "", double reference = 0,
                                        const std::string& why = "") {
    if (is_recording())
        return record(stage, name,
                      {"error", fmt::format("{:.6g}", value), unit, fmt::format("{:.6g}", reference), "1",
                       "0", fmt::format("{:.3g}", factor * std::abs(value - reference)), why});
    const Table table = read(stage);
    const Row* row = published(table, name, "error");
    if (row == nullptr) return verdict(false, fmt::format("{}: results/{}.csv has no such row", name, stage));
    const double bound = factor * std::abs(std::stod(row->value) - std::stod(row->reference));
    const bool same_reference = std::stod(row->reference) == std::stod(fmt::format("{:.6g}", reference));
    return verdict(
        same_reference && std::abs(value - reference) <= bound,
        fmt::format("{}: {:.6g} {}, published {}, reference {:.6g} (no farther from it than {:.3g})", name,
                    value, unit, row->value, reference, bound));
}

/// The mean of `members` lies where one of so many is to be expected.
inline ::testing::AssertionResult ensemble(const std::string& stage, const std::string& name,
                                           const std::vector<double>& members, const std::string& unit = "",
                                           double reference = 0, const std::string& why = "") {
    const double count = static_cast<double>(members.size());
    double mean = 0, squares = 0;
    for (const double member : members) mean += member / count;
    for (const double member : members) squares += (member - mean) * (member - mean);
    if (is_recording()) {
        if (members.size() < 8)
            throw std::invalid_argument(name + ": record an ensemble with 8 members and more");
        const double spread = std::sqrt(squares / (count - 1));
        return record(stage, name,
                      {"ensemble", fmt::format("{:.6g}", mean), unit, fmt::format("{:.6g}", reference),
                       fmt::format("{}", members.size()), fmt::format("{:.3g}", spread),
                       fmt::format("{:.3g}", band(count, spread, 1)), why});
    }
    const Table table = read(stage);
    const Row* row = published(table, name, "ensemble");
    if (row == nullptr) return verdict(false, fmt::format("{}: results/{}.csv has no such row", name, stage));
    const double width = band(std::stod(row->n), std::stod(row->standard_deviation), count);
    return verdict(
        std::abs(mean - std::stod(row->value)) <= width,
        fmt::format("{}: {:.4g} {} in the mean of {}, published {} (n = {}, spread {}; within {:.3g})", name,
                    mean, unit, members.size(), row->value, row->n, row->standard_deviation, width));
}

/// Where the true mean of an ensemble figure lies, but for a chance of a false alarm: what a claim about it
/// has to hold for. Anything at all where nothing is published.
inline std::pair<double, double> published_interval(const std::string& stage, const std::string& name) {
    const Table table = read(stage);
    const Row* row = published(table, name, "ensemble");
    if (row == nullptr) return {-HUGE_VAL, HUGE_VAL};
    const double half = band(std::stod(row->n), std::stod(row->standard_deviation), HUGE_VAL),
                 mean = std::stod(row->value);
    return {mean - half, mean + half};
}

/// Below a limit known beforehand, which is what is published.
inline ::testing::AssertionResult limit(const std::string& stage, const std::string& name, double value,
                                        double limit, const std::string& unit = "",
                                        const std::string& why = "") {
    const std::string text = fmt::format("{:.6g}", limit);
    if (is_recording())
        return record(stage, name, {"limit", text, unit, "0", "1", "0", fmt::format("{:.3g}", limit), why});
    const Table table = read(stage);
    const Row* row = published(table, name, "limit");
    if (row == nullptr) return verdict(false, fmt::format("{}: results/{}.csv has no such row", name, stage));
    return verdict(std::stod(row->value) == std::stod(text) && std::abs(value) <= limit,
                   fmt::format("{}: {:.3g} {} (published: below {})", name, value, unit, row->value));
}

}  // namespace figures
