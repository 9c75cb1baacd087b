/// The sections of the scene that several stages read: [time], [flume], [gauges].
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/scene_file.hpp"

namespace common {

/// [time]
struct TimeSection {
    double end;     ///< s
    double window;  ///< length of an exchange window, s
};
TimeSection read_time(const SceneFile& scene);

/// Density of water, kg/m3, that two stages have a key of their own for (`own` and `other`, section and key):
/// one that is not given is that of the other; two that differ are refused.
struct SharedKey {
    std::string_view section, key;
};
double read_water_density(const SceneFile& scene, SharedKey own, SharedKey other);

/// [flume] bed: polyline from offshore to shore, x strictly increasing (m); z = 0 is still water.
/// Empty when the scene has no [flume] and `required` is false.
std::vector<Point> read_bed(const SceneFile& scene, bool required);

/// Bed level at x by linear interpolation, m; x is held inside the polyline.
double bed_level(const std::vector<Point>& bed, double x);

/// One entry of [gauges]: `name = x` or `name = {x = ..., z = ..., kind = ..., diameter = ..., interval =
/// ...}`.
struct Gauge {
    enum class Kind { surface, pressure, velocity, overtopping };
    std::string name;
    Kind kind = Kind::surface;
    double x = 0;         ///< m
    double z = 0;         ///< m; pressure and velocity gauges
    double diameter = 0;  ///< m; sensing face of a pressure gauge, 0: a point
    double interval = 0;  ///< s between records
};
/// All gauges of the scene, in file order; every stage records those it covers.
std::vector<Gauge> read_gauges(const SceneFile& scene, double default_interval);

}  // namespace common
