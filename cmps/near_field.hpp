/// The near field: particles, and one time step of the corrected moving-particle semi-implicit method.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cmps/contacts.hpp"
#include "cmps/free_surface.hpp"
#include "cmps/gradient.hpp"
#include "cmps/interactions.hpp"
#include "cmps/neighbours.hpp"
#include "cmps/particles.hpp"
#include "cmps/path_average.hpp"
#include "cmps/pressure_equation.hpp"
#include "cmps/pressure_solver.hpp"
#include "cmps/settings.hpp"
#include "cmps/velocity_filter.hpp"

namespace cmps {

class NearField;

/// An optional effect: composed at start; one that is off does not exist.
class Effect {
 public:
    virtual ~Effect() = default;
    virtual std::string name() const = 0;
    /// Before the particles move: sets velocities of walls (m/s), or gravity.
    virtual void begin_step(NearField&, double /*time*/, double /*step*/) {}
    /// Adds to the velocities what acts beside gravity and pressure; interactions are current.
    virtual void accelerate(NearField&, double /*time*/, double /*step*/) {}
    /// After positions and velocities are those of `time`.
    virtual void end_step(NearField&, double /*time*/, double /*step*/) {}
    /// Longest step that it bears, s.
    virtual double longest_step(const NearField&) const { return std::numeric_limits<double>::infinity(); }
    /// What it must remember to go on bit for bit.
    virtual std::vector<double> state() const { return {}; }
    virtual void restore(const std::vector<double>&) {}
    double seconds = 0;  ///< wall time it took
};

/// Wall time of a run by part of the step, s.
struct PhaseSeconds {
    double neighbours = 0, geometry = 0, assembly = 0, solve = 0, gradient = 0, motion = 0;
};

/// What the steps so far have met.
struct StepCounts {
    std::size_t steps = 0, iterations = 0, list_builds = 0, unconverged = 0;
    std::size_t closed = 0;  ///< steps without a free surface
};

class NearField {
 public:
    NearField(const Settings& settings, Particles initial);

    /// Spreads the particles evenly by shifting alone (before the first step), then sets hydrostatic
    /// pressure.
    void settle(int sweeps, double surface_level);
    /// Largest step now, s: courant l0/u, 0.4 l0/sqrt(g h), 0.25 sqrt(l0/a), what effects bear.
    double largest_step() const;
    /// 0.4 l0/sqrt(g h), s; of water that weighs nothing 0.4 l0 over its first speed, and where it rested
    /// that of water on Earth, for a wall may come.
    double step_of_celerity(double gravity) const;
    /// One step from `time` to `time + step`. Throws RunError when it goes wrong.
    void advance(double time, double step);

    Settings settings;
    LatticeConstants lattice;
    Particles particles;
    std::vector<std::unique_ptr<Effect>> effects;

    NeighbourSearch search;
    Interactions interactions;  ///< at the positions of the last pressure solve
    std::vector<Place> place;   ///< per carrier row
    PressureEquation equation;
    std::vector<double>
        face_pressure;  ///< Pa, on the face before each wall particle: the water's, and contact
    std::optional<PathAverage> path_average;  ///< where a flow grid is recorded
    PhaseSeconds seconds;
    StepCounts counts;

 private:
    void drift(double step);
    void update_geometry();
    void solve_pressure(double step);
    void note_pressure_change(const std::vector<double>& solved);
    void apply_gradient(double step);
    void find_face_pressure();
    void push_apart(double step);
    void filter_velocity(double step);
    double share_of_step(double step) const;
    void shift(double share, bool carries_velocity);
    void check(double time, double step) const;

    std::variant<RationalKernel, WendlandKernel> kernel_;
    PressureSolver solver_;
    GradientTerm gradient_;
    VelocityFilter filter_;
    Contacts contacts_;
    std::vector<double> gradient_x_, gradient_z_, unknown_pressure_, unknown_x_, unknown_z_, old_u_, old_w_;
    std::vector<std::vector<double>*> companions_;  // arrays that go along when particles are put in order
    double largest_speed_ = 0, largest_acceleration_ = 0, last_step_ = 0;
    double first_speed_ = 0;                                              // of the water at the start, m/s
    double pressure_change_ = 0, pressure_sum_ = 0, stagnation_sum_ = 0;  ///< over particles and steps, Pa

 public:
    double largest_speed() const { return largest_speed_; }
    double last_step() const { return last_step_; }  ///< s
    /// Mean change of the pressure from one step to the next, over the mean pressure; in water that flies
    /// freely, where there is next to none, over a fifth of the stagnation pressure.
    double pressure_change_per_step() const {
        const double scale = std::max(pressure_sum_, 0.2 * stagnation_sum_);
        return scale > 0 ? pressure_change_ / scale : 0.0;
    }
    /// Largest speed, acceleration and gravity decide the next step; part of the state.
    std::vector<double> step_state() const {
        return {largest_speed_,   largest_acceleration_, settings.gravity_x, settings.gravity_z,
                pressure_change_, pressure_sum_,         stagnation_sum_,    last_step_};
    }
    void restore_step_state(const std::vector<double>& state) {
        largest_speed_ = state.at(0), largest_acceleration_ = state.at(1);
        settings.gravity_x = state.at(2), settings.gravity_z = state.at(3);
        pressure_change_ = state.at(4), pressure_sum_ = state.at(5), stagnation_sum_ = state.at(6);
        last_step_ = state.at(7);
    }
};

}  // namespace cmps
