/// Work done on the water, J per m of width.
#pragma once

#include <cmath>
#include <vector>

namespace cmps {

struct Work {
    double net = 0;
    double gross = 0;  ///< of what was given and what was taken, both counted up

    void add(double part) { net += part, gross += std::abs(part); }
    Work operator+(const Work& other) const { return {net + other.net, gross + other.gross}; }
};

}  // namespace cmps
