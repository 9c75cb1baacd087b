#include "cmps/flow_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/cmps_tank.hpp"

namespace {

constexpr double l0 = 0.01;

struct Tank {
    cmps::Solid solid;
    cmps::WaterMotion motion;
    cmps::Particles particles = cmps_tank::particles(
        0.4, l0, [](double) { return 0.2; }, 0.3);
    Tank() {
        solid.add({{-1, -1}, {2, -1}, {2, 0}, {-1, 0}}, cmps::body_bed);
        solid.find_surface({-0.5, -0.5}, {1.5, 1.0});
        for (auto* array : {&motion.u, &motion.w, &motion.du_dt, &motion.dw_dt})
            array->resize(particles.size());
        for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i) {
            motion.u[i] = 1 + 2 * particles.x[i] - 3 * particles.z[i];
            motion.w[i] = -1 + particles.x[i] + 4 * particles.z[i];
            motion.du_dt[i] = 5 * particles.z[i];
        }
    }
};

TEST(FlowGrid, LinearFieldsAreExactUpToTheBedAndTheSurface) {
    Tank tank;
    cmps::FlowGrid grid({.x0 = 0.1, .x1 = 0.3, .z0 = 0.0, .z1 = 0.2, .spacing = 0.01, .interval = 1},
                        tank.solid, l0);
    grid.evaluate(tank.particles, tank.motion);
    for (std::size_t k = 0; k < grid.z.size(); ++k)
        for (std::size_t i = 0; i < grid.x.size(); ++i) {
            const std::size_t node = k * grid.x.size() + i;
            const double x = grid.x[i], z = grid.z[k];
            EXPECT_NEAR(grid.velocity[2 * node], 1 + 2 * x - 3 * z, 1e-5);  // stored as float
            EXPECT_NEAR(grid.velocity[2 * node + 1], z > 0 ? -1 + x + 4 * z : 0.0,
                        1e-5);  // not across the bed
            EXPECT_NEAR(grid.acceleration[2 * node], 5 * z, 1e-5);
        }
}

TEST(FlowGrid, WetFractionIsOneInWaterHalfAtTheSurfaceZeroAbove) {
    Tank tank;
    cmps::FlowGrid grid({.x0 = 0.1, .x1 = 0.3, .z0 = 0.0, .z1 = 0.3, .spacing = 0.01, .interval = 1},
                        tank.solid, l0);
    grid.evaluate(tank.particles, tank.motion);
    const auto wet = [&](double z) {
        return grid.wet[static_cast<std::size_t>(std::lround(z / 0.01)) * grid.x.size() + 10];
    };
    for (double z = 0; z < 0.175; z += 0.01) EXPECT_GT(wet(z), 0.99) << z;  // no holes, also at the bed
    EXPECT_NEAR(wet(0.2), 0.5, 0.03);                                       // by symmetry of the lattice
    for (double z = 0.23; z < 0.3; z += 0.01) EXPECT_EQ(wet(z), 0) << z;
}

TEST(FlowGrid, NodesInTheBedCopyTheWaterAbove) {
    Tank tank;
    cmps::FlowGrid grid({.x0 = 0.1, .x1 = 0.3, .z0 = -0.04, .z1 = 0.1, .spacing = 0.01, .interval = 1},
                        tank.solid, l0);
    grid.evaluate(tank.particles, tank.motion);
    const std::size_t nx = grid.x.size();
    for (std::size_t i = 0; i < nx; ++i) {
        EXPECT_GT(grid.wet[i], 0.99);
        EXPECT_NEAR(grid.velocity[2 * i], 1 + 2 * grid.x[i], 0.05);  // value at z = 0 or one node above
    }
}

}  // namespace
