#include "cmps/face_pressure.hpp"

#include <algorithm>
#include <cmath>

namespace cmps {

FacePressure::FacePressure(const Particles& particles, const Solid& solid, const Settings& settings)
    : spacing_(settings.spacing) {
    const double l0 = spacing_, density = settings.pressure.density;
    const std::size_t first = particles.first_wall();
    const auto support = [&](const Piece& piece, std::size_t j, double weight) {
        const double ex = piece.at[0] - particles.x[j] - 0.5 * l0 * particles.normal_x[j],
                     ez = piece.at[1] - particles.z[j] - 0.5 * l0 * particles.normal_z[j];
        return Support{.wall = j - first,
                       .weight = weight,
                       .carried = density * (settings.gravity_x * ex + settings.gravity_z * ez)};
    };
    // behind the end of a face at a sharp edge there may be none: the nearest one then stands for it
    const auto add_nearest = [&](Piece& piece) {
        double least = 3.0 * l0;  // farther off there are no walls: water cannot get there
        std::size_t nearest = particles.size();
        for (std::size_t j = first; j < particles.first_fluid(); ++j) {
            const double distance = std::hypot(piece.at[0] - particles.x[j], piece.at[1] - particles.z[j]);
            if (particles.body[j] != body_moving_wall && distance < least) least = distance, nearest = j;
        }
        if (nearest < particles.size()) piece.supports.push_back(support(piece, nearest, 1.0));
    };
    for (const SurfaceSegment& segment : solid.surface()) {
        const double dx = segment.to[0] - segment.from[0], dz = segment.to[1] - segment.from[1];
        const double length = std::hypot(dx, dz), tx = dx / length, tz = dz / length;
        const Point& normal = segment.normal;
        std::vector<std::size_t> behind;
        for (std::size_t j = first; j < particles.first_fluid(); ++j) {
            const double ex = particles.x[j] - segment.from[0], ez = particles.z[j] - segment.from[1];
            const double across = ex * normal[0] + ez * normal[1], along = ex * tx + ez * tz;
            if (particles.body[j] != body_moving_wall && across < 0 && across > -0.9 * l0 && along > -l0 &&
                along < length + l0)
                behind.push_back(j);
        }
        const int count = std::max(1, static_cast<int>(std::lround(length / (0.5 * l0))));
        for (int i = 0; i < count; ++i) {
            const double s = (i + 0.5) / count * length;
            Piece piece{.at = {segment.from[0] + s * tx, segment.from[1] + s * tz},
                        .normal = normal,
                        .length = length / count,
                        .body = segment.body,
                        .supports = {}};
            for (const std::size_t j : behind) {
                const double ex = piece.at[0] - particles.x[j] - 0.5 * l0 * particles.normal_x[j],
                             ez = piece.at[1] - particles.z[j] - 0.5 * l0 * particles.normal_z[j];
                const double weight = 1.0 - std::abs(ex * tx + ez * tz) / (1.2 * l0);
                if (weight > 0) piece.supports.push_back(support(piece, j, weight));
            }
            if (piece.supports.empty()) add_nearest(piece);
            if (!piece.supports.empty()) pieces_.push_back(std::move(piece));
        }
    }
}

double FacePressure::pressure(const std::vector<double>& at_walls, const Piece& piece) {
    double sum = 0, weights = 0;
    for (const Support& support : piece.supports) {
        const double p = at_walls[support.wall];
        weights += support.weight;
        if (p > 0) sum += support.weight * std::max(0.0, p + support.carried);
    }
    return sum / weights;
}

std::array<double, 2> FacePressure::force_on(const std::vector<double>& at_walls, std::int32_t body) const {
    std::array<double, 2> force = {0, 0};
    for (const Piece& piece : pieces_) {
        if (piece.body != body) continue;
        const double p = pressure(at_walls, piece) * piece.length;
        force[0] -= p * piece.normal[0], force[1] -= p * piece.normal[1];
    }
    return force;
}

FacePressure::Sensor FacePressure::sensor_at(double x, double z, double diameter) const {
    const double reach = std::max(0.5 * diameter, spacing_);
    Sensor sensor;
    double sum = 0;
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
        const Piece& piece = pieces_[k];
        const double ex = piece.at[0] - x, ez = piece.at[1] - z;
        // on the gauge's own face: not one that stands across or behind
        if (std::abs(ex * piece.normal[0] + ez * piece.normal[1]) > 0.1 * spacing_) continue;
        const double weight = 1.0 - std::hypot(ex, ez) / reach;
        if (weight > 0) sensor.pieces.push_back(k), sensor.weights.push_back(weight), sum += weight;
    }
    for (double& weight : sensor.weights) weight /= sum;
    return sensor;
}

double FacePressure::read(const std::vector<double>& at_walls, const Sensor& sensor) const {
    double sum = 0;
    for (std::size_t k = 0; k < sensor.pieces.size(); ++k)
        sum += sensor.weights[k] * pressure(at_walls, pieces_[sensor.pieces[k]]);
    return sum;
}

}  // namespace cmps
