/// The grid on which dem receives the flow: velocity, acceleration and wet fraction from the particles.
///
/// Moving least squares of first order over fluid particles within reach (exact for linear fields, also next
/// to the bed and the surface); a plain weighted mean where too few particles stand around. Wet fraction:
/// share of the kernel that water fills of what the solid leaves, so that it is 1/2 on the surface. Nodes in
/// the solid copy the nearest node outside it: an interpolation at the bed finds no holes. Nothing moves
/// across the face of the solid, on its nodes and beneath. Zero where dry.
#pragma once

#include <vector>

#include "cmps/particles.hpp"
#include "cmps/path_average.hpp"
#include "cmps/solid.hpp"

namespace cmps {

struct FlowGridSettings {
    double x0 = 0, x1 = 0, z0 = 0, z1 = 0;  ///< m
    double spacing = 0;                     ///< m
    double interval = 0;                    ///< s between samples
};

class FlowGrid {
 public:
    FlowGrid(const FlowGridSettings& settings, const Solid& solid, double particle_spacing);

    /// `motion`: of the water at the particles.
    void evaluate(const Particles& particles, const WaterMotion& motion);

    std::vector<double> x, z;         ///< nodes, m
    std::vector<float> velocity;      ///< (nz, nx, 2), m/s
    std::vector<float> acceleration;  ///< (nz, nx, 2), Du/Dt, m/s2
    std::vector<float> wet;           ///< (nz, nx)

 private:
    std::int32_t nearest_free(const std::vector<char>& is_solid, std::size_t i, std::size_t k) const;
    double particle_spacing_, reach_, full_weight_;
    std::vector<std::int32_t> source_;  ///< node to copy from; itself outside the solid, -1: nothing near
    std::vector<Point> normal_;         ///< of the face that a node lies on or beneath; zero elsewhere
    std::vector<double> sums_;
};

/// Linear least-squares value at one point: sums of w, w dx, w dz, w dx^2, w dx dz, w dz^2 and of w f, w f
/// dx, w f dz.
double linear_fit(const double moments[6], const double values[3], double scale);

}  // namespace cmps
