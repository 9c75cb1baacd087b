/// How the water moves where blocks are: a grid in x and z from the near field, or still water or a uniform
/// current.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

#include "dem/vector.hpp"

namespace dem {

/// A vector at some places, an array for each component.
struct Column {
    std::vector<double> x, y, z;

    void resize(std::size_t count) {
        for (auto* part : {&x, &y, &z}) part->resize(count);
    }
};

/// Water at some places.
struct WaterSamples {
    Column velocity;          ///< u, m/s
    Column acceleration;      ///< Du/Dt, m/s^2
    std::vector<double> wet;  ///< 0 (air) .. 1 (water)

    void resize(std::size_t count) {
        velocity.resize(count);
        acceleration.resize(count);
        wet.resize(count);
    }
};

/// Water below z = 0 that moves as one: at rest, or a current given by the scene. What is uniform has
/// Du/Dt = du/dt: u = velocity + acceleration t.
struct UniformWater {
    Vector velocity{0, 0, 0};  ///< at t = 0, m/s
    Vector acceleration{0, 0, 0};
    double element_diameter = 0.008;  ///< of the spheres that it wets, m
    bool surface = true;              ///< false: water everywhere
    double time = 0;                  ///< s

    void set_time(double t) { time = t; }
    bool is_steady() const { return acceleration.isZero(0); }

    /// Wet share of the volume of a sphere whose centre is at z: its cap below the surface, (3 - 2 x) x^2
    /// when the share x of its diameter is immersed.
    double wet_at(double z) const {
        const double immersed = std::clamp(0.5 - z / element_diameter, 0.0, 1.0);
        return surface ? immersed * immersed * (3 - 2 * immersed) : 1.0;
    }
    /// At the places (x, z), m; `samples` has their size.
    void sample(const std::vector<double>& x, const std::vector<double>& z, WaterSamples& samples) const;
};

/// Samples of the near field, linear in time and bilinear in space, uniform in y.
struct FlowHistory {
    std::vector<double> time;  ///< s, increasing
    std::vector<double> x, z;  ///< m, increasing
    /// (time, z, x, 5): u_x, u_z, Du_x/Dt, Du_z/Dt, wet; float as stored in windows.
    std::vector<float> values;
};

/// The flow grid at one instant.
class FlowGrid {
 public:
    static constexpr std::size_t fields = 5;

    FlowGrid() = default;
    /// `still`: the water outside the grid; without it nothing is known there.
    explicit FlowGrid(FlowHistory history, std::optional<UniformWater> still = {});

    /// Interpolates the grid to time t, which must lie within the history (a rounding error outside is
    /// inside).
    void set_time(double t);
    double begin() const { return history_.time.front(); }
    double end() const { return history_.time.back(); }
    bool covers(double x, double z) const {
        return x >= history_.x.front() && x <= history_.x.back() && z >= history_.z.front() &&
               z <= history_.z.back();
    }
    const FlowHistory& history() const { return history_; }

    /// At the places (x, z), m; `samples` has their size. Throws std::out_of_range where nothing is known.
    void sample(const std::vector<double>& x, const std::vector<double>& z, WaterSamples& samples) const;

    /// Grid points from (i, j) to (end_i - 1, end_j - 1): what is interpolated anywhere in a box lies between
    /// their values.
    struct Points {
        std::size_t i, end_i, j, end_j;
    };
    /// Those around a box in x and z, m; none when the box reaches outside the grid.
    std::optional<Points> points_around(double x_low, double x_high, double z_low, double z_high) const;
    /// Their values at the present instant, in the order of `largest_change`.
    std::vector<double> values_at(const Points& points) const;

    /// Bounds on how the water at some points differs from earlier values of theirs, from the present instant
    /// to the end of the interval between two samples in time that it lies in.
    struct Change {
        double velocity = 0, acceleration = 0;  ///< largest difference, m/s, m/s^2
        double speed = 0;                       ///< largest then or earlier, m/s
        bool wet = false;                       ///< the wet fraction differs
    };
    Change largest_change(const Points& points, const std::vector<double>& earlier) const;
    /// Number of that interval.
    std::size_t interval() const { return interval_; }

 private:
    /// A point's fields and what is read beyond them, so that the processor interpolates them as one.
    static constexpr std::size_t padded_fields = 8;
    void interpolate(double x, double z, double (&value)[padded_fields]) const;

    FlowHistory history_;
    std::optional<UniformWater> still_;
    std::size_t values_ = 0;   // of an instant
    std::vector<double> now_;  // (z, x, fields), and padding
    double origin_x_ = 0, origin_z_ = 0, per_spacing_x_ = 0, per_spacing_z_ = 0;
    std::size_t count_x_ = 0, count_z_ = 0, interval_ = 0;
};

}  // namespace dem
