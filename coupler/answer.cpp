#include "coupler/answer.hpp"

#include <fmt/format.h>

#include "common/run_summary.hpp"

namespace coupler {

std::string answer_of(const std::filesystem::path& blocks_folder) {
    const auto summary = common::read_run_summary(blocks_folder);
    if (!summary || !summary->figures.contains("damage.free_blocks")) return {};
    const auto figure = [&](const std::string& name) { return summary->figures.at(name); };
    std::string text = fmt::format(
        "of {:.0f} free blocks {:.0f} moved beyond 0.25 of their length, {:.0f} beyond 0.5, {:.0f} beyond 1 "
        "(N_od {:.2g}); ",
        figure("damage.free_blocks"), figure("damage.beyond_quarter_length"),
        figure("damage.beyond_half_length"), figure("damage.beyond_length"), figure("damage.number"));
    text += figure("wires.count") == 0
                ? "no wires"
                : fmt::format("{:.0f} of {:.0f} wires broke, largest tension {:.3g} N",
                              figure("wires.broken"), figure("wires.count"), figure("wires.largest_tension"));
    if (summary->figures.contains("wires.largest_share_of_breaking"))
        text += fmt::format(", {:.2g} of breaking", figure("wires.largest_share_of_breaking"));
    if (summary->status != "done") text += fmt::format(" (so far, to t = {:.4g} s)", figure("clock.end"));
    return text;
}

}  // namespace coupler
