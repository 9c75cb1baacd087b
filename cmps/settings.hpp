/// The numerical choices of a run: which scheme stands for each term, and its constants.
#pragma once

#include <cstddef>

#include "cmps/gradient.hpp"
#include "cmps/pressure_equation.hpp"

namespace cmps {

enum class KernelKind { rational, wendland };

/// How positions and velocities follow each other.
enum class TimeStepping {
    /// r* = r + dt u*, pressure at r*, r = r* + dt u': the paper's. First order; damps waves by (omega dt)^2
    /// / 2 a step.
    predicted,
    /// Half a drift, pressure there, kick, half a drift: second order, keeps the energy of waves; costs the
    /// same.
    midpoint
};

struct Settings {
    double spacing = 0;  ///< l0, m
    KernelKind kernel = KernelKind::wendland;
    double kernel_radius_ratio = 2.6;  ///< re / l0
    TimeStepping time_stepping = TimeStepping::midpoint;
    Gradient gradient = Gradient::corrected;
    PressureEquationSettings pressure;
    bool negative_pressure = false;  ///< false: p < 0 is cut (tension would open voids)
    double tolerance = 1e-3;         ///< of the pressure solve, relative to its right-hand side
    std::size_t most_iterations = 2000;
    std::size_t multigrid_from = 1500;  ///< unknowns from which multigrid is faster than incomplete Cholesky
    double shifting = 0.3;              ///< coefficient of particle shifting, 0: none
    double velocity_filter = 0;         ///< strength of the filter of particle-scale velocities, 0: none
    double stabilisation = 0.9;         ///< pairs nearer than this many l0 are pushed apart, 0: none
    double courant = 0.25;              ///< u dt / l0
    double time_step_factor = 1;        ///< on the largest step by speed, celerity and acceleration
    double gravity_x = 0, gravity_z = -9.81;  ///< m/s2
    double fall = 0;                          ///< how far water can fall at most, m: bounds its speed
    double depth = 0;  ///< largest depth of water, m: sets the wave speed in the time step
};

}  // namespace cmps
