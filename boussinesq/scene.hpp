/// The scene as this stage reads it: its sections, checked, turned into plain values.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "boussinesq/effect_rules.hpp"
#include "boussinesq/effects/breaking.hpp"
#include "boussinesq/flow_step.hpp"
#include "boussinesq/grid.hpp"
#include "boussinesq/waves/wave_components.hpp"
#include "common/run_record.hpp"
#include "common/scene_file.hpp"
#include "common/shared_sections.hpp"

namespace boussinesq {

enum class WaveKind { none, regular, solitary, irregular, series };
enum class EndKind { absorbing, wall, open };

/// [waves], and [initial] in its place.
struct WaveSection {
    WaveKind kind = WaveKind::none;
    double height = 0, period = 0;  ///< m, s; irregular: H_1/3 and peak period
    double position = 0;            ///< m
    double ramp = 0;                ///< s
    double depth = 0;               ///< still water where the wave is made, m
    double length = 0;              ///< of the (peak) wave there, m
    double crest_rate = 0;          ///< solitary: the elevation passes as sech^2(rate t), 1/s
    SeaState sea;
    bool has_bound_waves = false;  ///< irregular waves to second order
    std::string bound_waves_reason;
    WaveRecord record;          ///< waves.file
    std::string record_note;    ///< its waves' period, and what of it the equations do not carry
    double share_left_out = 0;  ///< of the record's variance, above kd = 5
    std::vector<double> initial_x, initial_elevation, initial_velocity;  ///< [initial] file
};

/// Everything this stage takes from the scene.
struct Scene {
    common::TimeSection time;
    std::int64_t perturbation = 0;  ///< seed, 0: none
    std::vector<common::Point> bed;
    std::vector<common::Gauge> gauges;
    WaveSection waves;
    Grid grid;
    FlowParameters flow;
    FlowTerms terms;
    EndKind offshore = EndKind::absorbing, shoreward = EndKind::absorbing;
    double generation_length = 0, offshore_sponge = 0, shoreward_sponge = 0;  ///< m; 0: none
    double courant = 0.5, output_interval = 0.02;
    double friction = 0;
    bool friction_is_manning = false;
    bool has_breaking = false, has_friction = false;
    bool shoreline_is_automatic = true, breaking_is_automatic = true;  ///< may be switched on when needed
    bool breaks_as_bores = false;  ///< hydrostatic bores from the beginning, without eddy viscosity
    EddyViscosityConstants breaking;
    std::vector<common::EffectRecord> effects;
    std::string sponge_note;    ///< the flume leaves the shoreward sponge less length than it should have
    std::string sampling_note;  ///< what reads the windows sees less of the waves than it should
    Expectation expectation;

    double still_depth(double x) const { return -common::bed_level(bed, x); }
};

/// Reads and checks; throws InputError with one line per mistake.
Scene read_scene(const common::SceneFile& file);

}  // namespace boussinesq
