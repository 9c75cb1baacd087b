#include "dem/effects/fluid_force.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dem {

namespace {

/// Factors of eq. (10) for one sphere of a shape.
struct SphereFactors {
    double volume, drag, inertia, viscous;
};

SphereFactors factors_of(const Shape& shape, const FluidProperties& properties) {
    const Water& water = properties.water;
    return {.volume = shape.volume_per_sphere,
            .drag = 0.5 * water.density * properties.element.section() * shape.elements_per_sphere,
            .inertia = water.density * (1 + water.added_mass_coefficient) * shape.volume_per_sphere,
            .viscous = 24 * water.viscosity / properties.element.diameter};
}

/// The spheres of a block in the water. Sums over them run four spheres at a time.
struct Spheres {
    Column arm, relative, about, force;     // arm; u_r; arm x u_r; of the water's motion and buoyancy
    std::vector<double> slope, steepening;  // slope s and steepening c: dF/du_r = s + c u_r u_r^T
    std::vector<double> x, z;               // where they are, m
    WaterSamples water;

    void resize(std::size_t count) {
        for (auto* column : {&arm, &relative, &about, &force}) column->resize(count);
        for (auto* part : {&slope, &steepening, &x, &z}) part->resize(count);
        water.resize(count);
    }
    std::size_t size() const { return x.size(); }
};

/// Where the spheres are, with `turn` and `centre` of the block.
void find_places(const std::vector<Vector>& in_body, const Rotation& turn, const Vector& centre,
                 Spheres& spheres) {
    Column& arm = spheres.arm;
    const double xx = turn(0, 0), xy = turn(0, 1), xz = turn(0, 2), yx = turn(1, 0), yy = turn(1, 1),
                 yz = turn(1, 2), zx = turn(2, 0), zy = turn(2, 1), zz = turn(2, 2);
    const double centre_x = centre.x(), centre_z = centre.z();
    const std::size_t count = spheres.size();
    for (std::size_t k = 0; k < count; ++k) {
        const double x = in_body[k].x(), y = in_body[k].y(), z = in_body[k].z();
        arm.x[k] = xx * x + xy * y + xz * z;
        arm.y[k] = yx * x + yy * y + yz * z;
        arm.z[k] = zx * x + zy * y + zz * z;
        spheres.x[k] = centre_x + arm.x[k];
        spheres.z[k] = centre_z + arm.z[k];
    }
}

/// Velocity of the water relative to each sphere, and the forces of its acceleration and weight, eqs. (10)
/// and (11).
void meet_water(Spheres& spheres, double inertia, const Vector& buoyancy, FluidLoad& load) {
    Column &relative = spheres.relative, &force = spheres.force;
    const Column& arm = spheres.arm;
    const WaterSamples& water = spheres.water;
    const double vx = load.velocity.x(), vy = load.velocity.y(), vz = load.velocity.z();
    const double wx = load.spin.x(), wy = load.spin.y(), wz = load.spin.z();
    const double bx = buoyancy.x(), by = buoyancy.y(), bz = buoyancy.z();
    double wet = 0, speed = 0;
    const std::size_t count = spheres.size();
#pragma omp simd reduction(+ : wet, speed)
    for (std::size_t k = 0; k < count; ++k) {
        const double ux = water.velocity.x[k], uy = water.velocity.y[k], uz = water.velocity.z[k];
        relative.x[k] = ux - vx - (wy * arm.z[k] - wz * arm.y[k]);
        relative.y[k] = uy - vy - (wz * arm.x[k] - wx * arm.z[k]);
        relative.z[k] = uz - vz - (wx * arm.y[k] - wy * arm.x[k]);
        force.x[k] = water.wet[k] * (inertia * water.acceleration.x[k] + bx);
        force.y[k] = water.wet[k] * (inertia * water.acceleration.y[k] + by);
        force.z[k] = water.wet[k] * (inertia * water.acceleration.z[k] + bz);
        wet += water.wet[k];
        speed += water.wet[k] * std::sqrt(ux * ux + uy * uy + uz * uz);
    }
    load.wet = wet;
    load.water_speed = speed;
}

/// Sum of weight * a * a^T.
Rotation weighted_squares(const std::vector<double>& weight, const Column& a) {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    const std::size_t count = weight.size();
#pragma omp simd reduction(+ : xx, xy, xz, yy, yz, zz)
    for (std::size_t k = 0; k < count; ++k) {
        const double x = weight[k] * a.x[k], y = weight[k] * a.y[k], z = weight[k] * a.z[k];
        xx += x * a.x[k];
        xy += x * a.y[k];
        xz += x * a.z[k];
        yy += y * a.y[k];
        yz += y * a.z[k];
        zz += z * a.z[k];
    }
    Rotation sum;
    sum << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    return sum;
}

/// Sum of weight * a * b^T.
Rotation weighted_products(const std::vector<double>& weight, const Column& a, const Column& b) {
    double xx = 0, xy = 0, xz = 0, yx = 0, yy = 0, yz = 0, zx = 0, zy = 0, zz = 0;
    const std::size_t count = weight.size();
#pragma omp simd reduction(+ : xx, xy, xz, yx, yy, yz, zx, zy, zz)
    for (std::size_t k = 0; k < count; ++k) {
        const double x = weight[k] * a.x[k], y = weight[k] * a.y[k], z = weight[k] * a.z[k];
        xx += x * b.x[k];
        xy += x * b.y[k];
        xz += x * b.z[k];
        yx += y * b.x[k];
        yy += y * b.y[k];
        yz += y * b.z[k];
        zx += z * b.x[k];
        zy += z * b.y[k];
        zz += z * b.z[k];
    }
    Rotation sum;
    sum << xx, xy, xz, yx, yy, yz, zx, zy, zz;
    return sum;
}

/// Drag of each sphere, eqs. (10) and (12), its slopes, and the sums of force and torque.
void add_drag(Spheres& spheres, double drag, double drag_coefficient, double viscous, FluidLoad& load) {
    double fx = 0, fy = 0, fz = 0, tx = 0, ty = 0, tz = 0;
    Column& about = spheres.about;
    const Column &arm = spheres.arm, &relative = spheres.relative, &force = spheres.force;
    std::vector<double>&slope = spheres.slope, &steepening = spheres.steepening;
    const std::vector<double>& wet = spheres.water.wet;
    const std::size_t count = spheres.size();
#pragma omp simd reduction(+ : fx, fy, fz, tx, ty, tz)
    for (std::size_t k = 0; k < count; ++k) {
        const double rx = relative.x[k], ry = relative.y[k], rz = relative.z[k];
        const double ax = arm.x[k], ay = arm.y[k], az = arm.z[k];
        const double speed = std::sqrt(rx * rx + ry * ry + rz * rz);
        // C_D |u_r| of eq. (12), finite at zero relative speed.
        slope[k] = drag * wet[k] * (drag_coefficient * speed + viscous);
        steepening[k] = drag * wet[k] * drag_coefficient / std::max(speed, 1e-100);
        about.x[k] = ay * rz - az * ry;
        about.y[k] = az * rx - ax * rz;
        about.z[k] = ax * ry - ay * rx;
        const double x = slope[k] * rx + force.x[k], y = slope[k] * ry + force.y[k],
                     z = slope[k] * rz + force.z[k];
        fx += x;
        fy += y;
        fz += z;
        tx += ay * z - az * y;
        ty += az * x - ax * z;
        tz += ax * y - ay * x;
    }
    load.force = Vector(fx, fy, fz);
    load.torque = Vector(tx, ty, tz);
}

/// The Jacobian: with J the map from the block's velocity and spin to a sphere's, the sum of J^T (s + c u_r
/// u_r^T) J.
void add_slopes(const Spheres& spheres, FluidLoad& load) {
    double isotropic = 0, x = 0, y = 0, z = 0;
    const auto& slope = spheres.slope;
    const Column& arm = spheres.arm;
    const std::size_t count = spheres.size();
#pragma omp simd reduction(+ : isotropic, x, y, z)
    for (std::size_t k = 0; k < count; ++k) {
        isotropic += slope[k];
        x += slope[k] * arm.x[k];
        y += slope[k] * arm.y[k];
        z += slope[k] * arm.z[k];
    }
    load.drag_slope = weighted_squares(spheres.steepening, spheres.relative);
    load.drag_slope.diagonal().array() += isotropic;
    load.coupling << 0, -z, y, z, 0, -x, -y, x, 0;
    load.coupling += weighted_products(spheres.steepening, spheres.about, spheres.relative);
    const Rotation moments = weighted_squares(slope, arm);
    load.spin_slope = weighted_squares(spheres.steepening, spheres.about) - moments;
    load.spin_slope.diagonal().array() += moments.trace();
}

}  // namespace

