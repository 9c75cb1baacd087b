#include "cmps/effects/wall_overflow.hpp"

#include <algorithm>
#include <cmath>

namespace cmps {
namespace {

constexpr std::size_t most_per_step = 2;  // more at once is felt as a shock
constexpr double nothing = -1e300;

}  // namespace

WallOverflow::WallOverflow(NearField& field, WaveField& waves, const MovingWall& wall, double crest_lowering,
                           double zone_length)
    : waves_(waves), wall_(wall), crest_lowering_(crest_lowering), zone_length_(zone_length) {
    const Particles& particles = field.particles;
    const double l0 = field.settings.spacing;
    const double height = waves.still_water_depth(wall.position()) - crest_lowering;
    const double rows = std::max(1.0, std::round(height / l0));
    for (std::size_t i = 0; i < particles.first_fluid(); ++i) {
        if (particles.body[i] != body_moving_wall) continue;
        const double row = std::round((particles.z[i] - wall.foot()) / l0 - 0.5);
        members_.push_back(i);
        part_of_height_.push_back((row + 0.5) / rows);  // above 1: not needed
    }
    waiting_.reserve(particles.fluid);
}

/// The wall's rows spread evenly between bed and crest: none ever appears or goes, which the water would
/// feel as a blow. Their motion is no velocity: it pushes no water.
void WallOverflow::begin_step(NearField& field, double time, double step) {
    waves_.go_to(time + step);
    const double x = wall_.position(), l0 = field.settings.spacing;
    const double crest = waves_.surface_elevation(x) - crest_lowering_;  // eq. (7)
    const double bottom = wall_.foot(), height = std::max(crest - bottom, l0);
    const double parked = bottom - 2.0 * (field.settings.kernel_radius_ratio + 4.0) * l0;
    for (std::size_t m = 0; m < members_.size(); ++m) {
        const double part = part_of_height_[m];
        field.particles.z[members_[m]] = part < 1.0 ? bottom + part * height : parked - part * height;
    }
}

void WallOverflow::end_step(NearField& field, double time, double) {
    Particles& particles = field.particles;
    const double behind = wall_.position() - 0.5 * field.settings.spacing;
    for (std::size_t i = particles.size(); i-- > particles.first_fluid();)
        if (particles.x[i] < behind) {
            waiting_.push_back(particles.identity[i]);
            particles.remove_fluid(i);
            ++passed_;
        }
    if (waiting_.empty()) return;
    waves_.go_to(time);
    put_back(field);
}

/// The lowest level from z on at which no particle is nearer than `distance`: one set among others would be
/// thrown out again, with a blow that the whole water feels.
double WallOverflow::free_level(const Particles& particles, double x, double z, double distance) {
    for (bool is_free = false; !is_free;) {
        is_free = true;
        for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i) {
            const double dx = particles.x[i] - x, dz = particles.z[i] - z;
            if (std::abs(dx) >= distance || dx * dx + dz * dz >= distance * distance * (1 - 1e-9)) continue;
            z = particles.z[i] + std::sqrt(distance * distance - dx * dx);
            is_free = false;
        }
    }
    return z;
}

void WallOverflow::put_back(NearField& field) {
    Particles& particles = field.particles;
    const double l0 = field.settings.spacing, x0 = wall_.position() + l0;
    const auto columns = static_cast<std::size_t>(zone_length_ / l0 + 1e-6);  // whole ones stay whole
    column_top_.assign(columns, nothing), column_u_.assign(columns, 0.0), column_w_.assign(columns, 0.0);
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i) {
        const double place = (particles.x[i] - x0) / l0;
        if (place < 0 || place >= static_cast<double>(columns)) continue;
        const auto c = static_cast<std::size_t>(place);
        if (particles.z[i] > column_top_[c])
            column_top_[c] = particles.z[i], column_u_[c] = particles.u[i], column_w_[c] = particles.w[i];
    }
    for (std::size_t n = 0; n < most_per_step && !waiting_.empty(); ++n) {
        std::size_t lowest = columns;
        double least = 1e300;
        for (std::size_t c = 0; c < columns; ++c) {
            if (column_top_[c] == nothing) continue;
            const double x = x0 + (static_cast<double>(c) + 0.5) * l0;
            const double above = column_top_[c] + 0.5 * l0 - waves_.surface_elevation(x);
            if (above < least) least = above, lowest = c;
        }
        // water that left on a crest comes back where the surface has fallen below that of the waves, not
        // before: put back at once it would only have been moved about
        if (lowest == columns || least > -0.5 * l0) return;
        const double x = x0 + (static_cast<double>(lowest) + 0.5) * l0;
        const double z = free_level(particles, x, column_top_[lowest] + 0.95 * l0, 0.95 * l0);
        particles.add_fluid(x, z, waiting_.back(), column_u_[lowest], column_w_[lowest]);
        waiting_.pop_back();
        column_top_[lowest] = nothing;  // one a column and step
    }
}

std::vector<double> WallOverflow::state() const {
    std::vector<double> state = {static_cast<double>(passed_)};
    state.insert(state.end(), waiting_.begin(), waiting_.end());
    return state;
}

void WallOverflow::restore(const std::vector<double>& state) {
    passed_ = static_cast<std::size_t>(state.at(0));
    waiting_.clear();
    for (std::size_t k = 1; k < state.size(); ++k) waiting_.push_back(static_cast<std::int32_t>(state[k]));
}

}  // namespace cmps
