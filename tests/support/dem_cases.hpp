/// Small worlds of a few blocks, built by hand, for tests of the block stage.
#pragma once

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "dem/build_simulation.hpp"
#include "dem/contacts.hpp"
#include "dem/scene.hpp"
#include "dem/step.hpp"

namespace dem_cases {

/// Everything a test may want to choose; the rest is the paper's.
struct World {
    dem::Material material;
    dem::Element element;
    dem::Water water;
    dem::ContactLaw law = dem::ContactLaw::hertz;
    dem::Vector gravity{0, 0, 0};
    double time_step = 1e-5;
    bool wet = false;
    double flow_interval = 2e-3;
    dem::UniformWater motion;
    dem::Blocks blocks;
    dem::Surroundings surroundings;

    /// Index of a built-in shape, made when first asked for.
    int shape(const std::string& name) {
        for (std::size_t k = 0; k < blocks.shapes.size(); ++k)
            if (blocks.shapes[k].name == name) return static_cast<int>(k);
        blocks.shapes.push_back(dem::make_shape(dem::find_shape(name, "."), element, water.density));
        return static_cast<int>(blocks.shapes.size()) - 1;
    }
    void add(const std::string& name, const dem::Vector& at,
             const dem::Vector& velocity = dem::Vector::Zero(), bool fixed = false,
             const dem::Quaternion& turned = dem::Quaternion::Identity(),
             const dem::Vector& spin = dem::Vector::Zero()) {
        blocks.add(shape(name), at, turned, fixed, velocity, spin);
    }
    std::unique_ptr<dem::Simulation> build() const {
        auto simulation = std::make_unique<dem::Simulation>(
            blocks, surroundings,
            dem::make_contact_model(law, material, element.diameter, 0.01 * element.diameter), gravity,
            dem::StepRules{.time_step = time_step, .flow_interval = flow_interval});
        if (wet) simulation->add_water({.water = water, .element = element, .gravity = gravity}, motion);
        return simulation;
    }
};

/// Slope of log(error) over log(step) between two steps: the observed order.
inline double order(double coarse_error, double fine_error, double ratio = 2) {
    return std::log(std::abs(coarse_error) / std::abs(fine_error)) / std::log(ratio);
}

}  // namespace dem_cases
