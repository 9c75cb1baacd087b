#include "cmps/wave_field.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "common/errors.hpp"
#include "common/window_channel.hpp"

namespace {

constexpr double depth = 0.4, amplitude = 0.01, wave_number = 1.5, frequency = 2.8;

double elevation(double x, double t) {
    return amplitude * std::cos(wave_number * x - frequency * t);
}
double mean_velocity(double x, double t) {
    return frequency / wave_number / depth * elevation(x, t);
}

/// Windows of half a second of a small progressive wave.
std::filesystem::path write_windows(const std::string& name, int count) {
    const auto folder = std::filesystem::path(testing::TempDir()) /
                        ("cmps_wave_field_" + name + "_" + std::to_string(getpid()));
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    for (int index = 0; index < count; ++index) {
        common::Window window{.stage = "boussinesq",
                              .index = index,
                              .t_begin = 0.5 * index,
                              .t_end = 0.5 * (index + 1),
                              .scene_digest = "d",
                              .input_digest = "",
                              .datasets = {}};
        std::vector<double> t, x, h, eta, u;
        for (int k = 0; k <= 20; ++k) t.push_back(window.t_begin + 0.025 * k);
        for (int i = 0; i <= 100; ++i) x.push_back(0.05 * i), h.push_back(depth);
        for (const double tt : t)
            for (const double xx : x) eta.push_back(elevation(xx, tt)), u.push_back(mean_velocity(xx, tt));
        window.datasets["/time"] = common::real64("s", {t.size()}, t);
        window.datasets["/x"] = common::real64("m", {x.size()}, x);
        window.datasets["/still_water_depth"] = common::real64("m", {x.size()}, h);
        window.datasets["/surface_elevation"] = common::real64("m", {t.size(), x.size()}, eta);
        window.datasets["/velocity"] = common::real64("m/s", {t.size(), x.size()}, u);
        common::publish_window(folder, window);
    }
    return folder;
}

common::WindowReader reader_of(const std::filesystem::path& folder) {
    return common::WindowReader(folder, "boussinesq",
                                {{"/time", "s", {"nt"}},
                                 {"/x", "m", {"nx"}},
                                 {"/still_water_depth", "m", {"nx"}},
                                 {"/surface_elevation", "m", {"nt", "nx"}},
                                 {"/velocity", "m/s", {"nt", "nx"}}},
                                false);
}

TEST(WaveField, InterpolatesInTimeAndSpaceAcrossWindows) {
    auto reader = reader_of(write_windows("interpolation", 4));
    cmps::WaveField waves(reader, 2.0, 3.0, 100.0);
    for (const double t : {0.011, 0.49, 0.51, 1.234, 1.99}) {
        waves.cover(t, t);
        waves.go_to(t);
        for (const double x : {2.0, 2.33, 2.91}) {
            // cubic in time (error (w dt)^3 at window ends), linear in x ((k dx)^2/8 = 7e-4)
            EXPECT_NEAR(waves.surface_elevation(x), elevation(x, t), 1e-3 * amplitude + 1e-12);
            EXPECT_NEAR(waves.mean_velocity(x), mean_velocity(x, t),
                        1e-3 * amplitude * frequency / wave_number / depth);
        }
    }
}

TEST(WaveField, ProfileHasTheMeanAndTheShapeOfLinearTheory) {
    auto reader = reader_of(write_windows("profile", 2));
    cmps::WaveField waves(reader, 2.0, 3.0, 100.0);
    waves.cover(0.0, 0.3);
    waves.go_to(0.3);
    const double x = 2.5, h = depth + elevation(x, 0.3);
    double flux = 0;
    constexpr int levels = 400;
    for (int k = 0; k < levels; ++k) {
        double u, w;
        waves.velocity(x, -depth + (k + 0.5) / levels * h, u, w);
        flux += u / levels;
    }
    EXPECT_NEAR(flux, waves.mean_velocity(x), 1e-4 * std::abs(waves.mean_velocity(x)));  // midpoint rule
    // u(z)/mean against cosh(k(z+h)) kh / sinh(kh): the profile is its expansion to (kh)^2, kh = 0.6
    for (const double z : {-0.4, -0.2, 0.0}) {
        double u, w;
        waves.velocity(x, z, u, w);
        const double kh = wave_number * depth;
        EXPECT_NEAR(u / waves.mean_velocity(x), std::cosh(wave_number * (z + depth)) * kh / std::sinh(kh),
                    0.02);  // (kh)^4/24 and elevation/depth
        const double slope = -wave_number * frequency / wave_number / depth * amplitude *
                             std::sin(wave_number * x - frequency * 0.3);
        EXPECT_NEAR(w, -(z + depth) * slope, 0.02 * std::abs(slope) * depth);  // differences over dx
    }
}

TEST(WaveField, FindsTheArrival) {
    auto reader = reader_of(write_windows("arrival", 4));
    cmps::WaveField waves(reader, 2.0, 3.0, 100.0);
    EXPECT_NEAR(waves.arrival(2.5, 0.5 * amplitude, 0.7), 0.7,
                0.5);  // the wave reaches it twice a period of 2.2 s
    EXPECT_LT(waves.arrival(2.5, 2 * amplitude, 0.0), 0);
}

TEST(WaveField, SaysWhatIsNotCovered) {
    auto reader = reader_of(write_windows("coverage", 2));
    EXPECT_THROW(cmps::WaveField(reader, 4.5, 6.0, 100.0), common::InputError);
    cmps::WaveField waves(reader, 2.0, 3.0, 100.0);
    EXPECT_THROW(waves.cover(0.0, 2.0), common::InputError);
}

}  // namespace
