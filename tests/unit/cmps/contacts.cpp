/// What stops water at a wall is what the wall reports: impulse on the face against momentum lost.
#include "cmps/contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "../../support/cmps_tank.hpp"

namespace {

/// A sheet `rows` particles thick and 0.4 m wide strikes a wall square at 3 m/s. Impulse on the wall over
/// momentum lost across it, and the largest mean over l0/u of the pressure, over rho u^2.
struct Blow {
    double impulse = 0, lost = 0, largest = 0;

    Blow(int rows, double courant) {
        constexpr double spacing = 0.01, speed = 3.0, length = 0.6;
        cmps::Settings settings = cmps_tank::settings(spacing, 0.3);
        settings.courant = courant;
        cmps::Particles particles = cmps_tank::particles(
            length, spacing, [](double) { return 0.1; }, 1.2);
        while (particles.fluid > 0) particles.remove_fluid(particles.size() - 1);
        for (int row = 0; row < rows; ++row)
            for (int k = 0; k < 40; ++k) {
                particles.add_fluid(length - (2.5 + row) * spacing, 0.4 + (k + 0.37) * spacing, row * 40 + k);
                particles.u.back() = speed;
            }
        const double mass = settings.pressure.density * spacing * spacing;
        const double before = mass * speed * 40.0 * rows;
        cmps::NearField field(settings, particles);
        std::vector<double> forces, steps;
        double time = 0;
        cmps_tank::run(field, 0.02 + rows * spacing / speed, [&](double now) {
            const cmps::Particles& p = field.particles;
            double force = 0;
            for (std::size_t j = p.first_wall(); j < p.first_fluid(); ++j)
                if (p.x[j] > length && p.z[j] > 0) force += spacing * field.face_pressure[j - p.first_wall()];
            forces.push_back(force), steps.push_back(now - time);
            impulse += force * (now - time), time = now;
            double given = 0, left_over = spacing / speed;  // of the last l0/u, whatever the steps' length
            for (std::size_t s = steps.size(); s-- > 0 && left_over > 0; left_over -= steps[s])
                given += forces[s] * std::min(steps[s], left_over);
            largest = std::max(largest, given / (spacing * 0.4 * settings.pressure.density * speed));
        });
        double left = 0;
        for (std::size_t i = field.particles.first_fluid(); i < field.particles.size(); ++i)
            left += mass * field.particles.u[i];
        lost = before - left;
    }
};

TEST(Contacts, WallReportsWhatStopsTheWaterWhateverTheStep) {
    for (const int rows : {1, 2, 4}) {
        const Blow blow(rows, 0.25), half(rows, 0.125), fifth(rows, 0.05);
        // where one particle is all the water there is, its pressure at the face is known to a tenth
        const double known = rows == 1 ? 0.1 : 0.05;
        EXPECT_NEAR(blow.impulse / blow.lost, 1.0, known) << rows << " rows";
        EXPECT_NEAR(half.impulse / half.lost, 1.0, known) << rows << " rows, half the step";
        EXPECT_NEAR(fifth.impulse / fifth.lost, 1.0, known) << rows << " rows, a fifth of the step";
        EXPECT_NEAR(blow.largest / half.largest, 1.0, known) << rows << " rows";
    }
}

}  // namespace
