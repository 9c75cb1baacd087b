#include "dem/damage.hpp"

#include <algorithm>
#include <cmath>

namespace dem {

std::vector<Displacement> displacements(const Blocks& blocks, const std::vector<Vector>& packed_position,
                                        const std::vector<Quaternion>& packed_orientation) {
    std::vector<Displacement> moved;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const Vector way = blocks.position[i] - packed_position[i];
        moved.push_back({way.norm(), -way.x(), blocks.orientation[i].angularDistance(packed_orientation[i])});
    }
    return moved;
}

Damage assess_damage(const Blocks& blocks, const std::vector<Displacement>& moved, double width) {
    Damage damage;
    double count = 0, length_moved = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        if (blocks.is_fixed[i]) continue;
        ++count;
        const double length = blocks.shape_of(i).length;
        for (std::size_t k = 0; k < Damage::levels.size(); ++k)
            if (moved[i].total > Damage::levels[k] * length) ++damage.moved[k];
        if (moved[i].total > 0.5 * length) length_moved += length;
        damage.mean_displacement += moved[i].total;
        damage.mean_offshore += moved[i].offshore;
        damage.largest_displacement = std::max(damage.largest_displacement, moved[i].total);
    }
    damage.free_blocks = static_cast<std::size_t>(count);
    if (count > 0) {
        damage.mean_displacement /= count;
        damage.mean_offshore /= count;
    }
    if (width > 0) damage.number = length_moved / width;
    return damage;
}

}  // namespace dem
