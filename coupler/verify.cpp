#include "coupler/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <list>
#include <map>

#include "common/errors.hpp"
#include "common/run_summary.hpp"
#include "common/window_channel.hpp"

namespace coupler {

namespace fs = std::filesystem;

namespace {

/// Times of windows are multiples of intervals, computed apart: allow their rounding.
constexpr double time_slack = 1e-9;

const std::map<std::string, std::vector<common::ExpectedDataset>> contract{
    {"boussinesq",
     {{"/time", "s", {"nt"}},
      {"/x", "m", {"nx"}},
      {"/still_water_depth", "m", {"nx"}},
      {"/surface_elevation", "m", {"nt", "nx"}},
      {"/velocity", "m/s", {"nt", "nx"}}}},
    {"cmps",
     {{"/flow/time", "s", {"nt"}},
      {"/flow/x", "m", {"nx"}},
      {"/flow/z", "m", {"nz"}},
      {"/flow/velocity", "m/s", {"nt", "nz", "nx", "2"}},
      {"/flow/acceleration", "m/s2", {"nt", "nz", "nx", "2"}},
      {"/flow/wet", "-", {"nt", "nz", "nx"}}}},
    {"dem",
     {{"/time", "s", {"nt"}},
      {"/blocks/position", "m", {"nt", "nb", "3"}},
      {"/blocks/orientation", "-", {"nt", "nb", "4"}},
      {"/blocks/velocity", "m/s", {"nt", "nb", "3"}},
      {"/blocks/angular_velocity", "rad/s", {"nt", "nb", "3"}}}}};

/// Largest index of a window in the folder, plus one.
std::int64_t windows_in(const fs::path& folder) {
    std::int64_t count = 0;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() == ".h5" && name.starts_with("window_"))
            count =
                std::max<std::int64_t>(count, std::atoll(name.c_str() + std::string("window_").size()) + 1);
    }
    return count;
}

void verify_run_record(const fs::path& folder, FolderReport& report) {
    const auto summary = common::read_run_summary(folder);
    if (!summary) {
        report.faults.push_back(fmt::format("{}: no such file", (folder / "run.json").string()));
        return;
    }
    const auto fault = [&](const std::string& what) {
        report.faults.push_back(fmt::format("{}: {}", (folder / "run.json").string(), what));
    };
    if (summary->status != "done")
        fault(fmt::format("the run is not done but {}{}{}", summary->status,
                          summary->message.empty() ? "" : ": ", summary->message));
    if (summary->windows != report.windows)
        fault(fmt::format("counts {} windows, the folder holds {}", summary->windows, report.windows));
    if (!report.scene_digest.empty() && summary->scene_digest != report.scene_digest)
        fault("its scene digest differs from that of the windows");
    for (const auto& invariant : summary->invariants)
        if (!common::holds(invariant))
            fault(fmt::format("invariant {} is {:.3g} {}, its bound is {:.3g}", invariant.name,
                              invariant.value, invariant.unit, invariant.bound));
}

/// The stage's own folder and those of further runs beside it: blocks, blocks_case1, blocks_case2.
std::vector<fs::path> folders_of(const fs::path& chain, const StagePlace& place) {
    std::vector<fs::path> folders;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(chain, error)) {
        const std::string name = entry.path().filename().string();
        if (entry.is_directory() && (name == place.folder || name.starts_with(place.folder + "_")))
            folders.push_back(entry.path());
    }
    std::sort(folders.begin(), folders.end());
    return folders;
}

}  // namespace

FolderReport verify_folder(const fs::path& folder, const std::string& stage) {
    FolderReport report;
    report.stage = stage;
    report.folder = folder.filename().string();
    report.windows = windows_in(folder);
    if (report.windows == 0) report.faults.push_back(fmt::format("{}: holds no windows", folder.string()));
    bool is_first = true, is_before_whole = true;
    for (std::int64_t index = 0; index < report.windows; ++index) {
        const fs::path path = common::window_path(folder, index);
        const auto fault = [&](const std::string& what) {
            report.faults.push_back(fmt::format("{}: {}", path.string(), what));
        };
        try {
            const common::Window window = common::read_window(path, stage, contract.at(stage));
            if (is_first) {
                report.t_begin = window.t_begin;
                report.scene_digest = window.scene_digest;
                report.input_digest = window.input_digest;
            } else {
                if (is_before_whole && std::abs(window.t_begin - report.t_end) > time_slack)
                    fault(fmt::format("begins at {} s, the window before it ends at {} s", window.t_begin,
                                      report.t_end));
                if (window.scene_digest != report.scene_digest || window.input_digest != report.input_digest)
                    fault("comes from another scene or input than the windows before it (digests differ)");
            }
            report.t_end = window.t_end;
            is_first = false;
            is_before_whole = true;
        } catch (const common::InputError& error) {
            report.faults.emplace_back(error.what());
            is_before_whole = false;
        }
    }
    try {
        verify_run_record(folder, report);
        for (const char* name : {"geometry.h5", "state.h5"})
            if (fs::exists(folder / name)) common::read_data_file(folder / name);
    } catch (const common::InputError& error) {
        report.faults.emplace_back(error.what());
    }
    return report;
}

void verify_input(FolderReport& report, const FolderReport& upstream) {
    if (report.windows == 0 || upstream.windows == 0) return;
    if (report.input_digest != upstream.scene_digest)
        report.faults.push_back(
            fmt::format("{}: was computed from other {} windows than those in {} (digests differ)",
                        report.folder, upstream.stage, upstream.folder));
    if (report.t_begin < upstream.t_begin - time_slack || report.t_end > upstream.t_end + time_slack)
        report.faults.push_back(fmt::format("{}: covers {} to {} s, its input in {} only {} to {} s",
                                            report.folder, report.t_begin, report.t_end, upstream.folder,
                                            upstream.t_begin, upstream.t_end));
}

int verify_chain(const fs::path& folder) {
    std::list<FolderReport> reports;  // verify_input refers back into it
    const FolderReport* upstream = nullptr;
    for (const auto& place : chain_stages) {
        const FolderReport* own = nullptr;
        for (const auto& runs : folders_of(folder, place)) {
            reports.push_back(verify_folder(runs, place.name));
            if (upstream != nullptr) verify_input(reports.back(), *upstream);
            if (runs.filename() == place.folder) own = &reports.back();
        }
        if (own != nullptr) upstream = own;
    }
    if (reports.empty())
        throw common::InputError(fmt::format("{}: holds none of waves, flow, blocks", folder.string()));
    bool is_sound = true;
    for (const auto& report : reports) {
        fmt::print("{:<12} {} windows of {}, {:.2f} to {:.2f} s: {}\n", report.folder, report.windows,
                   report.stage, report.t_begin, report.t_end,
                   report.faults.empty() ? "sound" : fmt::format("{} faults", report.faults.size()));
        is_sound = is_sound && report.faults.empty();
    }
    for (const auto& report : reports)
        for (const auto& fault : report.faults) fmt::print(stderr, "coupler: {}\n", fault);
    return is_sound ? common::exit_done : common::exit_failed;
}

}  // namespace coupler
