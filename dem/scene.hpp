/// The scene as this stage reads it: [dem], [wires], [effects], [time].
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/run_record.hpp"
#include "common/scene_file.hpp"
#include "common/shared_sections.hpp"
#include "dem/contacts.hpp"
#include "dem/effects/sleeping.hpp"
#include "dem/effects/wires.hpp"
#include "dem/layout.hpp"
#include "dem/mound.hpp"
#include "dem/pair_list.hpp"
#include "dem/step.hpp"

namespace dem {

/// Optional effects, chosen once before the run.
struct Effects {
    bool fluid_force = true, wires = false, wire_breaking = false, tangential_history = true, sleeping = true,
         still_windows = true;
    std::vector<common::EffectRecord> records;  ///< each with its reason
};

/// Wires as the layout asks for them.
struct WireRules {
    WireLaw law = WireLaw::hooke;
    double psi = 0.3;      ///< longest stretch in element diameters
    double stiffness = 0;  ///< k_n, N/m
    std::vector<LinkRequest> links;
    std::vector<std::uint32_t>
        put_back;  ///< blocks put back to their packed pose before the layout is mounted
};

/// How blocks come to rest before the run.
struct PackingRules {
    bool settle = true;
    double longest = 5;           ///< s
    double speed = 1e-3;          ///< blocks slower than this have settled, m/s
    double look_interval = 0.02;  ///< s; the paper's blocks fall 2 mm in it
};

/// What a scene says about blocks.
struct Scene {
    common::TimeSection time{};
    std::int64_t perturbation = 0;  ///< seed of the first state's, 0: none
    double output_interval = 0.05;  ///< s
    Element element;
    Water water;
    Material material;
    Vector gravity{0, 0, -9.81};
    double time_scale = 1;  ///< sqrt(d / g) over that of the paper's elements: how fast blocks fall and rock
    ContactLaw contact = ContactLaw::hertz;
    double reference_overlap = 0;  ///< m
    StepRules step;
    bool time_step_is_chosen = true;  ///< by the program, not by the scene
    double usual_time_step = 1e-4;    ///< the program's choice at standard accuracy, s
    SleepRules sleep;
    UniformWater uniform_water;
    bool still_outside = false;
    MoundProfile mound;  ///< mean surface; empty without a mound
    double width = 0;    ///< of the armour along the breakwater, m
    std::size_t rows = 0, columns = 0;
    Blocks placed;  ///< before packing
    Surroundings surroundings;
    PackingRules packing;
    WireRules wires;
    std::optional<double> restart_time, restart_clock;
    bool restart_calm = false;  ///< blocks of an earlier run settle in still water first
    Effects effects;
};

/// Reads everything this stage needs. Mistakes are noted in `file` (and `layout`); call finish() on both
/// afterwards. `layout`: its [wires] replaces the scene's links; may be null.
Scene read_scene(const common::SceneFile& file, const common::SceneFile* layout);

/// Shapes, placed blocks, mound, walls (scene_blocks.cpp).
void read_blocks(const common::SceneFile& file, Scene& scene);
/// [wires] (scene_wires.cpp).
void read_wires(const common::SceneFile& file, const common::SceneFile* layout, Scene& scene);

/// [effects], once all else is read (scene_effects.cpp). `dry`: there is no water.
void choose_effects(const common::SceneFile& file, bool dry, Scene& scene);

/// A shape that comes with the program, or from the user's TOML file. Throws common::InputError.
ShapeDescription find_shape(const std::string& name, const std::filesystem::path& scene_folder);
/// Names of the shapes that come with the program.
std::vector<std::string> built_in_shapes();

}  // namespace dem
