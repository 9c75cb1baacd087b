#include "boussinesq/wave_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace boussinesq {
namespace {

/// Trapezoidal weights over the record's length; their sum is 1.
std::vector<double> weights_of(std::span<const double> time) {
    std::vector<double> weights(time.size(), 0.0);
    const double length = time.back() - time.front();
    for (std::size_t i = 0; i + 1 < time.size(); ++i) {
        const double half = 0.5 * (time[i + 1] - time[i]) / length;
        weights[i] += half;
        weights[i + 1] += half;
    }
    return weights;
}

}  // namespace

WaveStatistics wave_statistics(std::span<const double> time, std::span<const double> elevation) {
    WaveStatistics result;
    if (time.size() < 3) return result;
    const auto weights = weights_of(time);
    for (std::size_t i = 0; i < time.size(); ++i) result.mean_level += weights[i] * elevation[i];
    for (std::size_t i = 0; i < time.size(); ++i)
        result.root_mean_square += weights[i] * std::pow(elevation[i] - result.mean_level, 2);
    result.root_mean_square = std::sqrt(result.root_mean_square);
    const auto [low, high] = std::minmax_element(elevation.begin(), elevation.end());
    result.lowest = *low;
    result.highest = *high;

    struct Wave {
        double height, period;
    };
    std::vector<Wave> waves;
    double begun = -1.0, crest = 0.0, trough = 0.0;
    for (std::size_t i = 1; i < time.size(); ++i) {
        const double before = elevation[i - 1] - result.mean_level, now = elevation[i] - result.mean_level;
        if (before < 0.0 && now >= 0.0) {
            const double crossing = time[i - 1] + (time[i] - time[i - 1]) * before / (before - now);
            // Ripples below a fiftieth of the record's spread are no waves of their own.
            if (begun >= time.front() && crest - trough > 0.05 * result.root_mean_square)
                waves.push_back({crest - trough, crossing - begun});
            begun = crossing;
            crest = trough = 0.0;
        }
        // A parabola through three samples reaches the crest between them.
        double peak = now;
        if (i + 1 < time.size()) {
            const double after = elevation[i + 1] - result.mean_level, bend = before - 2.0 * now + after;
            if ((now - before) * (after - now) < 0.0 && bend != 0.0)
                peak = now - 0.125 * (after - before) * (after - before) / bend;
        }
        crest = std::max(crest, peak);
        trough = std::min(trough, peak);
    }
    result.waves = waves.size();
    if (waves.empty()) return result;
    std::stable_sort(waves.begin(), waves.end(),
                     [](const Wave& a, const Wave& b) { return a.height > b.height; });
    const std::size_t third = std::max<std::size_t>(1, (waves.size() + 1) / 3);
    for (std::size_t i = 0; i < waves.size(); ++i) {
        result.mean_height += waves[i].height / static_cast<double>(waves.size());
        result.mean_period += waves[i].period / static_cast<double>(waves.size());
        if (i < third) {
            result.significant_height += waves[i].height / static_cast<double>(third);
            result.significant_period += waves[i].period / static_cast<double>(third);
        }
    }
    result.largest_height = waves.front().height;
    result.largest_period = waves.front().period;
    return result;
}

WetLevel level_while_wet(std::span<const double> time, std::span<const double> elevation, double lowest) {
    const auto weights = weights_of(time);
    WetLevel wet;
    for (std::size_t i = 0; i < time.size(); ++i) {
        if (elevation[i] <= lowest) continue;
        wet.share += weights[i];
        wet.mean += weights[i] * elevation[i];
    }
    if (wet.share > 0) wet.mean /= wet.share;
    return wet;
}

Reflection reflection_of(std::span<const double> time,
                         const std::array<std::span<const double>, 3>& elevation,
                         const std::array<double, 3>& place, double depth, const LinearDispersion& dispersion,
                         std::span<const double> frequencies) {
    using Complex = std::complex<double>;
    const auto weights = weights_of(time);
    double incident = 0, reflected = 0;
    for (const double w : frequencies) {
        const double k = dispersion.wave_number(w, depth);
        if (!std::isfinite(k)) continue;
        // eta_p = I e^{i(w t - k x_p)} + R e^{i(w t + k x_p)}: normal equations of the least squares
        Complex b_incident = 0, b_reflected = 0, cross = 0;
        for (std::size_t p = 0; p < 3; ++p) {
            Complex line = 0;
            for (std::size_t i = 0; i < time.size(); ++i)
                line += 2.0 * weights[i] * elevation[p][i] * std::polar(1.0, -w * (time[i] - time.front()));
            const double shift = k * (place[p] - place[0]);
            b_incident += line * std::polar(1.0, shift);
            b_reflected += line * std::polar(1.0, -shift);
            cross += std::polar(1.0, 2.0 * shift);
        }
        const double determinant = 9.0 - std::norm(cross);
        if (determinant < 0.1) continue;  // gauges half a length apart cannot tell the two
        const Complex amplitude_in = (3.0 * b_incident - cross * b_reflected) / determinant;
        const Complex amplitude_back = (3.0 * b_reflected - std::conj(cross) * b_incident) / determinant;
        incident += 0.5 * std::norm(amplitude_in);
        reflected += 0.5 * std::norm(amplitude_back);
    }
    Reflection result;
    result.incident_height = 2.0 * std::sqrt(2.0 * incident);
    result.reflected_height = 2.0 * std::sqrt(2.0 * reflected);
    result.coefficient = incident > 0 ? std::sqrt(reflected / incident) : 0.0;
    return result;
}

}  // namespace boussinesq
