/// What friction terms do to a shear flow, against their differential equations.
#include <gtest/gtest.h>

#include <cmath>

#include "cmps/effects/turbulence.hpp"
#include "cmps/effects/viscosity.hpp"
#include "tests/support/cmps_tank.hpp"

namespace {

constexpr double spacing = 0.01, depth = 0.3, length = 0.6, curvature = 20.0;  // u = curvature z^2 / 2, m/s

/// Water at rest but for the shear.
cmps::NearField sheared() {
    cmps::NearField field(cmps_tank::settings(spacing, depth),
                          cmps_tank::particles(
                              length, spacing, [](double) { return depth; }, 0.4));
    field.settle(1, depth);
    for (std::size_t i = field.particles.first_fluid(); i < field.particles.size(); ++i)
        field.particles.u[i] = 0.5 * curvature * field.particles.z[i] * field.particles.z[i];
    return field;
}

/// Largest relative difference of du/dt from truth(z), away from walls and surface.
template <class Effect, class Truth>
double error_of(Effect&& effect, const Truth& truth) {
    cmps::NearField field = sheared();
    const std::vector<double> before = field.particles.u;
    constexpr double step = 1e-3;
    effect.accelerate(field, 0, step);
    double largest = 0;
    int count = 0;
    for (std::size_t i = field.particles.first_fluid(); i < field.particles.size(); ++i) {
        const double x = field.particles.x[i], z = field.particles.z[i];
        if (x < 0.1 || x > length - 0.1 || z < 0.1 || z > depth - 0.05) continue;
        const double found = (field.particles.u[i] - before[i]) / step;
        largest = std::max(largest, std::abs(found / truth(z) - 1));
        ++count;
    }
    EXPECT_GT(count, 100);
    return largest;
}

TEST(Effects, EddyViscositySpreadsMomentumAsSmagorinskySays) {
    constexpr double constant = 0.15, mixing = constant * spacing;
    // d/dz [ (C l0)^2 |du/dz| du/dz ] = 2 (C l0)^2 curvature^2 z
    const auto truth = [](double z) { return 2 * mixing * mixing * curvature * curvature * z; };
    EXPECT_LT(error_of(cmps::Turbulence(constant), truth), 0.02);  // second order: (re/z)^2 / 10
}

TEST(Effects, ViscositySpreadsMomentumAsNavierAndStokesSay) {
    constexpr double kinematic = 1e-3;
    EXPECT_LT(error_of(cmps::Viscosity(kinematic), [](double) { return kinematic * curvature; }),
              1e-3);  // exact for a parabola but for pairs in single precision
}

}  // namespace
