/// The bounds by which a run judges itself: each passes just below, stops just above, and names its figure.
#include "cmps/balance.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <string>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "cmps/effects/gravity_history.hpp"
#include "cmps/effects/moving_wall.hpp"
#include "cmps/scene_geometry.hpp"
#include "common/errors.hpp"
#include "tests/support/cmps_tank.hpp"

namespace {

constexpr double l0 = 0.02, depth = 0.2, g = 9.81, rho = 1000.0;

/// Water 0.2 m deep in a flume of 1 m.
struct Flume {
    explicit Flume(cmps::Drive drive = cmps::Drive::none) : Flume(make_scene(drive)) {}
    explicit Flume(const cmps::Scene& chosen)
        : scene(chosen),
          solid(make_solid(scene)),
          field(scene.settings, initial_particles(scene, solid, nullptr)),
          balance(scene, solid, field) {}
    Flume(const Flume&) = delete;

    static cmps::Scene make_scene(cmps::Drive drive) {
        cmps::Scene scene;
        scene.bed = {{-3, -depth}, {4, -depth}};
        scene.offshore = 0, scene.onshore = 1;
        scene.settings = cmps_tank::settings(l0, depth);
        scene.drive = drive;
        return scene;
    }
    double count() const { return static_cast<double>(field.particles.fluid); }
    double scale() const { return 0.5 * rho * g * depth * l0 * l0 * count(); }
    void move_all(double u) {
        for (std::size_t i = field.particles.first_fluid(); i < field.particles.size(); ++i)
            field.particles.u[i] = u;
    }
    void update(const cmps::Work& work = {}) { balance.update(field, 0.0, work); }
    /// What judge() says; empty: it lets the run go on.
    std::string verdict(std::size_t returned = 0) const {
        try {
            balance.judge(field, 1.5, returned);
        } catch (const common::RunError& error) {
            return error.what();
        }
        return "";
    }

