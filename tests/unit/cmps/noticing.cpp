#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "cmps/effects/gravity_history.hpp"
#include "cmps/effects/viscosity.hpp"
#include "cmps/near_field.hpp"
#include "common/errors.hpp"
#include "tests/support/cmps_tank.hpp"

namespace {

constexpr double l0 = 0.02;

cmps::NearField tank() {
    cmps::Settings settings;
    settings.spacing = l0, settings.depth = 0.2;
    return {settings, cmps_tank::particles(
                          0.4, l0, [](double) { return 0.2; }, 0.3)};
}

/// Gives one particle a velocity that is no number.
struct Fault final : cmps::Effect {
    std::string name() const override { return "fault"; }
    void accelerate(cmps::NearField& field, double, double) override {
        field.particles.u[field.particles.first_fluid() + 3] = std::numeric_limits<double>::quiet_NaN();
    }
};

TEST(Noticing, AVelocityThatIsNoNumberStopsTheRun) {
    cmps::NearField field = tank();
    field.settle(1, 0.2);
    field.advance(0.0, field.largest_step());
    field.effects.push_back(std::make_unique<Fault>());
    try {
        field.advance(0.01, field.largest_step());
        FAIL() << "goes on";
    } catch (const common::RunError& error) {  // and the message names one whose velocity is none
        EXPECT_NE(std::string(error.what()).find("moves at nan m/s"), std::string::npos) << error.what();
    }
}

TEST(Noticing, ViscosityLimitsTheStep) {
    cmps::NearField field = tank();
    const double without = field.largest_step();
    const double kinematic = 0.25 * l0 * l0 / (0.5 * without);  // asks for half of it
    field.effects.push_back(std::make_unique<cmps::Viscosity>(kinematic));
    EXPECT_DOUBLE_EQ(field.largest_step(), 0.5 * without);
}

TEST(Noticing, WeightlessWaterThatAlmostRestsBearsTheGravityToCome) {
    const auto path = std::filesystem::temp_directory_path() /
                      ("tsunagi_gravity_from_none_" + std::to_string(::getpid()) + ".csv");
    std::ofstream(path) << "t, gx, gz\n0, 0, 0\n1, 0, 0\n1.001, 0, -9.81\n10, 0, -9.81\n";
    cmps::NearField field = tank();
    const double weighing = field.largest_step();
    field.effects.push_back(std::make_unique<cmps::GravityHistory>(cmps::TimeTable(path, 3)));
    for (std::size_t i = field.particles.first_fluid(); i < field.particles.size(); ++i)
        field.particles.x[i] += 1e-12 * l0 * std::sin(static_cast<double>(i));
    field.settle(100, 0.2);
    for (double time = 0; time < 0.1; time += field.last_step()) {
        ASSERT_LE(field.largest_step(), weighing);
        field.advance(time, field.largest_step());
    }
    std::filesystem::remove(path);
}

TEST(Noticing, WaterAtRestThatWeighsNothingHasAStepAndStays) {
    cmps::NearField field = tank();
    const double weighing = field.largest_step();
    field.settings.gravity_z = 0;
    EXPECT_DOUBLE_EQ(field.largest_step(), weighing);
    for (int k = 0; k < 3; ++k) field.advance(0.0, field.largest_step());
    double fastest = 0;
    for (std::size_t i = 0; i < field.particles.size(); ++i)
        fastest = std::max(fastest, std::abs(field.particles.u[i]) + std::abs(field.particles.w[i]));
    EXPECT_LT(fastest, 0.02);  // m/s: what spreads an uneven lattice, a hundredth of sqrt(g d)
    EXPECT_TRUE(std::isfinite(field.largest_step()));
}

}  // namespace
