/// The filter takes particle-scale noise out and leaves a smooth velocity and the momentum alone.
#include "cmps/velocity_filter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace {

constexpr double spacing = 0.01;

/// A free blob of 24 x 24 particles off their lattice by up to a tenth of a spacing, filtered 20 times.
struct Filtered {
    cmps::Particles particles;
    std::vector<double> before;
    double momentum_change = 0;

    explicit Filtered(const std::function<double(double, double)>& velocity) {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> shift(-0.1 * spacing, 0.1 * spacing);
        for (int i = 0; i < 24; ++i)
            for (int k = 0; k < 24; ++k)
                particles.add_fluid(i * spacing + shift(random), k * spacing + shift(random), 24 * i + k);
        for (std::size_t i = 0; i < particles.size(); ++i)
            particles.u[i] = velocity(particles.x[i], particles.z[i]);
        cmps::NeighbourSearch search(2.6 * spacing, 0.3 * spacing);
        search.update(particles, {});
        before = particles.u;
        const cmps::WendlandKernel kernel{2.6 * spacing};
        const double n0 = cmps::lattice_constants(kernel, spacing).number_density;
        cmps::Interactions interactions;
        cmps::compute_interactions(kernel, particles, search.lists(), {}, interactions);
        cmps::VelocityFilter filter;
        for (int k = 0; k < 20; ++k) {
            filter.find_gradients(particles, search.lists(), interactions, n0);
            filter.apply(particles, search.lists(), interactions, n0, 0.1);
        }
        for (std::size_t i = 0; i < particles.size(); ++i) momentum_change += particles.u[i] - before[i];
    }
    double largest_change() const {
        double largest = 0;
        for (std::size_t i = 0; i < before.size(); ++i)
            largest = std::max(largest, std::abs(particles.u[i] - before[i]));
        return largest;
    }
    double rms() const {
        double sum = 0;
        for (const double u : particles.u) sum += u * u;
        return std::sqrt(sum / static_cast<double>(particles.size()));
    }
};

TEST(VelocityFilter, LeavesALinearVelocity) {
    const Filtered blob([](double x, double z) { return 3 * x - 5 * z + 0.7; });
    EXPECT_LT(blob.largest_change(), 1e-6);  // pairs are kept as float: 6e-8 of 2 m/s, 20 times
}

TEST(VelocityFilter, TakesNoiseOutAndKeepsMomentum) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> noise(-1, 1);
    const Filtered blob([&](double, double) { return noise(random); });
    EXPECT_LT(blob.rms(), 0.35);  // 0.58 before; what is left are waves longer than a few spacings
    EXPECT_LT(std::abs(blob.momentum_change), 1e-10);  // 576 rounded terms, 20 times
}

TEST(VelocityFilter, LosesLittleOfAWave) {
    constexpr double length = 20 * spacing;
    const Filtered blob([](double x, double z) {
        return std::cos(2 * M_PI * x / length) * std::cosh(2 * M_PI * z / length);
    });
    // a plain viscosity of this strength would take 20 * 0.1 * lambda/4 k^2 = 12 % and more
    double kept = 0, all = 0;
    for (std::size_t i = 0; i < blob.before.size(); ++i)
        kept += blob.particles.u[i] * blob.before[i], all += blob.before[i] * blob.before[i];
    EXPECT_GT(kept / all, 0.97);
}

}  // namespace
