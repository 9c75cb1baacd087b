/// Particles as arrays, in the order dummies | walls | fluid.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cmps {

/// What a boundary particle belongs to.
enum Body : std::int32_t {
    body_bed = -1,
    body_moving_wall = -2,
    body_end_wall = -3
};  // >= 0: structure polygon

/// Dummies only fill the kernel behind a wall; walls (one layer) and fluid carry pressure.
/// Pressure carriers are contiguous: [first_wall(), size()).
struct Particles {
    std::size_t dummies = 0, walls = 0, fluid = 0;
    std::vector<double> x, z;                           ///< position, m
    std::vector<double> u, w;                           ///< velocity, m/s
    std::vector<double> pressure;                       ///< Pa, gauge
    std::array<std::vector<double>, 3> path_u, path_w;  ///< means along the path (path_average.hpp), m/s
    std::vector<std::int32_t> identity;                 ///< lasting number of a fluid particle
    std::vector<std::int32_t> body;                     ///< of boundary particles; fluid: 0
    std::vector<double> normal_x, normal_z;             ///< of boundary particles, into the water

    std::size_t size() const { return dummies + walls + fluid; }
    std::size_t first_wall() const { return dummies; }
    std::size_t first_fluid() const { return dummies + walls; }
    bool is_fluid(std::size_t i) const { return i >= first_fluid(); }

    template <class Visit>
    void for_each_array(const Visit& visit) {
        visit(x), visit(z), visit(u), visit(w), visit(pressure);
        for (auto& mean : path_u) visit(mean);
        for (auto& mean : path_w) visit(mean);
        visit(identity), visit(body), visit(normal_x), visit(normal_z);
    }

    /// Appends a fluid particle with velocity (speed_x, speed_z).
    void add_fluid(double at_x, double at_z, std::int32_t number, double speed_x = 0, double speed_z = 0) {
        for_each_array([](auto& array) { array.push_back({}); });
        u.back() = speed_x, w.back() = speed_z;
        for (auto& mean : path_u) mean.back() = speed_x;
        for (auto& mean : path_w) mean.back() = speed_z;
        x.back() = at_x, z.back() = at_z, identity.back() = number;
        ++fluid;
    }
    /// Removes fluid particle i; the last one takes its place.
    void remove_fluid(std::size_t i) {
        for_each_array([i](auto& array) { array[i] = array.back(), array.pop_back(); });
        --fluid;
    }
};

}  // namespace cmps