template <class Motion>
FluidLoad sample_fluid_load(const Blocks& blocks, std::size_t block, const Motion& motion,
                            const FluidProperties& properties, double ahead) {
    const Shape& shape = blocks.shape_of(block);
    const Vector& velocity = blocks.velocity[block];
    const Vector& spin = blocks.angular_velocity[block];
    const Vector centre = blocks.position[block] + ahead * velocity, half = 0.5 * ahead * spin;
    const Rotation turn =
        Quaternion(1, half.x(), half.y(), half.z()).normalized().toRotationMatrix() * blocks.rotation[block];
    const Water& water = properties.water;
    const auto [volume, drag, inertia, viscous] = factors_of(shape, properties);
    const Vector buoyancy = -water.density * volume * properties.gravity;

    FluidLoad load{.velocity = velocity, .spin = spin};
    thread_local Spheres spheres;
    const std::size_t count = shape.spheres.size();
    spheres.resize(count);
    find_places(shape.spheres, turn, centre, spheres);
    motion.sample(spheres.x, spheres.z, spheres.water);
    meet_water(spheres, inertia, buoyancy, load);
    if (load.wet <= 0) return load;
    add_drag(spheres, drag, water.drag_coefficient, viscous, load);
    add_slopes(spheres, load);
    load.water_speed /= load.wet;
    load.wet /= static_cast<double>(count);
    return load;
}

