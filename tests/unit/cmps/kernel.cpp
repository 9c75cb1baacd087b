#include "cmps/kernel.hpp"

#include <gtest/gtest.h>

namespace {

// Lattice sums computed independently to three or four figures; tolerance: half a unit of the last figure
// given.
TEST(Kernel, LatticeConstantsOfTheRationalKernel) {
    const auto narrow = cmps::lattice_constants(cmps::RationalKernel{2.1}, 1.0);
    EXPECT_NEAR(narrow.number_density, 6.540, 5e-4);
    EXPECT_NEAR(narrow.lambda, 1.388, 5e-4);
    // by hand: sum re/r over 4 neighbours at 1, 4 at sqrt 2, 4 at 2
    EXPECT_NEAR(narrow.divergence_scale, 4 * 2.1 * (1 + std::sqrt(0.5) + 0.5) / (2 * narrow.number_density),
                1e-12);
    EXPECT_NEAR(narrow.laplacian_scale, 2.126, 1e-3);
    const auto wide = cmps::lattice_constants(cmps::RationalKernel{3.1}, 1.0);
    EXPECT_NEAR(wide.number_density, 18.976, 1e-3);
    EXPECT_NEAR(wide.divergence_scale, 1.238, 5e-4);
}

TEST(Kernel, LatticeConstantsOfTheWendlandKernel) {
    const auto constants = cmps::lattice_constants(cmps::WendlandKernel{3.1}, 1.0);
    EXPECT_NEAR(constants.number_density, 3.333, 1e-3);
    EXPECT_NEAR(constants.lambda, 1.728, 1e-3);
    EXPECT_NEAR(constants.divergence_scale, 1.290, 1e-3);
    EXPECT_NEAR(constants.laplacian_scale, 2.563, 2e-3);
}

TEST(Kernel, ConstantsScaleWithTheSpacing) {
    const auto unit = cmps::lattice_constants(cmps::WendlandKernel{2.6}, 1.0);
    const auto small = cmps::lattice_constants(cmps::WendlandKernel{2.6 * 0.01}, 0.01);
    EXPECT_NEAR(small.number_density, unit.number_density, 1e-12);      // round-off
    EXPECT_NEAR(small.lambda, unit.lambda * 1e-4, 1e-16);               // round-off
    EXPECT_NEAR(small.divergence_scale, unit.divergence_scale, 1e-12);  // round-off
}

template <class Kernel>
void expect_derivatives(const Kernel& kernel) {
    for (const double r : {0.4, 1.0, 1.7, 2.3}) {
        const double h = 1e-5;
        const auto w = [&](double s) { return kernel.weight(s * s); };
        const double first = (w(r + h) - w(r - h)) / (2 * h),
                     second = (w(r + h) - 2 * w(r) + w(r - h)) / (h * h);
        EXPECT_NEAR(kernel.slope(r * r), first / r, 1e-6);               // of the difference quotient
        EXPECT_NEAR(kernel.curvature(r * r), second - first / r, 1e-4);  // round-off over h^2
    }
}

TEST(Kernel, SlopeAndCurvatureAreDerivativesOfTheWeight) {
    expect_derivatives(cmps::WendlandKernel{2.6});
    expect_derivatives(cmps::RationalKernel{2.6});
}

}  // namespace
