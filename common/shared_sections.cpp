#include "common/shared_sections.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace common {

TimeSection read_time(const SceneFile& scene) {
    const Section time = scene.section("time");
    return {.end = time.number("end", "s", "end of the simulation",
                               {.lowest = 0, .highest = 1e6, .lowest_is_open = true}),
            .window = time.number("window", "s", "length of an exchange window", Range::at_least(1e-4), 1.0)};
}

double read_water_density(const SceneFile& scene, SharedKey own, SharedKey other) {
    const char* about = "density of water";
    const Range liquids = Range::between(1.0, 1e5);
    std::optional<double> elsewhere;
    if (scene.has_section(other.section)) {
        const Section section = scene.foreign_section(other.section);
        if (section.has(other.key)) elsewhere = section.number(other.key, "kg/m3", about, liquids);
    }
    const Section section = scene.section(own.section);
    const double density = section.number(own.key, "kg/m3", about, liquids, elsewhere.value_or(1000.0));
    if (elsewhere && density != *elsewhere)
        section.problem(own.key, fmt::format("{:g} kg/m3, but {}.{} = {:g} kg/m3: it is the same water; give "
                                             "one of them",
                                             density, other.section, other.key, *elsewhere));
    return density;
}

std::vector<Point> read_bed(const SceneFile& scene, bool required) {
    const Section flume = scene.section("flume");
    const char* about = "polyline [[x, z], ...] from offshore to shore, z = 0 at still water";
    auto bed =
        required ? flume.points("bed", "m", about) : flume.points("bed", "m", about, std::vector<Point>{});
    if (flume.has("bed") && bed.size() < 2) flume.problem("bed", "expected at least two points");
    for (std::size_t i = 1; i < bed.size(); ++i)
        if (bed[i][0] <= bed[i - 1][0]) {
            flume.problem(
                "bed", fmt::format("x must increase from point to point; point {} has x = {} after {}", i + 1,
                                   bed[i][0], bed[i - 1][0]));
            std::sort(bed.begin(), bed.end());  // so that what reads on finds a bed
            break;
        }
    return bed;
}

double bed_level(const std::vector<Point>& bed, double x) {
    if (x <= bed.front()[0]) return bed.front()[1];
    if (x >= bed.back()[0]) return bed.back()[1];
    const auto right = std::upper_bound(bed.begin(), bed.end(), x,
                                        [](double value, const Point& p) { return value < p[0]; });
    const auto left = right - 1;
    const double share = (x - (*left)[0]) / ((*right)[0] - (*left)[0]);
    return (*left)[1] + share * ((*right)[1] - (*left)[1]);
}

std::vector<Gauge> read_gauges(const SceneFile& scene, double default_interval) {
    const Section section = scene.section("gauges");
    std::vector<Gauge> gauges;
    for (const auto& name : section.keys()) {
        Gauge gauge;
        gauge.name = name;
        gauge.interval = default_interval;
        if (name.find('/') != std::string::npos) section.problem(name, "a gauge's name must not contain '/'");
        if (name.empty() || name == "." || name == "..")
            section.problem(name,
                            fmt::format("'{}' is no name for a gauge: windows hold /gauges/<name>", name));
        if (!section.is_table(name)) {
            gauge.x = section.number(name, "m", "gauge at x", Range::any());
        } else {
            const Section entry = section.table(name);
            const std::string kind =
                entry.choice("kind", "what the gauge records",
                             {"surface", "pressure", "velocity", "overtopping"}, "surface");
            gauge.kind = kind == "pressure"      ? Gauge::Kind::pressure
                         : kind == "velocity"    ? Gauge::Kind::velocity
                         : kind == "overtopping" ? Gauge::Kind::overtopping
                                                 : Gauge::Kind::surface;
            gauge.x = entry.number("x", "m", "position of the gauge", Range::any());
            if (gauge.kind == Gauge::Kind::pressure || gauge.kind == Gauge::Kind::velocity)
                gauge.z = entry.number("z", "m", "level of the gauge", Range::any());
            if (gauge.kind == Gauge::Kind::pressure)
                gauge.diameter = entry.number("diameter", "m", "sensing face", Range::not_negative(), 0.0);
            gauge.interval =
                entry.number("interval", "s", "between records", Range::at_least(1e-6), default_interval);
        }
        gauges.push_back(gauge);
    }
    return gauges;
}

}  // namespace common
