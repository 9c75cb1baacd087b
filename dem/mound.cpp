#include "dem/mound.hpp"

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include <algorithm>
#include <cmath>
#include <memory>

namespace dem {

double mean_height(const MoundProfile& profile, double x) {
    if (x <= profile.front()[0]) return profile.front()[1];
    for (std::size_t i = 1; i < profile.size(); ++i)
        if (x <= profile[i][0])
            return profile[i - 1][1] + (profile[i][1] - profile[i - 1][1]) * (x - profile[i - 1][0]) /
                                           (profile[i][0] - profile[i - 1][0]);
    return profile.back()[1];
}

std::vector<Vector> build_mound(const MoundDescription& description) {
    const double d = description.diameter;
    const double x_begin = description.profile.front()[0], x_end = description.profile.back()[0];
    // Half a sphere's diameter of tolerance keeps a column from being lost to rounding.
    const auto count_x = static_cast<std::int64_t>((x_end - x_begin) / d + 1e-6);
    const auto count_y = static_cast<std::int64_t>((description.y_end - description.y_begin) / d + 1e-6);
    const double pitch_x = (x_end - x_begin) / static_cast<double>(std::max<std::int64_t>(count_x, 1));
    const double pitch_y =
        (description.y_end - description.y_begin) / static_cast<double>(std::max<std::int64_t>(count_y, 1));
    const std::unique_ptr<gsl_rng, decltype(&gsl_rng_free)> random(gsl_rng_alloc(gsl_rng_mt19937),
                                                                   gsl_rng_free);
    gsl_rng_set(random.get(), description.seed);

    const auto patch = std::max<std::int64_t>(1, std::llround(description.patch / d));
    std::vector<double> top(static_cast<std::size_t>(count_x * count_y)), deviate(top.size());
    for (std::int64_t i = 0; i < count_x; ++i)
        for (std::int64_t j = 0; j < count_y; ++j) {
            const double x = x_begin + (static_cast<double>(i) + 0.5) * pitch_x;
            double& height = top[static_cast<std::size_t>(i * count_y + j)];
            height = mean_height(description.profile, x);
            // Columns of one patch share their deviate: that of its first column. Box-Muller, as in the
            // paper.
            double& own = deviate[static_cast<std::size_t>(i * count_y + j)];
            own = i % patch == 0 && j % patch == 0
                      ? gsl_ran_gaussian(random.get(), description.roughness)
                      : deviate[static_cast<std::size_t>((i - i % patch) * count_y + j - j % patch)];
            height += own;
        }

    std::vector<Vector> centres;
    for (std::int64_t i = 0; i < count_x; ++i)
        for (std::int64_t j = 0; j < count_y; ++j) {
            const double height = top[static_cast<std::size_t>(i * count_y + j)];
            double lowest = height - description.least_depth;
            for (std::int64_t k = std::max<std::int64_t>(i - 1, 0); k <= std::min(i + 1, count_x - 1); ++k)
                for (std::int64_t l = j - 1; l <= j + 1; ++l) {
                    const std::int64_t wrapped = (l + count_y) % count_y;
                    if (wrapped == l || description.is_periodic)
                        lowest = std::min(lowest, top[static_cast<std::size_t>(k * count_y + wrapped)]);
                }
            const double x = x_begin + (static_cast<double>(i) + 0.5) * pitch_x;
            const double y = description.y_begin + (static_cast<double>(j) + 0.5) * pitch_y;
            double z = height - 0.5 * d;
            do {
                centres.emplace_back(x, y, z);
                z -= d;
            } while (z + 0.5 * d > lowest + 1e-9 * d);
        }
    return centres;
}

}  // namespace dem
