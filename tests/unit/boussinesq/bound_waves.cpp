// Bound waves of second order against the exact waves of the equations and published theory.
#include "boussinesq/waves/bound_waves.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "boussinesq/grid.hpp"
#include "boussinesq/waves/permanent_wave.hpp"
#include "boussinesq/waves/wave_components.hpp"

namespace {

using namespace boussinesq;
constexpr double pi = std::numbers::pi;

TEST(BoundWaves, SecondHarmonicIsThatOfTheExactWave) {
    for (const double alpha : {1.0, 1.153})
        for (const double period : {1.3, 1.65, 2.5}) {
            const double depth = 0.8, height = 0.002;
            const PermanentForm form = permanent_form(alpha, height, period, depth);
            const double k = 2.0 * pi / form.length;
            const BoundPair pair = bound_pair({.alpha = alpha}, depth, k, k, 1);
            const double a = form.amplitude[0];
            // the next terms of the expansion are (a times a few k)^2 = 1e-4 smaller
            EXPECT_NEAR(form.amplitude[1] / (pair.elevation * a * a), 1.0, 1e-3)
                << "alpha " << alpha << ", T " << period;
        }
}

TEST(BoundWaves, LongWaveUnderGroupsFollowsRadiationStress) {
    // Longuet-Higgins and Stewart (1962): eta = -S / (rho (g d - cg^2)), S = rho g a1 a2 (2 cg / c - 1/2).
    // Group and phase speed of Airy; the equations' own stress departs from theirs with k d.
    const double depth = 0.8;
    for (const auto& [kd, bound] : {std::pair{0.25, 0.03}, std::pair{0.5, 0.05}, std::pair{1.0, 0.15}}) {
        const double k = kd / depth, w = std::sqrt(gravity * k * std::tanh(kd));
        const double cg = airy_group_speed(k, depth), c = w / k;
        const double theory = -gravity * (2.0 * cg / c - 0.5) / (gravity * depth - cg * cg);
        const BoundPair pair = bound_pair({.alpha = 1.153}, depth, 1.001 * k, 0.999 * k, -1);
        const double computed = 2.0 * pair.elevation;  // both orders of the pair
        RecordProperty("ratio", std::to_string(computed / theory));
        std::printf("    kd = %.2f: bound long wave over theory %.4f\n", kd, computed / theory);
        EXPECT_NEAR(computed / theory, 1.0, bound);
    }
}

TEST(BoundWaves, FewPointsStandForAllPairs) {
    const double depth = 0.8;
    const LinearDispersion dispersion{.alpha = 1.153};
    const SeaState sea{.significant_height = 0.1, .peak_period = 1.8, .components = 30, .seed = 5};
    const auto components = sea_components(sea, dispersion, depth);
    std::vector<double> k, a;
    for (const auto& c : components) k.push_back(c.wave_number), a.push_back(c.elevation_amplitude);
    const ComponentWave plain(components, 0.0, 0.01);
    const ComponentWave wave(components, 0.0, 0.01, bound_waves(dispersion, depth, k, a));
    const std::vector<double> x{1.0, 1.5, 2.0, 2.5, 3.0};
    std::vector<double> eta(5), u(5), eta_plain(5), u_plain(5);
    const double t = 7.0;
    plain.at(t, x, eta_plain, u_plain);
    wave.at(t, x, eta, u);
    double scale = 0;
    for (std::size_t i = 0; i < x.size(); ++i) scale = std::max(scale, std::abs(eta[i] - eta_plain[i]));
    EXPECT_GT(scale, 1e-4);  // there is something to compare
    for (std::size_t i = 0; i < x.size(); ++i) {
        double eta_all = 0, u_all = 0;
        for (std::size_t m = 0; m < k.size(); ++m)
            for (std::size_t n = 0; n < k.size(); ++n)
                for (const int sign : {1, -1}) {
                    if (sign < 0 && m == n) continue;  // the mean
                    const auto phase = [&](std::size_t j) {
                        return k[j] * x[i] - components[j].angular_frequency * t +
                               components[j].elevation_phase;
                    };
                    const BoundPair pair = bound_pair(dispersion, depth, k[m], k[n], sign);
                    eta_all += pair.elevation * a[m] * a[n] * std::cos(phase(m) + sign * phase(n));
                    u_all += pair.velocity * a[m] * a[n] * std::cos(phase(m) + sign * phase(n));
                }
        for (std::size_t n = 0; n < k.size(); ++n)
            u_all -= 0.5 * components[n].velocity_amplitude * a[n] / depth;  // no mean flux
        EXPECT_NEAR(eta[i] - eta_plain[i], eta_all, 1e-4 * scale);  // interpolation between the points
        EXPECT_NEAR(u[i] - u_plain[i], u_all, 1e-4 * scale * std::sqrt(gravity / depth));
    }
}

}  // namespace
