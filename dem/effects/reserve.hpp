/// What a resting block has left before it would begin to slide or to tip.
#pragma once

#include <span>

#include "dem/vector.hpp"

namespace dem {

/// One contact as the block feels it.
struct CarriedContact {
    Vector place;         ///< from the block's centre, m
    Vector normal;        ///< out of the block, unit
    double normal_force;  ///< of the spring, N
    Vector spring;        ///< tangential, on the block, N
};

/// Change of load (of the force, plus of the torque over `radius`) that the contacts which carry the block
/// can take at least, N: the lesser of
/// - sliding: sum of mu F_n - |F_t|, less than what is missing to the Coulomb limit in any direction, but not
///   less than a hundredth of the sum of mu F_n: many a block comes to rest with its contacts at the limit;
/// - tipping: the carried force times the distance of its centre from the nearest edge of the polygon of
///   supports, over the arm 2 `radius` that a load can have about that edge.
/// Contacts that carry are those whose normal has a part against gravity (`up`, unit): sides that merely lean
/// on the block may go. Nothing is left (0) to a block
/// without friction, that stands on a point or a line, or hangs.
double reserve_of(std::span<const CarriedContact> contacts, double friction, const Vector& up, double radius);

}  // namespace dem
