#include "common/sampling_error.hpp"

#include <cmath>
#include <complex>
#include <numbers>

namespace common {

double sampling_error(Interpolation interpolation, double samples) {
    using Complex = std::complex<double>;
    const double angle = 2.0 * std::numbers::pi / samples;  // from sample to sample
    const Complex turn = std::polar(1.0, angle), back = std::conj(turn);
    // of the backward cubic, times the interval, at the sample where the phase is zero
    const Complex slope = 11.0 / 6.0 - back * (3.0 - back * (1.5 - back / 3.0));
    // Gauss' five points: exact for the ninth order, the square of the leading error being of the eighth
    constexpr double places[] = {0.0469100770306680, 0.2307653449471585, 0.5, 0.7692346550528415,
                                 0.9530899229693320};
    constexpr double weights[] = {0.1184634425280945, 0.2393143352496832, 0.2844444444444444,
                                  0.2393143352496832, 0.1184634425280945};
    double square = 0;
    for (int i = 0; i < 5; ++i) {
        const double s = places[i], r = 1.0 - s;
        const Complex value = interpolation == Interpolation::linear
                                  ? r + s * turn
                                  : (1.0 + 2.0 * s) * r * r + s * s * (3.0 - 2.0 * s) * turn +
                                        slope * (s * r * r - s * s * r * turn);
        square += weights[i] * std::norm(value - std::polar(1.0, angle * s));
    }
    return std::sqrt(square);
}

}  // namespace common
