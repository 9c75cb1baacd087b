#include "common/run_summary.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "common/errors.hpp"

namespace common {

namespace {

using Json = nlohmann::ordered_json;

/// run.json writes a number that is not finite as null.
double number_or(const Json& value, double otherwise) {
    return value.is_number() ? value.get<double>() : otherwise;
}

void collect(const Json& node, const std::string& name, std::map<std::string, double>& figures) {
    if (node.is_number()) figures[name] = node.get<double>();
    if (!node.is_object()) return;
    for (const auto& [key, inner] : node.items())
        collect(inner, name.empty() ? key : name + "." + key, figures);
}

}  // namespace

std::optional<RunSummary> read_run_summary(const std::filesystem::path& folder) {
    const std::filesystem::path path = folder / "run.json";
    std::ifstream stream(path);
    if (!stream) return {};
    try {
        const Json record = Json::parse(stream);
        RunSummary summary{.stage = record.at("stage"),
                           .status = record.at("status"),
                           .message = record.at("message"),
                           .scene_digest = record.at("scene_digest"),
                           .input_digest = record.at("input_digest"),
                           .windows = record.at("windows"),
                           .wall_time = record.at("wall_time"),
                           .cpu_time = record.at("cpu_time"),
                           .peak_memory = record.at("peak_memory"),
                           .invariants = {},
                           .figures = {}};
        for (const auto& [name, entry] : record.at("invariants").items())
            summary.invariants.push_back(
                {.name = name,
                 .value = number_or(entry.at("value"), std::numeric_limits<double>::quiet_NaN()),
                 .unit = entry.at("unit"),
                 .bound = number_or(entry.at("bound"), std::numeric_limits<double>::infinity())});
        collect(record.value("figures", Json::object()), "", summary.figures);
        return summary;
    } catch (const Json::exception&) {
        throw InputError(fmt::format("{}: damaged, or not the record of a run", path.string()));
    }
}

bool holds(const InvariantRecord& invariant) {
    return std::isfinite(invariant.value) && std::abs(invariant.value) <= invariant.bound;
}

}  // namespace common
