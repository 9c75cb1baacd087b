#include "boussinesq/effects/friction.hpp"

#include <algorithm>
#include <cmath>

namespace boussinesq {

void Friction::apply(WaveState& state, double, double step) {
    const double* h = state.depth.data() + ghost_cells;
    double* q = state.discharge.data() + ghost_cells;
    for (std::size_t i = 0; i < cells_; ++i) {
        const double depth = std::max(h[i], dry_depth_);
        const double c =
            is_manning_ ? gravity * coefficient_ * coefficient_ / std::cbrt(depth) : coefficient_;
        q[i] /= 1.0 + step * c * std::abs(q[i]) / (depth * depth);
    }
}

}  // namespace boussinesq
