#include "dem/shape.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace dem {

namespace {

/// Rotation onto principal axes; none where the axes already are principal.
Quaternion principal_axes(const Rotation& inertia) {
    const double off_diagonal = std::abs(inertia(0, 1)) + std::abs(inertia(0, 2)) + std::abs(inertia(1, 2));
    if (off_diagonal <= 1e-12 * inertia.trace()) return Quaternion::Identity();
    const Eigen::SelfAdjointEigenSolver<Rotation> solver(inertia);
    Rotation axes = solver.eigenvectors();
    if (axes.determinant() < 0) axes.col(2) = -axes.col(2);
    return Quaternion(Rotation(axes.transpose()));
}

}  // namespace

std::vector<int> exposed_spheres(const std::vector<Vector>& spheres, double diameter,
                                 double visitor_diameter) {
    constexpr int directions = 600;
    const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
    const double reach = 0.5 * (diameter + visitor_diameter), least_distance = 0.95 * reach;
    std::vector<int> exposed;
    for (std::size_t i = 0; i < spheres.size(); ++i) {
        bool reachable = false;
        for (int k = 0; k < directions && !reachable; ++k) {
            const double z = 1 - (2 * k + 1.0) / directions, r = std::sqrt(1 - z * z);
            const Vector visitor = spheres[i] + reach * Vector(r * std::cos(golden_angle * k),
                                                               r * std::sin(golden_angle * k), z);
            reachable = true;
            for (std::size_t j = 0; j < spheres.size() && reachable; ++j)
                if (j != i && (visitor - spheres[j]).squaredNorm() < least_distance * least_distance)
                    reachable = false;
        }
        if (reachable) exposed.push_back(static_cast<int>(i));
    }
    return exposed;
}

Shape make_shape(const ShapeDescription& description, const Element& element, double water_density) {
    const std::size_t count = description.spheres.size();
    if (count == 0) throw std::invalid_argument("a shape needs at least one sphere");
    Shape shape;
    shape.name = description.name;
    shape.diameter = description.diameter * element.diameter;
    const double elements = description.elements > 0 ? description.elements : static_cast<double>(count);
    shape.elements_per_sphere = elements / static_cast<double>(count);
    shape.displaced_volume = elements * element.volume();
    shape.volume_per_sphere = shape.elements_per_sphere * element.volume();
    shape.mass = description.mass.value_or(water_density * element.density_ratio * shape.displaced_volume);
    if (shape.mass <= 0) throw std::invalid_argument("the mass of a shape must be positive");

    Vector centre = Vector::Zero(), least = description.spheres[0], most = description.spheres[0];
    for (const auto& sphere : description.spheres) {
        centre += sphere / static_cast<double>(count);
        least = least.cwiseMin(sphere);
        most = most.cwiseMax(sphere);
    }
    for (const auto& sphere : description.spheres)
        shape.spheres.push_back((sphere - centre) * element.diameter);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < i; ++j)
            if ((shape.spheres[i] - shape.spheres[j]).norm() < 1e-6 * shape.diameter)
                throw std::invalid_argument(
                    fmt::format("spheres {} and {} are at the same place", j + 1, i + 1));
    shape.length = (most - least).x() * element.diameter + shape.diameter;
    shape.height = (most - least).z() * element.diameter + shape.diameter;

    const double sphere_mass = shape.mass / static_cast<double>(count);
    const double radius = shape.diameter / 2;
    Rotation inertia = Rotation::Zero();
    for (const auto& r : shape.spheres)
        inertia += sphere_mass *
                   ((r.squaredNorm() + 0.4 * radius * radius) * Rotation::Identity() - r * r.transpose());
    if (description.inertia) inertia = description.inertia->asDiagonal();
    shape.body_from_file = principal_axes(inertia);
    const Rotation turn = shape.body_from_file.toRotationMatrix();
    shape.inertia = (turn * inertia * turn.transpose()).diagonal();
    if (shape.inertia.minCoeff() <= 0) throw std::invalid_argument("the inertia of a shape must be positive");
    // Of every body each moment is at most the sum of the other two; equal to it for a flat one, but for
    // rounding.
    if (2 * shape.inertia.maxCoeff() > (1 + 1e-9) * shape.inertia.sum())
        throw std::invalid_argument(
            fmt::format("no body has the moments of inertia {}, {}, {} kg m2: the largest is at most the sum "
                        "of the others",
                        shape.inertia.x(), shape.inertia.y(), shape.inertia.z()));
    // Moments that differ by rounding only are equal: motion.cpp then has less to do.
    for (const auto& [k, l] : {std::pair{0, 1}, {0, 2}, {1, 2}})
        if (std::abs(shape.inertia[k] - shape.inertia[l]) < 1e-12 * shape.inertia[k])
            shape.inertia[l] = shape.inertia[k];
    shape.inverse_inertia = shape.inertia.cwiseInverse();
    shape.low = Vector::Constant(1e300);
    shape.high = -shape.low;
    shape.radius = 0;
    for (auto& sphere : shape.spheres) {
        sphere = turn * sphere;
        shape.low = shape.low.cwiseMin(sphere);
        shape.high = shape.high.cwiseMax(sphere);
        shape.radius = std::max(shape.radius, sphere.norm() + radius);
    }
    shape.exposed = exposed_spheres(shape.spheres, shape.diameter, shape.diameter);
    return shape;
}

}  // namespace dem
