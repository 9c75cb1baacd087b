#include "common/output_folder.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/run_record.hpp"
#include "common/window_channel.hpp"

namespace common {

namespace fs = std::filesystem;

namespace {

bool is_temporary(const std::string& name) {
    return name.starts_with(".") && name.ends_with(".tmp");
}

/// A file that a run of this program writes, and that a new run therefore replaces.
bool is_ours(const std::string& name) {
    return name == "state.h5" || name == "geometry.h5" || name == "run.json" ||
           (name.starts_with("window_") && name.ends_with(".h5"));
}

template <class Test>
void remove_files(const fs::path& folder, const Test& test) {
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.is_regular_file() && test(entry.path().filename().string())) fs::remove(entry.path());
}

/// True for a finished run of the same scene and input whose windows and state are all there and whole.
/// `is_damaged`: they would be, but for a fault.
bool is_finished(const fs::path& folder, const RunIdentity& identity, bool& is_damaged) {
    const UpstreamStatus status = read_upstream_status(folder);
    if (status.state != UpstreamStatus::State::done) return false;
    if (status.windows == 0) return false;
    try {
        for (std::int64_t k = 0; k < status.windows; ++k) {
            const Window window = read_window(window_path(folder, k), identity.stage, {});
            if (window.scene_digest != identity.scene_digest || window.input_digest != identity.input_digest)
                return false;
        }
        // Nothing is left to go on with, but other runs may start from it.
        read_data_file(folder / "state.h5");
    } catch (const InputError& fault) {
        fmt::print(stderr, "{}: {}: the finished run is damaged and is computed again\n", identity.stage,
                   fault.what());
        is_damaged = true;
        return false;
    }
    return true;
}

bool belongs_to(const DataFile& state, const RunIdentity& identity) {
    return state.text("stage") == identity.stage && state.text("scene_digest") == identity.scene_digest &&
           state.text("input_digest") == identity.input_digest;
}

/// A run that starts anew where windows of an earlier one stand says so.
void say_what_is_replaced(const fs::path& folder, const RunIdentity& identity) {
    const auto earlier = read_upstream_status(folder);
    if (earlier.windows == 0) return;
    bool could_go_on = false;
    try {
        could_go_on = belongs_to(read_data_file(folder / "state.h5"), identity);
    } catch (const InputError&) {
        // without a state that can be read, the earlier run could not have been gone on with
    }
    fmt::print(stderr, "{}: {}: the {} windows of an earlier run are replaced{}\n", identity.stage,
               folder.string(), earlier.windows,
               could_go_on ? "; --resume would have gone on from them" : "");
}

}  // namespace

OutputFolder::OutputFolder(fs::path folder, RunIdentity identity, bool resume)
    : folder_(std::move(folder)), identity_(std::move(identity)), lock_(folder_, "run") {
    if (const std::string stage = read_upstream_status(folder_).stage;
        !stage.empty() && stage != identity_.stage)
        throw InputError(fmt::format("{}: holds a run of {}; give {} a folder of its own", folder_.string(),
                                     stage, identity_.stage));
    remove_files(folder_, is_temporary);

    bool is_damaged = false;
    if (is_finished(folder_, identity_, is_damaged)) {
        start_ = Start::nothing_to_do;
        return;
    }
    const fs::path state = folder_ / "state.h5";
    if (resume && !is_damaged && fs::exists(state)) {
        DataFile saved = read_data_file(state);
        if (!belongs_to(saved, identity_))
            throw InputError(fmt::format("{}: belongs to another {}; run without --resume to start anew",
                                         state.string(),
                                         saved.text("input_digest") == identity_.input_digest
                                             ? "scene"
                                             : "input (what it was computed from has changed)"));
        next_window_ = saved.integer("next_window");
        start_ = Start::go_on;
        for (std::int64_t k = 0; k < next_window_; ++k)  // goes on only from windows that are all whole
            read_window(window_path(folder_, k), identity_.stage, {});
        state_ = std::move(saved);
        return;
    }
    say_what_is_replaced(folder_, identity_);
    remove_files(folder_, is_ours);
}

void OutputFolder::publish(Window window, DataFile state) {
    window.stage = identity_.stage;
    window.scene_digest = identity_.scene_digest;
    window.input_digest = identity_.input_digest;
    publish_window(folder_, window);
    state.attributes["schema"] = fmt::format("tsunagi.{}.state/1", identity_.stage);
    state.attributes["stage"] = identity_.stage;
    state.attributes["scene_digest"] = identity_.scene_digest;
    state.attributes["input_digest"] = identity_.input_digest;
    state.attributes["next_window"] = window.index + 1;
    state.attributes["t"] = window.t_end;
    write_data_file(folder_ / "state.h5", state);
    next_window_ = window.index + 1;
}

void OutputFolder::write_geometry(DataFile geometry) const {
    geometry.attributes["schema"] = fmt::format("tsunagi.{}.geometry/1", identity_.stage);
    geometry.attributes["scene_digest"] = identity_.scene_digest;
    write_data_file(folder_ / "geometry.h5", geometry);
}

}  // namespace common
