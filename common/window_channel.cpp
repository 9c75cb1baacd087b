#include "common/window_channel.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <set>
#include <thread>

#include "common/errors.hpp"
#include "common/run_record.hpp"

namespace common {

namespace fs = std::filesystem;

namespace {

std::string schema_of(const std::string& stage) {
    return fmt::format("tsunagi.{}.window/1", stage);
}

bool is_time(const std::string& dataset) {
    return dataset == "/time" || dataset.ends_with("/time");
}

/// Index of the first value that is not finite, or the count when all are.
std::size_t first_not_finite(const Dataset& dataset) {
    return std::visit(
        []<class T>(const std::vector<T>& values) {
            if constexpr (std::is_floating_point_v<T>) {
                const auto bad =
                    std::find_if(values.begin(), values.end(), [](T v) { return !std::isfinite(v); });
                return static_cast<std::size_t>(bad - values.begin());
            } else {
                return values.size();
            }
        },
        dataset.values);
}

/// Empty when the window's values may be published, else what is wrong.
std::string fault_of_values(const Window& window) {
    for (const auto& [name, dataset] : window.datasets) {
        const std::size_t bad = first_not_finite(dataset);
        if (bad < dataset.size()) return fmt::format("dataset {} is not finite at element {}", name, bad);
        if (!is_time(name)) continue;
        const auto times = dataset.as_double();
        // Times are computed as multiples of intervals: allow their rounding.
        const double slack = 1e-9 * std::max(1.0, std::abs(window.t_end));
        for (std::size_t i = 0; i < times.size(); ++i) {
            if (i > 0 && times[i] <= times[i - 1])
                return fmt::format("dataset {} does not increase at element {}", name, i);
            if (times[i] < window.t_begin - slack || times[i] > window.t_end + slack)
                return fmt::format("dataset {} leaves the window at element {}", name, i);
        }
    }
    return {};
}

/// Checks names, units and shapes; equal extent names must agree over all datasets.
void check_expected(const DataFile& file, const std::vector<ExpectedDataset>& expected,
                    const fs::path& path) {
    std::map<std::string, std::size_t> extents;
    for (const auto& wanted : expected) {
        const auto found = file.datasets.find(wanted.name);
        if (found == file.datasets.end())
            throw InputError(fmt::format("{}: dataset {} is missing", path.string(), wanted.name));
        const Dataset& dataset = found->second;
        if (dataset.unit != wanted.unit)
            throw InputError(fmt::format("{}: dataset {} has units '{}', expected '{}'", path.string(),
                                         wanted.name, dataset.unit, wanted.unit));
        bool agrees = dataset.shape.size() == wanted.shape.size();
        for (std::size_t i = 0; agrees && i < wanted.shape.size(); ++i) {
            const bool is_number = std::isdigit(static_cast<unsigned char>(wanted.shape[i][0])) != 0;
            const std::size_t extent =
                is_number ? std::stoul(wanted.shape[i])
                          : extents.try_emplace(wanted.shape[i], dataset.shape[i]).first->second;
            agrees = extent == dataset.shape[i];
        }
        if (!agrees)
            throw InputError(fmt::format("{}: dataset {} has shape ({}), expected ({})", path.string(),
                                         wanted.name, fmt::join(dataset.shape, ", "),
                                         fmt::join(wanted.shape, ", ")));
    }
}

/// Index in "window_000042.h5", or nothing.
std::optional<std::int64_t> index_of(const fs::path& path) {
    const std::string name = path.filename().string();
    constexpr std::size_t prefix = 7;  // "window_"
    if (!name.starts_with("window_") || !name.ends_with(".h5") || name.size() < prefix + 9) return {};
    const std::string digits = name.substr(prefix, name.size() - prefix - 3);
    if (!std::all_of(digits.begin(), digits.end(), [](unsigned char c) { return std::isdigit(c) != 0; }))
        return {};
    return std::stoll(digits);
}

std::set<std::int64_t> indices_in(const fs::path& folder) {
    std::set<std::int64_t> indices;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error))
        if (const auto index = index_of(entry.path())) indices.insert(*index);
    return indices;
}

}  // namespace

fs::path window_path(const fs::path& folder, std::int64_t index) {
    return folder / fmt::format("window_{:06d}.h5", index);
}

void publish_window(const fs::path& folder, const Window& window) {
    const fs::path path = window_path(folder, window.index);
    if (const std::string fault = fault_of_values(window); !fault.empty())
        throw RunError(fmt::format("{}: not published: {}", path.string(), fault));
    write_data_file(path, {.attributes = {{"schema", schema_of(window.stage)},
                                          {"stage", window.stage},
                                          {"index", window.index},
                                          {"t_begin", window.t_begin},
                                          {"t_end", window.t_end},
                                          {"scene_digest", window.scene_digest},
                                          {"input_digest", window.input_digest}},
                           .datasets = window.datasets});
}

