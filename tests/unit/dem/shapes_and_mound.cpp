/// Shapes, mound, fixed spheres.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "dem/boundaries.hpp"
#include "dem/mound.hpp"
#include "dem/placement.hpp"
#include "dem/scene.hpp"

namespace {

using dem::Vector;

dem::Shape built_in(const std::string& name) {
    return dem::make_shape(dem::find_shape(name, "."), dem::Element{}, 1000);
}

TEST(Shape, BeehiveHasThePapersMassAndOutline) {
    const dem::Shape shape = built_in("beehive96");
    EXPECT_EQ(shape.spheres.size(), 96u);
    EXPECT_NEAR(shape.mass, 0.0949, 5e-5);  // kg, the figure of the source, three digits
    EXPECT_NEAR(shape.length, 0.048, 1e-12);
    EXPECT_NEAR(shape.height, 0.024, 1e-12);
    EXPECT_LT(shape.exposed.size(), 96u);  // some have neighbours on all sides
    EXPECT_GE(shape.exposed.size(), 84u);
}

TEST(Shape, InertiaOfACubeIsThatOfTheSum) {
    const dem::Shape shape = built_in("cube27");
    const double m = shape.mass / 27, d = 0.008;
    // Sum over a 3 x 3 x 3 lattice of y^2 + z^2 is 36 d^2; 2/5 m r^2 for each sphere.
    const double expected = m * (36 * d * d + 27 * 0.4 * d * d / 4);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(shape.inertia[k], expected, 1e-12 * expected);
    EXPECT_EQ(shape.exposed.size(), 26u);
}

TEST(Shape, CoarserShapesKeepMassAndOutline) {
    const dem::Shape fine = built_in("beehive96");
    for (const char* name : {"beehive48", "beehive24"}) {
        const dem::Shape coarse = built_in(name);
        EXPECT_NEAR(coarse.mass, fine.mass, 1e-12);
        EXPECT_NEAR(coarse.length, fine.length, 1e-9) << name;
        EXPECT_NEAR(coarse.height, fine.height, 1e-9) << name;
        EXPECT_NEAR(coarse.displaced_volume, fine.displaced_volume, 1e-15);
    }
}

TEST(Shape, LopsidedClumpIsTurnedOntoItsPrincipalAxes) {
    dem::ShapeDescription description;
    description.name = "hook";
    description.spheres = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 1, 1}};
    const dem::Shape shape = dem::make_shape(description, dem::Element{}, 1000);
    dem::Rotation products = dem::Rotation::Zero();
    Vector centre = Vector::Zero();
    for (const auto& r : shape.spheres) {
        products += r * r.transpose();
        centre += r;
    }
    EXPECT_LT(centre.norm(), 1e-15);
    products.diagonal().setZero();
    EXPECT_LT(products.norm(), 1e-18);  // m^2; the lengths are 1e-2
}

TEST(Shape, RefusesWhatIsNoShape) {
    dem::ShapeDescription description;
    EXPECT_THROW(dem::make_shape(description, dem::Element{}, 1000), std::invalid_argument);
    description.spheres = {{0, 0, 0}, {0, 0, 0}};
    EXPECT_THROW(dem::make_shape(description, dem::Element{}, 1000), std::invalid_argument);
}

TEST(Mound, ColumnHeightsHaveTheMeanAndSpreadAskedFor) {
    const auto centres = dem::build_mound(
        {.profile = {{0, -0.2}, {1, -0.2}}, .y_begin = 0, .y_end = 1, .roughness = 0.008, .seed = 3});
    std::map<std::pair<long, long>, double> top;
    for (const auto& c : centres) {
        auto& height =
            top.try_emplace({std::lround(c.x() * 1e6), std::lround(c.y() * 1e6)}, -1e9).first->second;
        height = std::max(height, c.z() + 0.004);
    }
    EXPECT_EQ(top.size(), 125u * 125u);
    double mean = 0, square = 0;
    for (const auto& [place, height] : top) mean += height / static_cast<double>(top.size());
    for (const auto& [place, height] : top)
        square += (height - mean) * (height - mean) / static_cast<double>(top.size());
    // Standard errors over 15625 columns: sigma / 125, and sigma / 177; four of them.
    EXPECT_NEAR(mean, -0.2, 4 * 0.008 / 125);
    EXPECT_NEAR(std::sqrt(square), 0.008, 4 * 0.008 / 177);
}

TEST(Mound, NoHoleLetsASphereThrough) {
    const auto centres = dem::build_mound(
        {.profile = {{0, 0}, {0.2, 0}}, .y_begin = 0, .y_end = 0.2, .roughness = 0.016, .seed = 7});
    const dem::FixedSpheres mound(centres, 0.008, 0.009);
    // A visitor that stands on a column meets the flanks of its neighbours, which reach down to it.
    std::map<std::pair<long, long>, std::pair<double, double>> column;  // lowest, highest centre
    for (const auto& c : centres) {
        auto& [low, high] =
            column
                .try_emplace({std::lround(c.x() / 0.008 - 0.5), std::lround(c.y() / 0.008 - 0.5)}, 1e9, -1e9)
                .first->second;
        low = std::min(low, c.z());
        high = std::max(high, c.z());
    }
    for (const auto& [place, range] : column)
        for (long dx = -1; dx <= 1; ++dx)
            for (long dy = -1; dy <= 1; ++dy) {
                const auto other = column.find({place.first + dx, place.second + dy});
                // The lowest sphere of a column overlaps the height of its lower neighbours' tops.
                if (other != column.end()) {
                    EXPECT_LE(range.first - 0.004,
                              std::min(range.second, other->second.second) + 0.004 + 1e-12);
                }
            }
}

