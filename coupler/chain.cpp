#include "coupler/chain.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <list>
#include <memory>
#include <thread>

#include "common/chain_record.hpp"
#include "common/errors.hpp"
#include "common/folder_lock.hpp"
#include "common/scene_file.hpp"
#include "coupler/answer.hpp"
#include "coupler/board.hpp"
#include "coupler/scene_check.hpp"
#include "coupler/stage_process.hpp"
#include "coupler/stage_progress.hpp"
#include "coupler/stages.hpp"

namespace coupler {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

namespace {

/// Tells one writing of a file from the next: it is replaced by renaming, so inode or time changes.
struct FileVersion {
    ino_t inode = 0;
    time_t seconds = 0;
    long nanoseconds = 0;
    bool operator==(const FileVersion&) const = default;
};

FileVersion version_of(const fs::path& path) {
    struct stat facts {};
    if (::stat(path.c_str(), &facts) != 0) return {};
    return {facts.st_ino, facts.st_mtim.tv_sec, facts.st_mtim.tv_nsec};
}

/// One stage of a running chain.
struct RunningStage {
    StagePlace place;
    fs::path folder;
    common::ChainStage& record;
    StageProgress progress;
    FileVersion run_record_before;
    std::unique_ptr<StageProcess> process;  // empty until started
    std::string last_message;
    bool was_told_to_stop = false;

    bool runs() const { return process && !process->has_ended(); }
    /// True once run.json is of this run: a follower that looked earlier could take an older run for this
    /// one.
    bool shows_itself() const {
        const FileVersion now = version_of(folder / "run.json");
        return now != FileVersion{} && now != run_record_before;
    }
};

class Chain {
 public:
    Chain(const Command& command, const std::vector<StagePlace>& places, common::TimeSection time);
    int run();

 private:
    void start_those_ready();
    void poll();
    RunningStage* find_failed();
    void note_ending(RunningStage& stage);
    void keep_cost_of_earlier_run(common::ChainStage& stage) const;
    bool is_over() const;
    void end_all(int signal);
    int fail(const RunningStage& cause);
    int interrupt();
    void write_record(const std::string& status, const std::string& message = {});
    void look();
    std::vector<std::string> lines();

