/// A near field built from a scene: its effects composed, advanced window by window.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "cmps/balance.hpp"
#include "cmps/effect_watch.hpp"
#include "cmps/effects/absorption.hpp"
#include "cmps/effects/containment.hpp"
#include "cmps/effects/gravity_history.hpp"
#include "cmps/effects/moving_wall.hpp"
#include "cmps/effects/overtopping_basin.hpp"
#include "cmps/effects/wall_overflow.hpp"
#include "cmps/near_field.hpp"
#include "cmps/scene.hpp"
#include "cmps/wave_field.hpp"
#include "cmps/window_output.hpp"
#include "common/run_record.hpp"
#include "common/window.hpp"
#include "common/window_clock.hpp"

namespace cmps {

class Simulation {
 public:
    /// `waves`: present when the scene is driven by waves; must outlive this, as `scene` must.
    Simulation(const Scene& scene, WaveField* waves, double start);

    /// Advances to the end of window `index` or just past it, recording what is due. Steps are as long as the
    /// water allows: windows and samples end within them. `say`: called at once with what the user should
    /// know.
    common::Window advance_window(const common::WindowClock& clock, std::int64_t index,
                                  const std::function<void(double)>& on_step,
                                  const std::function<void(const std::string&)>& say);

    /// The state before the step that crossed the end of the last window: what the next one goes on from.
    const common::DataFile& state() const { return before_crossing_; }
    void restore(const common::DataFile& state);
    common::DataFile geometry() const { return geometry_file(scene_, solid_); }
    void describe(common::RunRecord& record) const;

    const NearField& field() const { return *field_; }

 private:
    common::DataFile save_state() const;
    /// Throws RunError when the run has gone wrong.
    void take_stock();
    void compose_effects();
    /// An effect that may also be added while running: at the end of the step's effects.
    void switch_on(const std::string& effect);
    /// Done on the water by a piston and by gravity from a table.
    Work work() const;
    double wall_position() const { return wall_ ? wall_->position() : scene_.offshore; }
    void add_offshore_boundary();
    template <class Kind, class... Arguments>
    Kind* add_effect(Arguments&&... arguments);
    std::size_t overtopped() const { return basin_ ? basin_->collected() : 0; }

    const Scene& scene_;
    Solid solid_;
    WaveField* waves_;
    std::unique_ptr<NearField> field_;
    Containment* containment_ = nullptr;  // these are owned by field_->effects
    MovingWall* wall_ = nullptr;
    GravityHistory* gravity_ = nullptr;
    OvertoppingBasin* basin_ = nullptr;
    WallOverflow* overflow_ = nullptr;
    Absorption* absorption_ = nullptr;
    std::optional<EffectWatch> watch_;
    std::optional<Balance> balance_;
    std::optional<WindowOutput> output_;
    common::DataFile before_crossing_;
    double start_, time_;           // s
    std::size_t steps_before_ = 0;  // of the run that this one goes on with
};

}  // namespace cmps
