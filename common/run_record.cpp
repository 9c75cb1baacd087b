#include "common/run_record.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <cmath>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/build_information.hpp"
#include "common/data_file.hpp"

namespace common {

using Json = nlohmann::ordered_json;

struct RunRecord::Content {
    Json scene = Json::object(), input, effects = Json::object(), invariants = Json::object(),
         figures = Json::object(), notes = Json::object();
    std::string scene_digest, input_digest, begun;
    std::map<std::string, double> phases;
};

namespace {

std::string host_name() {
    utsname name{};
    uname(&name);
    return name.nodename;
}

/// Text of the scene value as JSON where it is one ("0.4", "true", "[1, 2]"), else as text.
Json scene_value(const std::string& text) {
    Json value = Json::parse(text, nullptr, false);
    return value.is_discarded() ? Json(text) : value;
}

/// JSON has no infinity: such a number is written as null.
Json number_or_null(double value) {
    return std::isfinite(value) ? Json(value) : Json();
}

/// A part in quotes is one name, whatever it holds; it ends with the last quote before a dot or the end.
Json& nested(Json& root, const std::string& dotted) {
    Json* node = &root;
    std::size_t from = 0;
    while (true) {
        const bool is_quoted = dotted.compare(from, 1, "\"") == 0;
        const auto closing = is_quoted ? dotted.rfind('"') : from;
        const auto dot = dotted.find('.', closing);
        const std::string part =
            is_quoted ? dotted.substr(from + 1, closing - from - 1) : dotted.substr(from, dot - from);
        node = &(*node)[part];
        if (dot == std::string::npos) return *node;
        from = dot + 1;
    }
}

}  // namespace

RunRecord::RunRecord(std::filesystem::path folder, std::string stage)
    : folder_(std::move(folder)), stage_(std::move(stage)), content_(std::make_shared<Content>()) {
    content_->begun = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

void RunRecord::describe_scene(const SceneFile& scene) {
    content_->scene["file"] = scene.path().string();
    Json values = Json::object();
    for (const auto& value : scene.values()) {
        Json& entry = values[value.section][value.key];
        entry = {{"value", scene_value(value.value)}, {"unit", value.unit}, {"default", value.is_default}};
        if (!value.file_digest.empty()) entry["digest"] = value.file_digest;
    }
    content_->scene["values"] = std::move(values);
}

void RunRecord::describe_input(const std::filesystem::path& folder) {
    std::ifstream stream(folder / "run.json");
    const Json record = stream ? Json::parse(stream, nullptr, false) : Json();
    if (!record.is_object()) return;
    for (const char* name : {"stage", "scene", "input"})
        if (record.contains(name)) content_->input[name] = record[name];
}

void RunRecord::set_digests(const std::string& scene_digest, const std::string& input_digest) {
    content_->scene_digest = scene_digest;
    content_->input_digest = input_digest;
}

void RunRecord::set_effects(std::vector<EffectRecord> effects) {
    content_->effects = Json::object();
    for (const auto& effect : effects)
        content_->effects[effect.name] = {{"on", effect.is_on}, {"reason", effect.reason}};
}

void RunRecord::set_invariant(const InvariantRecord& invariant) {
    content_->invariants[invariant.name] = {
        {"value", number_or_null(invariant.value)},
        {"unit", invariant.unit},
        {"bound", number_or_null(invariant.bound)},
        {"holds", std::isfinite(invariant.value) && std::abs(invariant.value) <= invariant.bound}};
}

void RunRecord::set_figure(const std::string& name, double value) {
    nested(content_->figures, name) = number_or_null(value);
}
void RunRecord::set_note(const std::string& name, const std::string& text) {
    nested(content_->notes, name) = text;
}
void RunRecord::set_series(const std::string& name, const std::vector<double>& values) {
    nested(content_->figures, name) = values;
}
void RunRecord::add_phase_time(const std::string& phase, double seconds) {
    content_->phases[phase] += seconds;
}

void RunRecord::write_running() {
    write("running", "");
}
void RunRecord::write_ended(const std::string& status, const std::string& message) {
    write(status, message);
    // A run that went wrong without stopping must not look like one that went well.
    for (const auto& [name, invariant] : content_->invariants.items())
        if (invariant["holds"] == false)
            fmt::print(stderr, "{}: warning: {} is {} {}, bound {}: do not trust this run\n", stage_, name,
                       invariant["value"].dump(), invariant["unit"].get<std::string>(),
                       invariant["bound"].dump());
}

void RunRecord::write(const std::string& status, const std::string& message) {
    const BuildInformation& build = build_information();
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    Json phases = Json::object();
    for (const auto& [name, time] : content_->phases)
        phases[name] = {{"seconds", time}, {"share", wall > 0 ? time / wall : 0}};
    for (auto& [name, effect] : content_->effects.items())
        if (effect["on"] == true && phases.contains(name)) effect["share_of_time"] = phases[name]["share"];
    Json record = {{"schema", "tsunagi.run/1"},
                   {"stage", stage_},
                   {"status", status},
                   {"message", message},
                   {"version", build.version},
                   {"revision", build.revision},
                   {"compiler", build.compiler},
                   {"flags", build.flags},
                   {"processor", processor_name()},
                   {"host", host_name()},
                   {"pid", ::getpid()},
                   {"begun", content_->begun},
                   {"windows", windows_},
                   {"scene_digest", content_->scene_digest},
                   {"input_digest", content_->input_digest},
                   {"wall_time", wall},
                   {"cpu_time", seconds(usage.ru_utime) + seconds(usage.ru_stime)},
                   {"peak_memory", peak_memory()},
                   {"effects", content_->effects},
                   {"invariants", content_->invariants},
                   {"figures", content_->figures},
                   {"notes", content_->notes},
                   {"phases", phases},
                   {"scene", content_->scene}};
    if (!content_->input.is_null()) record["input"] = content_->input;
    write_text_file(folder_ / "run.json", record.dump(1) + "\n");
}

UpstreamStatus read_upstream_status(const std::filesystem::path& folder) {
    using State = UpstreamStatus::State;
    std::ifstream stream(folder / "run.json");
    if (!stream) return {State::absent, 0, "", ""};
    const Json record = Json::parse(stream, nullptr, false);
    if (record.is_discarded() || !record.is_object()) return {State::absent, 0, "", ""};
    UpstreamStatus status{State::running, record.value("windows", std::int64_t{0}),
                          record.value("message", ""), record.value("stage", "")};
    const std::string word = record.value("status", "");
    if (word == "done") status.state = State::done;
    if (word == "failed") status.state = State::failed;
    if (word == "interrupted") status.state = State::interrupted;
    if (word == "running" && record.value("host", "") == host_name()) {
        const auto pid = record.value("pid", 0);
        if (pid > 0 && ::kill(pid, 0) != 0 && errno == ESRCH) {
            status.state = State::died;
            status.message = "its process is gone";
        }
    }
    return status;
}

double peak_memory() {
    // Not ru_maxrss: a process started by a large one would inherit that one's peak.
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
        if (word != "VmHWM:") continue;
        double kilobytes = 0;
        status >> kilobytes;
        return 1024 * kilobytes;
    }
    return 0;
}

}  // namespace common
