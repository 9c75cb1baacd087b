/// What a run checks about itself: particles, volume, energy, leaks.
#pragma once

#include <cstddef>
#include <vector>

#include "cmps/effects/work.hpp"
#include "cmps/near_field.hpp"
#include "cmps/scene.hpp"
#include "cmps/solid.hpp"
#include "common/run_record.hpp"

namespace cmps {

class Balance {
 public:
    Balance(const Scene& scene, const Solid& solid, const NearField& field);

    /// Takes stock; `wall`: place of the offshore wall, m; `work`: done on the water so far by a piston and
    /// by gravity from a table.
    void update(const NearField& field, double wall, const Work& work);
    /// Throws RunError where the last stock says that the run has gone wrong. Bounds are two and more times
    /// what the verification and hard cases reach, and less than half of what known failures do.
    /// `returned`: particles put back out of the solid so far.
    void judge(const NearField& field, double time, std::size_t returned) const;
    /// `elsewhere`: fluid particles that have left the water and are known (waiting, overtopped).
    void describe(common::RunRecord& record, const NearField& field, std::size_t elsewhere) const;

    std::size_t initial_fluid() const { return initial_fluid_; }
    std::vector<double> state() const;
    void restore(const std::vector<double>& state);

 private:
    double energy(const NearField& field) const;
    double energy_scale() const;
    const Scene& scene_;
    const Solid& solid_;
    std::size_t initial_fluid_ = 0, in_solid_ = 0, outside_ = 0;
    double initial_volume_ = 0, volume_drift_ = 0, largest_volume_drift_ = 0;
    double initial_area_ = 0;  // of the polygons of water; 0: none are given
    double initial_energy_ = 0, energy_gain_ = 0, largest_energy_gain_ = 0;  // against the start's
    double lowest_energy_gain_ = 0, largest_energy_regain_ = 0;              // rise from the least there was
    Work work_;                                                              // over energy_scale()
};

}  // namespace cmps
