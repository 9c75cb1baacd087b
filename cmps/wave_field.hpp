/// The waves that the Boussinesq stage computed, near the offshore boundary: surface and velocity with depth
/// profile.
///
///     u(z) = u - ((z-b)^2/2 - h^2/6) u_xx + ((z-b) - h/2) (2 b_x u_x + b_xx u)
///     w(z) = -(z-b) u_x + b_x u
///
/// Cubic in time between samples, with slopes from the samples up to each: what is found does not depend on
/// where windows begin, nor on whether later ones are there. Linear in x between nodes.
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "common/window_channel.hpp"

namespace cmps {

class WaveField {
 public:
    /// Keeps nodes within [x0, x1] and the nodes around. At `end` (s) the waves stand still: a last step that
    /// goes past it needs none of later. Throws InputError when the windows do not cover it.
    WaveField(common::WindowReader& reader, double x0, double x1, double end);
    /// Throws InputError where the windows' still water depth is not that of the scene, `depth(x)` (m): they
    /// are then the waves of another scene.
    void check_depth(const std::function<double(double)>& depth) const;

    /// The longest time between two samples of the first window, s. Later windows may have no longer one.
    double sample_interval() const { return sample_interval_; }

    /// Receives windows until `t1` is covered, and forgets what `t0` and later do not need. Throws InputError
    /// when the upstream stage ended earlier.
    void cover(double t0, double t1);
    /// First time from `from` on at which |surface elevation| or |velocity| at x reaches the thresholds;
    /// receives windows as it goes. Negative when the waves end before.
    double arrival(double x, double elevation_threshold, double from);

    /// Makes `time` the present: interpolates all nodes.
    void go_to(double time);
    double surface_elevation(double x) const;
    double mean_velocity(double x) const;
    double still_water_depth(double x) const;
    /// Horizontal and vertical velocity at (x, z), m/s.
    void velocity(double x, double z, double& u, double& w) const;

 private:
    /// One instant: elevation and velocity at the nodes.
    struct Sample {
        double time;
        std::vector<double> elevation, velocity;
    };
    bool receive_next();
    void check_range(const common::Window& window, const std::string& name, const std::vector<double>& values,
                     double most) const;
    std::size_t samples_until(double time) const;
    std::size_t node_left_of(double x, double& share) const;

    common::WindowReader& reader_;
    std::int64_t next_index_ = 0;
    double end_, last_time_ = 0;
    double sample_interval_ = 0;
    double deepest_ = 0;  // water or, where it is higher, ground above it, m
    std::size_t first_node_ = 0;
    std::vector<double> x_, depth_;
    std::deque<Sample> samples_;
    std::vector<double> eta_, u_, u_x_, u_xx_, bed_x_, bed_xx_;
};

}  // namespace cmps
