/// Pressure on the solid's faces, and the force it makes on bodies.
///
/// Every wall particle has a pressure on the face half a spacing before it (NearField::face_pressure). Along
/// a face the pressure is the mean of those around, carried along by the hydrostatic gradient; dry ones read
/// zero. Integrated along every exposed face, corners included, it gives Archimedes' lift.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cmps/particles.hpp"
#include "cmps/settings.hpp"
#include "cmps/solid.hpp"

namespace cmps {

class FacePressure {
 public:
    /// Looks up, once, which wall particles stand behind which piece of face.
    FacePressure(const Particles& particles, const Solid& solid, const Settings& settings);

    /// Force on a body, N per m of width. `at_walls`: NearField::face_pressure.
    std::array<double, 2> force_on(const std::vector<double>& at_walls, std::int32_t body) const;
    /// Pieces of face and their weights, that add up to 1; empty where there is no face.
    struct Sensor {
        std::vector<std::size_t> pieces;
        std::vector<double> weights;
    };
    /// The faces within `diameter`/2 (at least a spacing) of (x, z).
    Sensor sensor_at(double x, double z, double diameter) const;
    /// Mean over the sensor, Pa.
    double read(const std::vector<double>& at_walls, const Sensor& sensor) const;

 private:
    /// A wall particle behind a piece of face, and the water's weight between their places on it, Pa.
    struct Support {
        std::size_t wall;
        double weight, carried;
    };
    struct Piece {
        Point at, normal;
        double length;
        std::int32_t body;
        std::vector<Support> supports;
    };
    static double pressure(const std::vector<double>& at_walls, const Piece& piece);
    double spacing_;
    std::vector<Piece> pieces_;
};

}  // namespace cmps
