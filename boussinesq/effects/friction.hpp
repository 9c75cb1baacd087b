/// Bed friction, (h u)_t = - c |u| u, with a constant coefficient or Manning's c = g n^2 / h^(1/3).
/// Taken implicitly (linearised in |u|): q / (1 + dt c |u| / h). First order in time, stable for any step.
#pragma once

#include "boussinesq/effects/step_effect.hpp"

namespace boussinesq {

class Friction : public StepEffect {
 public:
    /// `coefficient` c without unit, or with `is_manning` n in s/m^(1/3).
    Friction(const Grid& grid, double coefficient, bool is_manning, double dry_depth)
        : cells_(grid.cells), coefficient_(coefficient), is_manning_(is_manning), dry_depth_(dry_depth) {}
    std::string name() const override { return "friction"; }
    void apply(WaveState& state, double t, double step) override;

 private:
    std::size_t cells_;
    double coefficient_;
    bool is_manning_;
    double dry_depth_;
};

}  // namespace boussinesq