template FluidLoad sample_fluid_load(const Blocks&, std::size_t, const UniformWater&, const FluidProperties&,
                                     double);
template FluidLoad sample_fluid_load(const Blocks&, std::size_t, const FlowGrid&, const FluidProperties&,
                                     double);

FluidLoadInMotion::FluidLoadInMotion(const FluidLoad& load) : force_(load.force), torque_(load.torque) {
    for (int row = 0, k = 0; row < 3; ++row)
        for (int column = row; column < 3; ++column, ++k) {
            drag_[k] = static_cast<float>(load.drag_slope(row, column));
            spin_[k] = static_cast<float>(load.spin_slope(row, column));
        }
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            coupling_[3 * row + column] = static_cast<float>(load.coupling(row, column));
    const Wrench moving = at(load.velocity, load.spin);
    force_ += load.force - moving.force;
    torque_ += load.torque - moving.torque;
}

double largest_load_change(const Shape& shape, const FlowGrid::Change& change,
                           const FluidProperties& properties) {
    const SphereFactors factors = factors_of(shape, properties);
    // ||u|u - |v|v| <= (|u| + |v|) |u - v|; a wet fraction of 1 is the most there can be.
    const double slope =
        factors.drag * (properties.water.drag_coefficient * 2 * change.speed + factors.viscous);
    return static_cast<double>(shape.spheres.size()) *
           (slope * change.velocity + factors.inertia * change.acceleration);
}

double mass_ratio(const Shape& shape, double wet, const FluidProperties& properties) {
    return 1 + properties.water.density * properties.water.added_mass_coefficient * shape.displaced_volume *
                   wet / shape.mass;
}

}  // namespace dem
