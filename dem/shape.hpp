/// The shape of a block: a rigid clump of equal spheres.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "dem/material.hpp"
#include "dem/vector.hpp"

namespace dem {

/// A shape as its file describes it.
struct ShapeDescription {
    std::string name;
    std::vector<Vector> spheres;  ///< centres in units of the element diameter d, any origin
    double diameter = 1;          ///< of the spheres, in units of d
    double elements = 0;          ///< elements of the paper the whole shape stands for; 0: as many as spheres
    std::optional<double> mass;   ///< dry, kg; default: that of the elements
    std::optional<Vector>
        inertia;  ///< dry, about the shape's axes through its centre of mass, kg m^2; default: summed
};

/// A shape ready for use. Its body frame has the principal axes of inertia and its origin in the centre of
/// mass.
struct Shape {
    std::string name;
    std::vector<Vector> spheres;  ///< centres in the body frame, m
    std::vector<int> exposed;     ///< spheres another block can touch
    double diameter;              ///< of the spheres, m
    double elements_per_sphere;   ///< elements of the paper each sphere stands for
    double mass;                  ///< dry, kg
    Vector inertia;               ///< dry, principal, kg m^2
    Vector inverse_inertia;       ///< reciprocals of the above
    double displaced_volume;      ///< water displaced by the whole shape, m^3
    double volume_per_sphere;     ///< the share of each sphere in it, m^3
    Quaternion body_from_file;    ///< turns the file's axes into the body frame
    Vector low, high;             ///< box around the sphere centres in the body frame, m
    double radius;                ///< farthest point of the shape from its centre of mass, m
    double height;                ///< extent in the file's third axis, m
    double length;                ///< extent in the file's first axis, m
};

/// Mass and inertia are those of eq. (8) without the added mass: each sphere weighs rho s A3 d^3 times the
/// elements it stands for, and turns with 2/5 m r^2 about its own centre. Throws std::invalid_argument (no
/// spheres; twice the same sphere; mass or inertia not positive; moments that no body has).
Shape make_shape(const ShapeDescription& description, const Element& element, double water_density);

/// Numbers of those of `spheres` that a sphere of `visitor_diameter` (m) can touch without cutting into
/// others by more than a twentieth. make_shape() takes a visitor of the shape's own diameter.
std::vector<int> exposed_spheres(const std::vector<Vector>& spheres, double diameter,
                                 double visitor_diameter);

}  // namespace dem