TEST(FixedSpheres, FindsWhatBruteForceFinds) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> place(-0.1, 0.1);
    std::vector<Vector> centres;
    for (int k = 0; k < 2000; ++k) centres.emplace_back(place(random), place(random), place(random));
    const dem::FixedSpheres fixed(centres, 0.008, 0.0095);
    for (int k = 0; k < 500; ++k) {
        const Vector point(1.2 * place(random), 1.2 * place(random), 1.2 * place(random));
        std::vector<std::uint32_t> found, expected;
        std::vector<dem::FixedSpheres::Near> near;
        fixed.find_near(point, 0.0095, near);
        for (const auto& one : near) {
            found.push_back(one.sphere);
            EXPECT_EQ(one.centre, centres[one.sphere]);
        }
        for (std::uint32_t i = 0; i < centres.size(); ++i)
            if ((centres[i] - point).norm() < 0.0095) expected.push_back(i);
        EXPECT_EQ(found, expected);
    }
}

TEST(FixedSpheres, FindsTheImagesOfAPeriodicBoxFromAnywhere) {
    constexpr double period = 0.09, reach = 0.0095;
    std::mt19937 random(6);
    std::uniform_real_distribution<double> place(-0.1, 0.1);
    std::vector<Vector> centres;  // some outside the box
    for (int k = 0; k < 500; ++k)
        centres.emplace_back(0.3 * place(random), place(random), 0.3 * place(random));
    const dem::FixedSpheres fixed(centres, 0.008, reach, period);
    std::size_t seen = 0;
    for (int k = 0; k < 500; ++k) {
        const Vector point(0.3 * place(random), 4 * place(random), 0.3 * place(random));
        std::vector<dem::FixedSpheres::Near> near;
        fixed.find_near(point, reach, near);
        std::vector<std::uint32_t> found, expected;
        for (const auto& one : near) {
            found.push_back(one.sphere);
            EXPECT_EQ(one.centre, fixed.centre_near(one.sphere, point));  // to the bit
            EXPECT_LT((one.centre - point).norm(), reach);
        }
        for (std::uint32_t i = 0; i < centres.size(); ++i)
            for (int image = -8; image <= 8; ++image)
                if ((centres[i] + Vector(0, image * period, 0) - point).norm() < reach) expected.push_back(i);
        EXPECT_EQ(found, expected);
        seen += found.size();
        EXPECT_EQ(fixed.highest_near(point.x(), point.y(), reach),
                  fixed.highest_near(point.x(), point.y() - std::floor(point.y() / period) * period, reach));
    }
    EXPECT_GT(seen, 100u);
}

TEST(Mound, PeriodicEndsLeaveNoHoleBetweenThem) {
    dem::MoundDescription description{
        .profile = {{0, 0}, {0.2, 0}}, .y_begin = 0, .y_end = 0.2, .roughness = 0.016, .seed = 7};
    description.is_periodic = true;
    std::map<long, std::array<std::pair<double, double>, 2>> ends;  // lowest, highest centre at both ends
    for (const auto& c : dem::build_mound(description)) {
        const bool is_first = c.y()<0.008, is_last = c.y()> 0.192;
        if (!is_first && !is_last) continue;
        auto& [low, high] = ends.try_emplace(std::lround(c.x() / 0.008 - 0.5),
                                             std::array{std::pair{1e9, -1e9}, std::pair{1e9, -1e9}})
                                .first->second[is_last];
        low = std::min(low, c.z());
        high = std::max(high, c.z());
    }
    EXPECT_EQ(ends.size(), 25u);
    for (const auto& [place, end] : ends)
        for (const int side : {0, 1})
            EXPECT_LE(end[static_cast<std::size_t>(side)].first - 0.004,
                      end[static_cast<std::size_t>(1 - side)].second + 0.004 + 1e-12);
}

TEST(Placement, BlocksStartJustAboveTheMound) {
    const auto centres = dem::build_mound(
        {.profile = {{0, -0.2}, {0.3, -0.2}}, .y_begin = 0, .y_end = 0.3, .roughness = 0.008, .seed = 1});
    dem::Surroundings surroundings;
    surroundings.fixed_spheres = dem::FixedSpheres(centres, 0.008, 0.0095);
    dem::Blocks blocks;
    blocks.shapes.push_back(built_in("beehive96"));
    dem::place_blocks(blocks,
                      {.shape = 0,
                       .rows = 3,
                       .columns = 4,
                       .layers = 1,
                       .fixed_rows = 0,
                       .origin_x = 0.25,
                       .origin_y = 0.05,
                       .pitch_across = 0.05,
                       .pitch_along = 0.05,
                       .level = {}},
                      surroundings.fixed_spheres);
    EXPECT_EQ(blocks.size(), 12u);
    EXPECT_EQ(dem::deepest_overlap(blocks, surroundings).depth, 0);
    for (auto& p : blocks.position) p.z() -= 0.2 * 0.008;  // twice the gap: every one of them touches
    EXPECT_GT(dem::deepest_overlap(blocks, surroundings).depth, 0);
}

}  // namespace
