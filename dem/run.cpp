#include "dem/run.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "common/errors.hpp"
#include "common/input_scene.hpp"
#include "common/output_folder.hpp"
#include "common/progress.hpp"
#include "common/window_channel.hpp"
#include "common/window_clock.hpp"
#include "dem/build_simulation.hpp"
#include "dem/flow_windows.hpp"
#include "dem/report.hpp"
#include "dem/sound_state.hpp"
#include "dem/start.hpp"
#include "dem/window_output.hpp"

namespace dem {

namespace {

/// The windows this run is to compute, and the water in each of them.
class FlowSource {
 public:
    FlowSource(const common::StageCommand& command, const common::SceneFile& file, const Scene& scene)
        : scene_(scene), folder_(command.upstream), follow_(command.follow) {
        if (folder_.empty()) return;
        reader_.emplace(folder_, "cmps", expected_flow(), follow_);
        without_record_ = common::require_same_scene(file, folder_, digest());
    }
    /// What to tell of windows made by hand, empty for those of a run.
    const std::string& without_record() const { return without_record_; }
    bool has_flow() const { return reader_.has_value(); }
    std::string digest() { return has_flow() ? reader_->first().scene_digest : std::string(); }
    double begin() { return has_flow() ? reader_->first().t_begin : 0.0; }

    /// Fixes the start; throws InputError when the flow does not reach from there to the end asked for.
    void start_at(double t) {
        start_ = t;
        if (t >= scene_.time.end - tolerance)
            throw common::InputError(
                fmt::format("{}the run would start at t = {:.10g} s, and time.end = {:.10g} s is not later",
                            has_flow() ? folder_.string() + ": " : std::string(), t, scene_.time.end));
        if (!has_flow()) {
            clock_.emplace(t, scene_.time.end, scene_.time.window);
            return;
        }
        if (!follow_ && reader_->available_until() < scene_.time.end - tolerance)
            throw common::InputError(fmt::format("{}: the flow ends at t = {} s, before time.end = {} s",
                                                 folder_.string(), reader_->available_until(),
                                                 scene_.time.end));
        const auto index = reader_->index_at(t);
        if (!index)
            throw common::InputError(fmt::format("{}: the flow does not hold t = {} s, where the run starts",
                                                 folder_.string(), t));
        first_ = *index;
    }
    /// Throws InputError unless the flow is that of this mound and covers the blocks.
    void require_cover(const Blocks& blocks) {
        if (has_flow()) require_same_mound(folder_, scene_.mound, blocks);
        if (has_flow() && !scene_.still_outside)
            dem::require_cover(
                flow_grid_of(reader_->first(), {}, reader_->path_of(reader_->first().index).string()), blocks,
                folder_.string());
    }

    struct Span {
        double begin, end;
        std::optional<FlowGrid> grid;
    };
    std::optional<UniformWater> water_outside() const {
        if (!scene_.still_outside) return {};
        return UniformWater{.element_diameter = scene_.element.diameter};
    }
    /// Window `index` of this run, or nothing when all is done.
    std::optional<Span> receive(std::int64_t index) {
        if (!has_flow()) {
            if (index >= clock_->window_count()) return {};
            return Span{clock_->begin_of(index), clock_->end_of(index), {}};
        }
        const auto window = reader_->receive(first_ + index);
        if (!window) return {};
        const double begin = index == 0 ? start_ : window->t_begin,
                     end = std::min(window->t_end, scene_.time.end);
        if (end <= begin + tolerance) return {};
        return Span{begin, end,
                    flow_grid_of(*window, water_outside(), reader_->path_of(first_ + index).string())};
    }
    /// Throws InputError where window `index` does not begin at `t`, where the run stands.
    void require_next(std::int64_t index, const Span& span, double t) const {
        if (std::abs(span.begin - t) > tolerance)
            throw common::InputError(
                fmt::format("{}: begins at t = {:.10g} s, where the window before it ends at t = {:.10g} s",
                            has_flow() ? reader_->path_of(first_ + index).string() : std::string("the run"),
                            span.begin, t));
    }
    /// Throws RunError when a flow that was followed ended before the time asked for.
    void require_end(double t) const {
        if (t < scene_.time.end - tolerance)
            throw common::RunError(
                fmt::format("{}: the flow ended at t = {:.10g} s, before time.end = {:.10g} s",
                            folder_.string(), t, scene_.time.end));
    }

