/// Records samples of the running simulation and makes windows and geometry of them.
#pragma once

#include <vector>

#include "common/data_file.hpp"
#include "common/window.hpp"
#include "dem/damage.hpp"
#include "dem/snapshot.hpp"
#include "dem/step.hpp"

namespace dem {

class WindowOutput {
 public:
    void record(const Simulation& simulation, const PackedPoses& packed);
    /// The recorded samples as window `index`, with the contacts of its last instant; forgets them.
    common::Window take(std::int64_t index, const Simulation& simulation);

 private:
    std::size_t blocks_ = 0, wires_ = 0;
    std::vector<double> time_, position_, orientation_, velocity_, angular_velocity_, displacement_, tension_,
        energy_, tension_range_;
    std::vector<std::int32_t> intact_, asleep_;
};

/// What does not change: sphere positions of the shapes, mound and other fixed spheres, planes, packed poses,
/// wires.
common::DataFile geometry_of(const Simulation& simulation, const PackedPoses& packed,
                             const std::string& placement);

}  // namespace dem
