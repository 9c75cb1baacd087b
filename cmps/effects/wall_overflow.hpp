/// The paper's offshore boundary, eqs. (6)-(7): the moving wall ends below the surface, so that reflected
/// crests pass over it and leave; water that passed is put back where the surface lies lowest against that of
/// the waves, so that the volume stays (Gotoh, Ikari, Sakai & Okuda 2006).
#pragma once

#include <vector>

#include "cmps/effects/moving_wall.hpp"
#include "cmps/near_field.hpp"
#include "cmps/wave_field.hpp"

namespace cmps {

class WallOverflow final : public Effect {
 public:
    /// `crest_lowering`: h_of, m. `zone_length`: of the reach ahead of the wall where water is put back, m.
    WallOverflow(NearField& field, WaveField& waves, const MovingWall& wall, double crest_lowering,
                 double zone_length);
    std::string name() const override { return "wall_overflow"; }
    void begin_step(NearField& field, double time, double step) override;
    void end_step(NearField& field, double time, double step) override;
    std::vector<double> state() const override;
    void restore(const std::vector<double>& state) override;

    /// Particles that passed the wall and have not been put back yet.
    std::size_t waiting() const { return waiting_.size(); }
    std::size_t passed() const { return passed_; }

 private:
    void put_back(NearField& field);
    static double free_level(const Particles& particles, double x, double z, double distance);
    WaveField& waves_;
    const MovingWall& wall_;
    double crest_lowering_, zone_length_;
    std::vector<std::size_t> members_;    // boundary particles of the wall
    std::vector<double> part_of_height_;  // their level, of the wall's height
    std::vector<std::int32_t> waiting_;   // identities
    std::vector<double> column_top_, column_u_, column_w_;
    std::size_t passed_ = 0;
};

}  // namespace cmps