    const Command& command_;
    common::ChainRecord record_;
    std::vector<common::ChainStage> earlier_stages_;  // as an earlier chain in this folder left them
    std::list<RunningStage> stages_;
    Board board_;
    Clock::time_point begun_ = Clock::now(), last_look_ = begun_;
};

Chain::Chain(const Command& command, const std::vector<StagePlace>& places, common::TimeSection time)
    : command_(command), board_(command.quiet) {
    record_.scene = fs::absolute(command.scene).string();
    if (!command.wires.empty()) record_.wires = fs::absolute(command.wires).string();
    record_.overrides = command.overrides;
    record_.end = time.end;
    record_.window = time.window;
    if (fs::exists(command.folder / "chain.json"))
        earlier_stages_ = common::read_chain_record(command.folder).stages;
    record_.stages.resize(places.size());  // not resized again: stages_ refers into it
    const fs::path programs = program_folder();
    fs::path upstream;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const StagePlace& place = places[i];
        const fs::path folder = command.folder / place.folder;
        std::vector<std::string> words{(programs / place.name).string(),
                                       "run",
                                       command.scene.string(),
                                       "--out",
                                       folder.string(),
                                       "--quiet"};
        if (!place.upstream_option.empty())
            words.insert(words.end(), {place.upstream_option, upstream.string(), "--follow"});
        if (place.name == "dem" && !command.wires.empty())
            words.insert(words.end(), {"--wires", command.wires.string()});
        if (command.threads > 1) words.insert(words.end(), {"--threads", std::to_string(command.threads)});
        if (command.resume) words.emplace_back("--resume");
        for (const auto& word : override_words(command)) words.push_back(word);
        record_.stages[i].name = place.name;
        record_.stages[i].folder = place.folder;
        record_.stages[i].command = words;
        stages_.push_back({.place = place,
                           .folder = folder,
                           .record = record_.stages[i],
                           .progress = StageProgress(place.name, folder, time),
                           .run_record_before = version_of(folder / "run.json"),
                           .process = nullptr,
                           .last_message = {}});
        upstream = folder;
    }
}

int Chain::run() {
    using namespace std::chrono_literals;
    write_record("running");
    try {
        while (!is_over()) {
            common::check_for_interrupt();
            start_those_ready();
            poll();
            if (find_failed() != nullptr) {
                // A stage whose upstream failed fails too, perhaps first to be seen: give the cause time to
                // show.
                std::this_thread::sleep_for(300ms);
                poll();
                common::check_for_interrupt();
                return fail(*find_failed());
            }
            look();
            if (board_.is_due()) board_.show(lines());
            std::this_thread::sleep_for(20ms);
        }
    } catch (const common::Interrupted&) {
        return interrupt();
    }
    board_.finish(lines());
    write_record("done");
    for (const auto& stage : stages_) {
        const std::string answer = stage.place.name == "dem" ? answer_of(stage.folder) : "";
        if (!answer.empty()) fmt::print("answer: {}\n", answer);
    }
    return common::exit_done;
}

void Chain::start_those_ready() {
    const RunningStage* before = nullptr;
    for (auto& stage : stages_) {
        const bool is_ready = before == nullptr ||
                              (before->process && (before->process->has_ended() || before->shows_itself()));
        if (!stage.process && is_ready) {
            stage.process = std::make_unique<StageProcess>(stage.record.command);
            stage.record.status = "running";
            write_record("running");
        }
        before = &stage;
    }
}

void Chain::poll() {
    for (auto& stage : stages_) {
        if (!stage.runs()) continue;
        stage.process->poll();
        const bool has_ended = stage.process->has_ended();
        for (const auto& message : stage.process->take_messages()) {
            stage.last_message = message;
            // The message a stage ends with is reported with its ending.
            if (!has_ended) board_.say(message);
        }
        if (has_ended) note_ending(stage);
    }
}

void Chain::note_ending(RunningStage& stage) {
    const Ending& ending = stage.process->ending();
    stage.record.exit_status = ending.status;
    stage.record.signal = ending.signal;
    stage.record.wall_time = ending.wall_seconds;
    stage.record.cpu_time = ending.cpu_seconds;
    stage.record.peak_memory = ending.peak_memory;
    if (ending.is_done() && !stage.shows_itself()) {
        stage.record.status = "unchanged";
        keep_cost_of_earlier_run(stage.record);
    } else if (ending.is_done())
        stage.record.status = "done";
    else
        stage.record.status = stage.was_told_to_stop ? "stopped" : "failed";
    const std::string prefix = stage.place.name + ": ";
    if (!ending.is_done())
        stage.record.message = stage.last_message.starts_with(prefix)
                                   ? stage.last_message.substr(prefix.size())
                                   : stage.last_message;
    write_record("running");
}

/// What the windows of an unchanged stage cost is what the run cost that made them.
void Chain::keep_cost_of_earlier_run(common::ChainStage& stage) const {
    for (const auto& earlier : earlier_stages_)
        if (earlier.name == stage.name && (earlier.status == "done" || earlier.status == "unchanged")) {
            stage.wall_time = earlier.wall_time;
            stage.cpu_time = earlier.cpu_time;
            stage.peak_memory = earlier.peak_memory;
        }
}

RunningStage* Chain::find_failed() {
    for (auto& stage : stages_)
        if (stage.record.status == "failed") return &stage;
    return nullptr;
}

bool Chain::is_over() const {
    for (const auto& stage : stages_)
        if (!stage.process || !stage.process->has_ended()) return false;
    return true;
}

void Chain::end_all(int signal) {
    using namespace std::chrono_literals;
    constexpr auto patience = 60s;  // a stage stops after its current step
    for (auto& stage : stages_) {
        stage.was_told_to_stop = true;
        if (stage.runs()) stage.process->send(signal);
    }
    const auto asked = Clock::now();
    const auto any_runs = [&] {
        for (const auto& stage : stages_)
            if (stage.runs()) return true;
        return false;
    };
    while (any_runs()) {
        if (Clock::now() - asked > patience)
            for (auto& stage : stages_)
                if (stage.runs()) stage.process->send(SIGKILL);
        std::this_thread::sleep_for(20ms);
        poll();
    }
}

int Chain::fail(const RunningStage& cause) {
    end_all(SIGTERM);
    const std::string how = cause.process->ending().describe();
    const std::string why =
        cause.record.message.empty() ? how : fmt::format("{}: {}", how, cause.record.message);
    board_.finish(lines());
    board_.say(
        fmt::format("coupler: {} failed, {}; the other stages were stopped, finished windows are kept in {}",
                    cause.place.name, why, command_.folder.string()));
    write_record("failed", fmt::format("{} failed: {}", cause.place.name, why));
    return cause.record.exit_status == common::exit_bad_input ? common::exit_bad_input : common::exit_failed;
}

int Chain::interrupt() {
    end_all(SIGINT);
    // On a terminal Ctrl-C reaches the stages as well, perhaps before this program.
    for (auto& stage : stages_)
        if (stage.record.status == "stopped" || stage.record.exit_status == common::exit_interrupted)
            stage.record.status = "interrupted";
    board_.finish(lines());
    board_.say(
        fmt::format("coupler: interrupted; finished windows are kept in {}, --resume goes on from them",
                    command_.folder.string()));
    write_record("interrupted");
    return common::exit_interrupted;
}

void Chain::write_record(const std::string& status, const std::string& message) {
    record_.status = status;
    record_.message = message;
    record_.wall_time = std::chrono::duration<double>(Clock::now() - begun_).count();
    common::write_chain_record(command_.folder, record_);
}

/// Reads how far the stages have come, a few times a second.
void Chain::look() {
    using namespace std::chrono_literals;
    if (command_.quiet || Clock::now() - last_look_ < 250ms) return;
    last_look_ = Clock::now();
    for (auto& stage : stages_)
        if (stage.runs() && stage.shows_itself()) stage.progress.look();
}

std::vector<std::string> Chain::lines() {
    std::vector<std::string> lines;
    for (auto& stage : stages_) {
        const bool has_ended = stage.process && stage.process->has_ended();
        if (has_ended) stage.progress.look();
        std::string text = stage.progress.describe();
        if (has_ended)
            text += fmt::format("{}{:.1f} s, {}", text.empty() ? "" : ", ", stage.record.wall_time,
                                memory_text(stage.record.peak_memory));
        lines.push_back(fmt::format("{:<10}  {:<11}  {}", stage.place.name, stage.record.status, text));
    }
    return lines;
}

}  // namespace

int run_chain(const Command& command) {
    const auto stages = stages_of(command);
    check_scene(command, stages);
    const auto time = common::read_time(common::SceneFile::read(command.scene, command.overrides));
    const common::FolderLock lock(command.folder, "chain");
    return Chain(command, stages, time).run();
}

}  // namespace coupler
