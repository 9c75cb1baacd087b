/// What the scene says to this stage, checked.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cmps/flow_grid.hpp"
#include "cmps/settings.hpp"
#include "cmps/solid.hpp"
#include "common/run_record.hpp"
#include "common/scene_file.hpp"
#include "common/shared_sections.hpp"

namespace cmps {

enum class Drive { waves, piston, none };
enum class Boundary { relaxation, paper, both };

/// What the file of a piston says of its path: displacements from cmps.offshore, m, its speed, m/s, and
/// period.
struct PistonRange {
    double start = 0;  ///< when the near field starts
    double least = 0, most = 0, fastest = 0;
    double period = 0;  ///< in which it swings to and fro, s; 0: it does not
};

/// What is taken as it stands, but should be known: told once, and kept in run.json.
struct Remark {
    std::string name, text;
};

/// The stage's part of a scene.
struct Scene {
    common::TimeSection time;
    std::vector<common::Gauge> gauges;
    Settings settings;
    common::Accuracy accuracy = common::Accuracy::standard;
    std::int64_t perturbation = 0;  ///< seed, 0: none

    // geometry, m
    double offshore = 0, onshore = 0;
    std::vector<Point> bed;
    std::vector<Polygon> structure;
    std::optional<std::array<double, 4>> tank;  ///< x0, x1, z0, z1
    std::vector<Polygon> water;                 ///< empty: below z = 0 between the wall and the structure
    std::vector<Point> water_velocity;          ///< m/s, of each polygon at the start; empty: at rest

    // drive
    Drive drive = Drive::waves;
    std::filesystem::path piston_file, gravity_file;
    PistonRange piston;
    Boundary boundary = Boundary::relaxation;
    double crest_lowering = 0;       ///< h_of of eq. (7), m
    double relaxation_length = 0;    ///< m
    double relaxation_strength = 0;  ///< 1/s
    double return_time = 0;          ///< s
    double absorption = 0;           ///< share of what comes back that the wall takes in
    double celerity = 0;             ///< of the waves at the wall, m/s
    double wave_height = 0;          ///< that [waves] gives, m; 0: none
    double wave_period = 0;          ///< that [waves] gives, s; 0: none
    double sea_enhancement = 0;      ///< of the peak of a sea's spectrum, about; 0: no sea
    std::optional<double> start;     ///< s; absent: at arrival of the waves
    double arrival_threshold = 0;    ///< m
    double viscosity = 0;            ///< kinematic, m2/s
    bool viscosity_is_given = false;
    double smagorinsky = 0;  ///< constant of the sub-particle turbulence

    // output
    FlowGridSettings flow;
    bool has_flow = false;
    double particles_interval = 0, flow_smoothing = 0;  ///< s
    double pressure_average = 0;                        ///< s: over which pressures and forces are averaged

    /// Face of the moving wall when the near field starts, m.
    double wall_at_start() const { return offshore + piston.start; }
    /// Reach ahead of the wall where water that passed it is put back, m: 1.5 depths, a good part of a
    /// trough.
    double overflow_zone() const { return 1.5 * settings.depth; }
    /// Reach ahead of the wall over which absorption reads the surface, m.
    double absorption_reach() const { return 0.5 * settings.depth; }
    /// Times that were found in 0.4 m of water become, by Froude's law, this many times as long here.
    double froude_time() const { return std::sqrt(settings.depth / 0.4); }

    std::vector<Remark> remarks;

    // effects, decided
    std::vector<common::EffectRecord> effects;
    bool turbulence_is_automatic = false;
    bool crest_is_out_of_reach = false;  ///< said so by "auto", which therefore left the basin out
    bool has_effect(const std::string& name) const;
};

/// Reads and checks all keys; mistakes are noted in `file` and thrown by its finish().
Scene read_scene(const common::SceneFile& file);

}  // namespace cmps
