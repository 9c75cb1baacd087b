/// Perturbations of a first state by rounding: members of an ensemble differ by them and by nothing else.
#pragma once

#include <cstdint>

namespace common {

/// A number in [-1, 1] for the value `index` of the member `seed`: the same on every machine, in any order
/// and for any number of threads. Zero everywhere for the seed 0, which perturbs nothing.
double perturbation(std::int64_t seed, std::uint64_t index);

}  // namespace common