    cmps::Scene scene;
    cmps::Solid solid;
    cmps::NearField field;
    cmps::Balance balance;
};

testing::AssertionResult says(const std::string& message, const std::string& figure) {
    if (message.find("unstable at t = 1.5000 s: ") == 0 && message.find(figure) != std::string::npos)
        return testing::AssertionSuccess();
    return testing::AssertionFailure() << '"' << message << "\" lacks " << figure;
}

TEST(Balance, SolvesThatDoNotConverge) {
    Flume flume;
    flume.update();
    flume.field.counts.steps = 1000;
    flume.field.counts.unconverged = 10;  // 1 % of them
    EXPECT_EQ(flume.verdict(), "");
    flume.field.counts.unconverged = 11;
    EXPECT_TRUE(says(flume.verdict(), "11 of 1000 pressure solves did not converge, bound 10"));
    flume.field.counts.steps = 100, flume.field.counts.unconverged = 5;  // a few at the start are no fault
    EXPECT_EQ(flume.verdict(), "");
    flume.field.counts.unconverged = 6;
    EXPECT_TRUE(says(flume.verdict(), "6 of 100 "));
}

TEST(Balance, ParticlesPutBackOutOfTheSolid) {
    Flume flume;
    flume.update();
    flume.field.counts.steps = 1000;
    const auto bound = static_cast<std::size_t>(6e-4 * 1000 * flume.count());
    EXPECT_EQ(flume.verdict(bound), "");
    EXPECT_TRUE(says(flume.verdict(bound + 1), std::to_string(bound + 1) + " times in 1000 steps of 500"));
    flume.field.counts.steps = 10;  // a hundred are too few to judge
    EXPECT_EQ(flume.verdict(100), "");
    EXPECT_TRUE(says(flume.verdict(101), "101 times"));
}

TEST(Balance, VolumeThatIsOff) {
    for (const double sign : {1.0, -1.0}) {
        Flume flume;
        std::vector<double> state = flume.balance.state();
        state.at(2) = sign * 0.199;  // drift of the volume
        flume.balance.restore(state);
        EXPECT_EQ(flume.verdict(), "");
        state.at(2) = sign * 0.201;
        flume.balance.restore(state);
        EXPECT_TRUE(says(flume.verdict(), sign > 0 ? "volume is off by +20 %, bound 20 %"
                                                   : "volume is off by -20 %, bound 20 %"));
    }
}

TEST(Balance, SeesTheVolumeOfTheProfile) {
    Flume flume;
    flume.update();
    EXPECT_NEAR(flume.balance.state().at(2), 0.0, 1e-12);  // against itself
    for (std::size_t i = flume.field.particles.first_fluid(); i < flume.field.particles.size(); ++i)
        flume.field.particles.z[i] = -depth + 1.25 * (flume.field.particles.z[i] + depth);
    flume.update();
    // a column a quarter higher, half a spacing of it the surface's own
    EXPECT_NEAR(flume.balance.state().at(2), 0.25, 0.5 * l0 / depth);
    EXPECT_TRUE(says(flume.verdict(), "volume is off by +2"));
}

TEST(Balance, WaterThatWentOverTheStructureIsNoLossOfVolume) {
    cmps::Scene scene = Flume::make_scene(cmps::Drive::none);
    scene.structure = {{{0.6, -depth}, {0.7, -depth}, {0.7, 0.04}, {0.6, 0.04}}};
    Flume flume(scene);
    auto& particles = flume.field.particles;
    for (std::size_t i = particles.first_fluid(); i < particles.size(); ++i)
        if (particles.z[i] > -0.3 * depth) particles.x[i] = 0.9;
    flume.update();
    EXPECT_NEAR(flume.balance.state().at(2), 0.0, 0.25 * l0 / depth);  // the profile is known to that
    EXPECT_EQ(flume.verdict(), "");
}

/// Kinetic energy of `share` rho g h / 2 (with its sum of work, J) passes where `passes`.
void expect_energy(cmps::Drive drive, double share, const cmps::Work& work, bool passes,
                   const std::string& figure = "") {
    Flume flume(drive);
    flume.move_all(std::sqrt(share * g * depth));
    flume.update({work.net * flume.scale(), work.gross * flume.scale()});
    if (passes)
        EXPECT_EQ(flume.verdict(), "") << share;
    else
        EXPECT_TRUE(says(flume.verdict(), figure)) << share;
}

TEST(Balance, EnergyOfClosedWater) {
    expect_energy(cmps::Drive::none, 0.099, {}, true);
    expect_energy(cmps::Drive::none, 0.104, {}, false,
                  "gained 0.10 of rho g h / 2, bound 0.10, and nothing does work");
    expect_energy(cmps::Drive::none, 0.301, {}, false, "gained 0.30 ");
}

/// Water that has lost half of its energy in a blow and then gains is as wrong as water that gains at once.
TEST(Balance, EnergyIsGainedFromTheLeastThereWas) {
    for (const bool passes : {true, false}) {
        Flume flume;
        flume.move_all(std::sqrt(0.5 * g * depth));
        cmps::Balance balance(flume.scene, flume.solid, flume.field);
        const auto say = [&] {
            try {
                balance.judge(flume.field, 1.5, 0);
            } catch (const common::RunError& error) {
                return std::string(error.what());
            }
            return std::string();
        };
        flume.move_all(0);
        balance.update(flume.field, 0.0, {});
        EXPECT_EQ(say(), "");
        flume.move_all(std::sqrt((passes ? 0.099 : 0.104) * g * depth));
        balance.update(flume.field, 0.0, {});
        EXPECT_EQ(say().empty(), passes);
        EXPECT_NEAR(balance.state().at(10), passes ? 0.099 : 0.104, 1e-9);
    }
}

TEST(Balance, EnergyIsMeasuredByTheGravityOfTheScene) {
    for (const double times : {0.01, 50.0}) {
        cmps::Scene scene = Flume::make_scene(cmps::Drive::none);
        scene.settings.gravity_z *= times;
        for (const bool passes : {true, false}) {
            Flume flume(scene);
            flume.move_all(std::sqrt((passes ? 0.099 : 0.104) * times * g * depth));
            flume.update();
            EXPECT_EQ(flume.verdict().empty(), passes) << times;
        }
    }
}

TEST(Balance, EnergyThatWavesBring) {
    expect_energy(cmps::Drive::waves, 1.499, {}, true);
    expect_energy(cmps::Drive::waves, 1.501, {}, false,
                  "gained 1.50 of rho g h / 2, bound 1.50, more than waves can bring");
}

TEST(Balance, EnergyBeyondTheWorkOfAPiston) {
    const cmps::Work work{.net = 0.8, .gross = 1.2};  // bound 0.8 + 0.1 + 0.12
    expect_energy(cmps::Drive::piston, 1.019, work, true);
    expect_energy(cmps::Drive::piston, 1.021, work, false,
                  "gained 0.22 of rho g h / 2, bound 0.22, beyond the work of 0.80");
    expect_energy(cmps::Drive::piston, 0.104, {}, false, "gained 0.10 ");  // one that stands still
}

TEST(Balance, RemembersItsFiguresAcrossARestart) {
    Flume flume(cmps::Drive::piston);
    flume.move_all(1.0);
    flume.update({.net = 0.3, .gross = 0.4});
    Flume other(cmps::Drive::piston);
    other.balance.restore(flume.balance.state());
    EXPECT_EQ(other.balance.state(), flume.balance.state());
    EXPECT_EQ(other.verdict(), flume.verdict());
}

/// A piston that pushes still water: what it gives is what the water has.
TEST(Work, OfAPistonIsWhatTheWaterGains) {
    cmps::Scene scene = Flume::make_scene(cmps::Drive::piston);
    scene.piston = {.start = 0, .least = 0, .most = 0.1, .fastest = 0.2};
    const cmps::Solid solid = make_solid(scene);
    cmps::NearField field(scene.settings, initial_particles(scene, solid, nullptr));
    field.settle(100, 0.0);
    cmps::Balance balance(scene, solid, field);
    auto wall = std::make_unique<cmps::MovingWall>(0.0, [](double, double, double) { return 0.2; });
    const cmps::MovingWall& piston = *wall;
    field.effects.push_back(std::move(wall));
    cmps_tank::run(field, 0.5);
    balance.update(field, piston.position(), piston.work());
    const double scale = 0.5 * rho * g * depth * l0 * l0 * static_cast<double>(field.particles.fluid);
    const double work = piston.work().net / scale, unexplained = balance.state().at(6);
    EXPECT_GT(work, 0.1);
    EXPECT_NEAR(unexplained, 0.0, 0.1 * work);  // the wall's pressure is known to a twentieth; steps damp
}

/// A block that falls freely: the table's gravity does all the work there is.
TEST(Work, OfGravityFromATableIsWhatFallingWaterGains) {
    const auto path = std::filesystem::temp_directory_path() /
                      ("tsunagi_gravity_of_a_fall_" + std::to_string(::getpid()) + ".csv");
    std::ofstream(path) << "t, gx, gz\n0, 3, -9.81\n10, 3, -9.81\n";
    cmps::Particles block;
    for (int i = 0; i < 8; ++i)
        for (int k = 0; k < 8; ++k)
            block.add_fluid((i + 0.5) * l0, (k + 0.5) * l0, static_cast<std::int32_t>(block.fluid));
    cmps::NearField field(cmps_tank::settings(l0, 8 * l0), block);
    auto gravity = std::make_unique<cmps::GravityHistory>(cmps::TimeTable(path, 3));
    const cmps::GravityHistory& table = *gravity;
    field.effects.push_back(std::move(gravity));
    cmps_tank::run(field, 0.3);
    double energy = 0;
    for (std::size_t i = 0; i < field.particles.size(); ++i)
        energy += 0.5 * rho * l0 * l0 *
                  (field.particles.u[i] * field.particles.u[i] + field.particles.w[i] * field.particles.w[i]);
    EXPECT_NEAR(table.work().net / energy, 1.0, 1e-4);  // pairs in single precision
    EXPECT_NEAR(table.work().gross, table.work().net, 1e-9 * energy);
    std::filesystem::remove(path);
}

/// The speed that stops a run, of water that flies through nothing as one.
TEST(Noticing, SpeedBeyondEveryFall) {
    const double limit = 5.0 * std::sqrt(2.0 * g * depth) + 5.0;
    for (const double share : {0.999, 1.001}) {
        cmps::Particles block;
        for (int i = 0; i < 6; ++i)
            for (int k = 0; k < 6; ++k)
                block.add_fluid((i + 0.5) * l0, (k + 0.5) * l0, static_cast<std::int32_t>(block.fluid));
        cmps::NearField field(cmps_tank::settings(l0, depth), block);
        for (double& u : field.particles.u) u = share * limit;  // not the speed it began with
        std::string message;
        try {
            field.advance(0.0, 1e-6);
        } catch (const common::RunError& error) {
            message = error.what();
        }
        if (share < 1)
            EXPECT_EQ(message, "");
        else
            EXPECT_TRUE(message.find("moves at 14.9") != std::string::npos &&
                        message.find("limit 14.9") != std::string::npos)
                << message;
    }
}

}  // namespace