Window read_window(const fs::path& path, const std::string& stage,
                   const std::vector<ExpectedDataset>& expected) {
    // The schema first: of a file of another kind the shapes say nothing.
    DataFile file = read_data_file(path, [&](const DataFile& header) {
        const std::string schema = header.text("schema");
        if (schema != schema_of(stage))
            throw InputError(
                fmt::format("{}: schema is '{}', expected '{}'", path.string(), schema, schema_of(stage)));
        check_expected(header, expected, path);
    });
    Window window;
    try {
        window.stage = file.text("stage");
        window.index = file.integer("index");
        window.t_begin = file.number("t_begin");
        window.t_end = file.number("t_end");
        window.scene_digest = file.text("scene_digest");
        window.input_digest = file.text("input_digest");
    } catch (const InputError& error) {
        throw InputError(fmt::format("{}: {}", path.string(), error.what()));
    }
    if (const auto named = index_of(path); named && *named != window.index)
        throw InputError(fmt::format("{}: holds window {}", path.string(), window.index));
    if (!(window.t_begin < window.t_end))
        throw InputError(fmt::format("{}: ends ({} s) before it begins ({} s)", path.string(), window.t_end,
                                     window.t_begin));
    window.datasets = std::move(file.datasets);
    if (const std::string fault = fault_of_values(window); !fault.empty())
        throw InputError(fmt::format("{}: {}", path.string(), fault));
    return window;
}

WindowReader::WindowReader(fs::path folder, std::string stage, std::vector<ExpectedDataset> expected,
                           bool follow)
    : folder_(std::move(folder)), stage_(std::move(stage)), expected_(std::move(expected)), follow_(follow) {}

bool WindowReader::wait_for(const fs::path& path) {
    using namespace std::chrono_literals;
    constexpr auto patience = 20ms;       // a look at a folder costs microseconds
    constexpr auto start_patience = 60s;  // an upstream stage has this long to show its run.json
    const auto begun = std::chrono::steady_clock::now();
    while (!fs::exists(path)) {
        if (!follow_) return false;
        check_for_interrupt();
        const UpstreamStatus status = read_upstream_status(folder_);
        // The window may have come between the two looks.
        if (fs::exists(path)) return true;
        switch (status.state) {
            case UpstreamStatus::State::done:
                return false;
            case UpstreamStatus::State::failed:
            case UpstreamStatus::State::interrupted:
            case UpstreamStatus::State::died:
                throw RunError(fmt::format("{}: the {} stage ended before {} was written{}{}",
                                           folder_.string(), stage_, path.filename().string(),
                                           status.message.empty() ? "" : ": ", status.message));
            case UpstreamStatus::State::absent:
                if (std::chrono::steady_clock::now() - begun > start_patience)
                    throw RunError(fmt::format("{}: no {} stage started writing here within 60 s",
                                               folder_.string(), stage_));
                break;
            case UpstreamStatus::State::running:
                break;
        }
        // The first wait only: later on an upstream stage may be slow without being at fault.
        const bool is_absent = status.state == UpstreamStatus::State::absent;
        if (!first_ && !has_told_ && std::chrono::steady_clock::now() - begun > (is_absent ? 2s : 30s)) {
            has_told_ = true;
            fmt::print(
                stderr, "{}: waits for {} of the {} stage{}\n", folder_.string(), path.filename().string(),
                stage_,
                is_absent ? ", which has not started there (gives up after 60 s)" : ", which is running");
        }
        std::this_thread::sleep_for(patience);
    }
    return true;
}

std::optional<Window> WindowReader::receive(std::int64_t index) {
    const fs::path path = window_path(folder_, index);
    if (!wait_for(path)) {
        const auto indices = indices_in(folder_);
        if (indices.upper_bound(index) != indices.end())
            throw InputError(fmt::format("{}: missing, although later windows are there", path.string()));
        return {};
    }
    Window window = read_window(path, stage_, expected_);
    if (first_ &&
        (window.scene_digest != first_->scene_digest || window.input_digest != first_->input_digest))
        throw InputError(fmt::format("{}: comes from another scene than {} (digests differ)", path.string(),
                                     window_path(folder_, first_->index).filename().string()));
    if (!first_) first_ = window;
    return window;
}

const Window& WindowReader::first() {
    if (!first_) {
        if (!follow_ && !fs::is_directory(folder_))
            throw InputError(
                fmt::format("{}: no such folder (expected windows of {})", folder_.string(), stage_));
        if (!receive(0))
            throw InputError(fmt::format("{}: holds no windows of {}", folder_.string(), stage_));
    }
    return *first_;
}

std::optional<std::int64_t> WindowReader::index_at(double t) {
    constexpr double rounding = 1e-9;  // s: times are whole nanoseconds but for their last bits
    const Window& begin = first();
    if (t < begin.t_begin - rounding) return {};
    for (std::int64_t index = begin.index;; ++index) {
        const auto window = receive(index);
        if (!window) return {};
        if (t < window->t_end - rounding) return index;
    }
}

double WindowReader::available_until() {
    const auto indices = indices_in(folder_);
    if (indices.empty()) return std::numeric_limits<double>::quiet_NaN();
    return read_window(window_path(folder_, *indices.rbegin()), stage_, expected_).t_end;
}

}  // namespace common
