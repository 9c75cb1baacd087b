#include "common/perturbation.hpp"

namespace common {

namespace {

/// SplitMix64 (Steele, Lea & Flood 2014): every bit of the result hangs on every bit of the state.
std::uint64_t mixed(std::uint64_t state) {
    state += 0x9e3779b97f4a7c15U;
    state = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9U;
    state = (state ^ (state >> 27)) * 0x94d049bb133111ebU;
    return state ^ (state >> 31);
}

}  // namespace

double perturbation(std::int64_t seed, std::uint64_t index) {
    if (seed == 0) return 0.0;
    const std::uint64_t bits = mixed(mixed(static_cast<std::uint64_t>(seed)) ^ index) >> 11;  // 53 of them
    return 2.0 * static_cast<double>(bits) / 9007199254740991.0 - 1.0;
}

}  // namespace common