 private:
    static constexpr double tolerance = 1e-9;  // s, rounding of window ends
    const Scene& scene_;
    std::filesystem::path folder_;
    bool follow_;
    std::optional<common::WindowReader> reader_;
    std::string without_record_;
    std::optional<common::WindowClock> clock_;
    double start_ = 0;
    std::int64_t first_ = 0;
};

/// Where the run starts, after all that its input must hold has been looked at; throws InputError.
struct Entry {
    std::optional<Start> earlier;
    double begin;
};

Entry enter(const common::StageCommand& command, const Scene& scene, FlowSource& flow) {
    Entry entry{};
    if (!command.from.empty() && std::filesystem::weakly_canonical(command.from).parent_path() ==
                                     std::filesystem::weakly_canonical(command.out))
        throw common::InputError(
            fmt::format("--out {}: the run that --from reads would be replaced; give another folder",
                        command.out.string()));
    if (!command.from.empty()) entry.earlier = start_from(command.from, scene);
    entry.begin =
        scene.restart_clock.value_or(entry.earlier && entry.earlier->t ? *entry.earlier->t : flow.begin());
    flow.start_at(entry.begin);
    flow.require_cover(entry.earlier ? entry.earlier->simulation->blocks : scene.placed);
    return entry;
}

std::string input_digest_of(const common::StageCommand& command, FlowSource& flow) {
    std::string digest = flow.digest();
    if (!command.from.empty()) digest += common::read_data_file(command.from).text("scene_digest");
    return digest;
}

/// Legal, since a layout may be tried in any waves; but whoever compares the two runs should know. Empty
/// where the earlier run had the same flow, or is a packing.
std::string other_flow_of(const common::StageCommand& command, FlowSource& flow) {
    if (command.from.empty()) return {};
    const common::DataFile earlier = common::read_data_file(command.from);
    const auto packing = earlier.attributes.find("is_packing");
    if (packing != earlier.attributes.end() && earlier.integer("is_packing") != 0) return {};
    const std::string before = earlier.text("input_digest"), now = flow.digest();
    // A run that itself went on from another has the digests of both, the flow's first.
    if (now.empty() || before.empty() || before.starts_with(now)) return {};
    return fmt::format("the run goes on in another flow than that of {}", command.from.string());
}

/// Legal, and easily an oversight where the scene describes a near field. Empty where there is a flow, no
/// near field or no water.
std::string water_without_flow(const common::StageCommand& command, const common::SceneFile& file,
                               const Scene& scene) {
    if (!command.upstream.empty() || !file.has_section("cmps") || !scene.effects.fluid_force) return {};
    const UniformWater& water = scene.uniform_water;
    const bool is_still = water.velocity.isZero(0) && water.acceleration.isZero(0);
    return fmt::format(
        "no --flow is given though the scene describes a near field ([cmps]): the blocks are in {}",
        is_still ? "still water" : "the uniform water of dem.current");
}

std::string scene_digest_of(const common::SceneFile& file, const common::SceneFile* layout,
                            const Scene& scene, const std::string& input) {
    return file.digest((layout != nullptr ? layout->digest() : std::string()) +
                       placement_digest(scene.placed, scene.surroundings) + input);
}

common::DataFile state_of(const Simulation& simulation, const PackedPoses& packed, const Scene& scene,
                          const Report& report) {
    Snapshot snapshot = take_snapshot(simulation, packed, placement_digest(scene.placed, scene.surroundings));
    snapshot.rest_digest = rest_digest(scene);
    auto state = to_data_file(snapshot);
    report.store(state);
    return state;
}

/// Advances over one window, a sample at every output time.
common::Window advance(Simulation& simulation, const PackedPoses& packed, const Scene& scene, double begin,
                       double end, std::int64_t index, common::Progress& progress, Report& report) {
    WindowOutput output;
    const auto samples = common::WindowClock(begin, end, end - begin).samples_in(0, scene.output_interval);
    output.record(simulation, packed);
    double stepping = 0, recording = 0;
    for (std::size_t k = 1; k < samples.size(); ++k) {
        {
            common::PhaseTimer timer(stepping);
            simulation.advance(samples[k]);
        }
        common::PhaseTimer timer(recording);
        output.record(simulation, packed);
        report.look(simulation);
        progress.update(simulation.time(), fmt::format("{} of {} blocks asleep", simulation.asleep_count(),
                                                       simulation.blocks.size()));
    }
    report.add_time("steps", stepping);
    report.add_time("output", recording);
    return output.take(index, simulation);
}

/// Wires that are longer than they may be before anything has moved.
void report_breaks(const Wires& mounted, const Wires& now, Report& report) {
    const std::size_t broken = mounted.intact_count() - now.intact_count();
    if (broken == 0) return;
    std::size_t first = 0;
    while (mounted.is_intact[first] == now.is_intact[first]) ++first;
    report.warn(
        "wires.broken_at_start",
        fmt::format("{} of {} wires are longer than r0 + psi d where they are mounted and break at once; "
                    "the first joins blocks {} and {}",
                    broken, now.size(), now.block_a[first] + 1, now.block_b[first] + 1));
}

}  // namespace

double require_input(const common::StageCommand& command, const common::SceneFile& file, const Scene& scene) {
    if (command.from.empty() && !scene.packing.settle) require_holding_wires(scene.placed, scene, nullptr);
    if (command.from.empty() && command.upstream.empty()) return 0;
    FlowSource flow(command, file, scene);
    return enter(command, scene, flow).begin;
}

void pack(const common::StageCommand& command, const common::SceneFile& file, const Scene& scene) {
    const std::string digest = scene_digest_of(file, nullptr, scene, "packing");
    common::OutputFolder folder(command.out, {.stage = "dem", .scene_digest = digest, .input_digest = ""},
                                command.resume);
    if (folder.start() == common::OutputFolder::Start::nothing_to_do) return;
    common::Progress progress("dem pack", 0, scene.packing.longest, command.quiet);
    Report report(command.out, file, scene, digest, "");
    try {
        const auto simulation = build_packing(scene);
        WindowOutput output;
        const PackedPoses placed = poses_of(simulation->blocks);
        simulation->start(0);
        report.begin_books(*simulation);
        output.record(*simulation, placed);
        settle(*simulation, scene.packing, "packing", [&](double t) {
            output.record(*simulation, placed);
            progress.update(t, "packing");
        });
        throw_held(simulation->blocks, scene);
        const PackedPoses packed = poses_of(simulation->blocks);
        folder.write_geometry(
            geometry_of(*simulation, packed, placement_digest(scene.placed, scene.surroundings)));
        Snapshot snapshot =
            take_snapshot(*simulation, packed, placement_digest(scene.placed, scene.surroundings));
        snapshot.is_packing = true;
        // Twice: only a step that stays past its limit is a mistake, and settled blocks stay as they are.
        report.look(*simulation);
        report.look(*simulation);
        folder.publish(output.take(0, *simulation), to_data_file(snapshot));
        report.window_done(*simulation, placed, 1);
    } catch (const std::exception& error) {
        report.end(dynamic_cast<const common::Interrupted*>(&error) != nullptr ? "interrupted" : "failed",
                   error.what());
        throw;
    }
    report.end("done");
    progress.finish("packed");
}

void run(const common::StageCommand& command, const common::SceneFile& file, const common::SceneFile* layout,
         const Scene& scene) {
    FlowSource flow(command, file, scene);
    const std::string input = input_digest_of(command, flow);
    const std::string digest = scene_digest_of(file, layout, scene, input);
    // Whatever is wrong with the input shows before anything in the folder is touched.
    if (command.from.empty() && !scene.packing.settle) require_holding_wires(scene.placed, scene, nullptr);
    auto [earlier, begin] = enter(command, scene, flow);

    common::OutputFolder folder(command.out, {.stage = "dem", .scene_digest = digest, .input_digest = input},
                                command.resume);
    if (folder.start() == common::OutputFolder::Start::nothing_to_do) return;
    common::Progress progress("dem", begin, scene.time.end, command.quiet);
    Report report(command.out, file, scene, digest, input);
    if (flow.has_flow()) report.describe_input(command.upstream);
    if (!flow.without_record().empty()) report.say("input", flow.without_record());
    if (const std::string water = water_without_flow(command, file, scene); !water.empty())
        report.say("water", water);
    if (const std::string other = other_flow_of(command, flow); !other.empty())
        report.say("restart.flow", other);
    try {
        Start start;
        std::optional<FlowSource::Span> span = flow.receive(folder.next_window());
        if (folder.start() == common::OutputFolder::Start::go_on) {
            const Snapshot snapshot = snapshot_from(folder.state());
            require_sound(snapshot, scene.placed);
            start = {.simulation = build_simulation(scene, true), .packed = snapshot.packed};
            if (scene.effects.wires) start.simulation->mount_wires(snapshot.wires);
            restore(*start.simulation, snapshot);
            report.restore(folder.state());
        } else {
            double packing = 0;
            {
                common::PhaseTimer timer(packing);
                start = earlier ? std::move(*earlier) : packed_start(scene, progress);
                calm_down(start, scene, begin, progress);
            }
            report.add_time("packing", packing);
            if (scene.effects.tangential_history && !start.without_springs.empty() && !start.calm)
                report.warn("restart.springs", start.without_springs);
            if (start.calm) report.began_calm(*start.calm);
            require_holding_wires(start.simulation->blocks, scene,
                                  start.earlier_wires ? &*start.earlier_wires : nullptr);
            mount_layout(*start.simulation, scene, start.earlier_wires ? &*start.earlier_wires : nullptr);
            flow.require_cover(start.simulation->blocks);
            if (span && span->grid && start.simulation->water() != nullptr)
                start.simulation->water()->set_motion(*span->grid);
            if (start.state && start.simulation->wires.are_those_of(start.state->wires)) {
                // Nothing is new: to the bit as if the earlier run had gone on.
                start.simulation->mount_wires(start.state->wires);
                restore(*start.simulation, *start.state);
            } else {
                const Wires mounted = start.simulation->wires;
                start.simulation->blocks_were_placed(begin);
                report_breaks(mounted, start.simulation->wires, report);
            }
            report.begin_books(*start.simulation);
        }
        Simulation& simulation = *start.simulation;
        folder.write_geometry(
            geometry_of(simulation, start.packed, placement_digest(scene.placed, scene.surroundings)));
        for (std::int64_t index = folder.next_window(); span; span = flow.receive(++index)) {
            flow.require_next(index, *span, simulation.time());
            if (span->grid && simulation.water() != nullptr)
                simulation.water()->set_motion(std::move(*span->grid));
            common::Window window =
                advance(simulation, start.packed, scene, span->begin, span->end, index, progress, report);
            folder.publish(std::move(window), state_of(simulation, start.packed, scene, report));
            report.window_done(simulation, start.packed, index + 1);
        }
        flow.require_end(simulation.time());
    } catch (const common::Interrupted&) {
        report.end("interrupted", "interrupted");
        throw;
    } catch (const std::exception& error) {
        report.end("failed", error.what());
        throw;
    }
    report.end("done");
    progress.finish("done");
}

}  // namespace dem
