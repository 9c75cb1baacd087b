#include "coupler/status.hpp"

#include <fmt/format.h>

#include "common/chain_record.hpp"
#include "common/errors.hpp"
#include "common/folder_lock.hpp"
#include "common/run_summary.hpp"
#include "coupler/answer.hpp"
#include "coupler/board.hpp"
#include "coupler/stage_progress.hpp"

namespace coupler {

namespace fs = std::filesystem;

namespace {

/// A record that says "running" while nobody holds its folder was left by a killed process.
std::string status_now(const std::string& recorded, const fs::path& folder) {
    const bool is_gone = recorded == "running" && !common::is_locked(folder);
    return is_gone ? "died" : recorded;
}

}  // namespace

int show_status(const fs::path& folder) {
    const auto record = common::read_chain_record(folder);
    const std::string status = status_now(record.status, folder);
    fmt::print("{}: {}{}{}, {:.1f} s{}\n", folder.string(), status, record.message.empty() ? "" : ": ",
               record.message, record.wall_time,
               status == "died" ? "; its process is gone, --resume goes on from the last windows" : "");
    fmt::print("scene {}{}{}\n", record.scene, record.wires.empty() ? "" : ", layout ", record.wires);
    std::string answer;
    for (const auto& stage : record.stages) {
        const fs::path place = folder / stage.folder;
        StageProgress progress(stage.name, place, {.end = record.end, .window = record.window});
        progress.look();
        const auto& summary = progress.summary();
        fmt::print("{:<10}  {:<11}  {}\n", stage.name, status_now(stage.status, place), progress.describe());
        if (stage.name == "dem") answer = answer_of(place);
        if (!summary) continue;
        fmt::print("            {} windows, {:.1f} s, {:.1f} s of processor time, {}\n", summary->windows,
                   summary->wall_time, summary->cpu_time, memory_text(summary->peak_memory));
        for (const auto& invariant : summary->invariants)
            fmt::print(
                "            {} {:.3g} {}{}\n", invariant.name, invariant.value, invariant.unit,
                common::holds(invariant) ? "" : fmt::format(", out of its bound {:.3g}", invariant.bound));
    }
    if (!answer.empty()) fmt::print("answer: {}\n", answer);
    return common::exit_done;
}

}  // namespace coupler
