#include "boussinesq/waves/permanent_wave.hpp"

#include <fmt/format.h>
#include <gsl/gsl_linalg.h>
#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "boussinesq/grid.hpp"
#include "boussinesq/waves/wave_theory.hpp"
#include "common/errors.hpp"

namespace boussinesq {
namespace {

constexpr double pi = std::numbers::pi;
constexpr std::size_t table_size = 2048;

CnoidalWave cnoidal_of_modulus(double height, double depth, double m) {
    const double k = gsl_sf_ellint_Kcomp(std::sqrt(m), GSL_PREC_DOUBLE);
    const double e = gsl_sf_ellint_Ecomp(std::sqrt(m), GSL_PREC_DOUBLE);
    CnoidalWave wave{};
    wave.modulus = m;
    wave.h1 = depth - height / m * e / k;
    wave.h3 = wave.h1 + height / m;
    wave.h2 = wave.h3 - height;
    const double rate = 0.5 * std::sqrt(3.0 * (wave.h3 - wave.h1) / (wave.h1 * wave.h2 * wave.h3));
    wave.wave_number = pi * rate / k;
    return wave;
}

/// Newton on the cosine amplitudes, the flux and the constant C for one height; depth and gravity are 1.
/// Returns false when it does not converge.
bool solve_form(double alpha, double height, double period, std::vector<double>& unknown) {
    const std::size_t modes = unknown.size() - 2;
    const double share = 1.0 - 1.0 / alpha;
    std::vector<double> residual(modes + 2), matrix((modes + 2) * (modes + 2)), change(modes + 2);
    const auto slope = [&](std::size_t row, std::size_t column) -> double& {
        return matrix[row * (modes + 2) + column];
    };
    for (int iteration = 0; iteration < 40; ++iteration) {
        const double m = unknown[modes], constant = unknown[modes + 1];
        const double k = 2.0 * pi / (m * period);
        std::fill(matrix.begin(), matrix.end(), 0.0);
        for (std::size_t j = 0; j <= modes; ++j) {
            const double phase = pi * static_cast<double>(j) / static_cast<double>(modes);
            double h = 1.0, dh = 0.0, ddh = 0.0;
            for (std::size_t n = 1; n <= modes; ++n) {
                const double order = static_cast<double>(n), a = unknown[n - 1];
                h += a * std::cos(order * phase);
                dh -= a * k * order * std::sin(order * phase);
                ddh -= a * k * k * order * order * std::cos(order * phase);
            }
            if (!(h > 0.0)) return false;
            const double carry = m * m - share * h * h * h;
            const double bend = (2.0 / 3.0 - alpha) * m * m / h;
            residual[j] = m * m / h + 0.5 * h * h + alpha / 3.0 * ddh * carry + bend * dh * dh - constant;
            const double by_h = -m * m / (h * h) + h - alpha * ddh * share * h * h - bend / h * dh * dh;
            const double by_dh = 2.0 * bend * dh;
            const double by_ddh = alpha / 3.0 * carry;
            for (std::size_t n = 1; n <= modes; ++n) {
                const double order = static_cast<double>(n);
                const double c = std::cos(order * phase), s = std::sin(order * phase);
                slope(j, n - 1) = by_h * c - by_dh * k * order * s - by_ddh * k * k * order * order * c;
            }
            const double by_m = 2.0 * m / h + alpha / 3.0 * ddh * 2.0 * m + 2.0 * bend / m * dh * dh;
            slope(j, modes) = by_m - by_dh * dh / m - by_ddh * 2.0 * ddh / m;
            slope(j, modes + 1) = -1.0;
        }
        residual[modes + 1] = -height;
        for (std::size_t n = 1; n <= modes; n += 2) {
            residual[modes + 1] += 2.0 * unknown[n - 1];
            slope(modes + 1, n - 1) = 2.0;
        }
        gsl_matrix_view left = gsl_matrix_view_array(matrix.data(), modes + 2, modes + 2);
        gsl_vector_view right = gsl_vector_view_array(residual.data(), modes + 2);
        gsl_vector_view solution = gsl_vector_view_array(change.data(), modes + 2);
        std::vector<std::size_t> order(modes + 2);
        gsl_permutation permutation{modes + 2, order.data()};
        int sign = 0;
        gsl_linalg_LU_decomp(&left.matrix, &permutation, &sign);
        gsl_linalg_LU_solve(&left.matrix, &permutation, &right.vector, &solution.vector);
        double largest = 0;
        for (std::size_t i = 0; i < change.size(); ++i) {
            if (!std::isfinite(change[i])) return false;
            unknown[i] -= change[i];
            largest = std::max(largest, std::abs(change[i]));
        }
        // Rounding of the residual, over the height, is rounding of the speed: low waves hardly tell it.
        if (largest < 1e-13 + 1e-15 / height) return true;
    }
    return false;
}

}  // namespace

double CnoidalWave::speed(double depth) const {
    return std::sqrt(gravity * h1 * h2 * h3) / depth;
}

double CnoidalWave::depth_at(double phase) const {
    double sn, cn, dn;
    gsl_sf_elljac_e(gsl_sf_ellint_Kcomp(std::sqrt(modulus), GSL_PREC_DOUBLE) * phase / pi, modulus, &sn, &cn,
                    &dn);
    return h2 + (h3 - h2) * cn * cn;
}

CnoidalWave cnoidal_wave(double height, double period, double depth) {
    // 1 - m spans many decades: seek its logarithm, by bisection (the period grows with m).
    double low = -36.0, high = -1e-6;
    const auto period_of = [&](double log_complement) {
        const CnoidalWave wave = cnoidal_of_modulus(height, depth, 1.0 - std::exp(log_complement));
        return wave.h1 > 0.0 ? 2.0 * pi / wave.wave_number / wave.speed(depth) : 0.0;
    };
    for (int i = 0; i < 200; ++i) {
        const double middle = 0.5 * (low + high);
        (period_of(middle) > period ? low : high) = middle;
    }
    const CnoidalWave wave = cnoidal_of_modulus(height, depth, 1.0 - std::exp(0.5 * (low + high)));
    if (!(wave.h1 > 0.0))
        throw common::InputError(fmt::format(
            "no cnoidal wave of height {} m and period {} s in {} m of water", height, period, depth));
    return wave;
}

double PermanentForm::elevation(double phase) const {
    double sum = 0;
    for (std::size_t n = amplitude.size(); n > 0; --n)
        sum += amplitude[n - 1] * std::cos(static_cast<double>(n) * phase);
    return sum;
}

/// Cosine series of the exact wave of the classical equations.
PermanentForm cnoidal_form(double height, double period, double depth) {
    const CnoidalWave wave = cnoidal_wave(height, period, depth);
    constexpr std::size_t modes = 192, points = 2 * modes;
    PermanentForm form{};
    form.period = period;
    form.still_depth = depth;
    form.speed = wave.speed(depth);
    form.length = form.speed * period;
    form.flux = form.speed * depth;
    form.amplitude.assign(modes, 0.0);
    for (std::size_t i = 0; i < points; ++i) {
        const double phase = 2.0 * pi * static_cast<double>(i) / static_cast<double>(points);
        const double level = wave.depth_at(phase) - depth;
        for (std::size_t n = 1; n <= modes; ++n)
            form.amplitude[n - 1] +=
                (n == modes ? 1.0 : 2.0) * level * std::cos(static_cast<double>(n) * phase) / points;
    }
    return form;
}

PermanentForm permanent_form(double alpha, double height, double period, double depth) {
    const double time_scale = std::sqrt(depth / gravity);
    const double scaled_period = period / time_scale, scaled_height = height / depth;
    const LinearDispersion linear{.alpha = alpha};
    const double k = linear.wave_number(2.0 * pi / period, depth) * depth;
    const double length = 2.0 * pi / k;
    if (!std::isfinite(k))
        throw common::InputError(
            fmt::format("the equations with alpha = {} carry no wave of period {} s in {} m of water", alpha,
                        period, depth));
    const double ursell = scaled_height * length * length;
    if (alpha == 1.0 && ursell > 26.0) return cnoidal_form(height, period, depth);
    const std::size_t modes = ursell < 26.0 ? 24 : ursell < 200.0 ? 48 : 96;

    std::vector<double> unknown(modes + 2, 0.0);
    unknown[modes] = length / scaled_period;
    unknown[modes + 1] = unknown[modes] * unknown[modes] + 0.5;
    double reached = 0.0, increment = std::min(scaled_height, 0.02);
    while (reached < scaled_height) {
        std::vector<double> attempt = unknown;
        const double next = std::min(scaled_height, reached + increment);
        if (reached == 0.0) attempt[0] = 0.5 * next;
        if (solve_form(alpha, next, scaled_period, attempt)) {
            unknown = attempt;
            reached = next;
            increment *= 1.5;
        } else {
            increment *= 0.5;
            if (increment < 1e-6)
                throw common::InputError(
                    fmt::format("no wave of permanent form of height {} m and period {} s in {} m of water: "
                                "the equations carry at most about {:.3g} m",
                                height, period, depth, reached * depth));
        }
    }
    PermanentForm form{};
    form.period = period;
    form.still_depth = depth;
    form.speed = unknown[modes] * depth / time_scale;
    form.length = form.speed * period;
    form.flux = form.speed * depth;
    form.amplitude.resize(modes);
    for (std::size_t n = 0; n < modes; ++n) form.amplitude[n] = unknown[n] * depth;
    return form;
}

RegularWave::RegularWave(PermanentForm form, double position)
    : form_(std::move(form)), position_(position), table_(table_size + 3) {
    for (std::size_t i = 0; i < table_.size(); ++i)
        table_[i] =
            form_.elevation(2.0 * pi * (static_cast<double>(i) - 1.0) / static_cast<double>(table_size));
}

void RegularWave::at(double t, std::span<const double> x, std::span<double> elevation,
                     std::span<double> velocity) const {
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double turns = (x[i] - position_) / form_.length - t / form_.period;
        const double place = (turns - std::floor(turns)) * static_cast<double>(table_size);
        const auto entry = std::min(static_cast<std::size_t>(place), table_size - 1);
        const double s = place - static_cast<double>(entry);
        const double* v = table_.data() + entry;  // v[1] at the entry itself
        elevation[i] =
            v[1] +
            0.5 * s *
                (v[2] - v[0] +
                 s * (2.0 * v[0] - 5.0 * v[1] + 4.0 * v[2] - v[3] + s * (3.0 * (v[1] - v[2]) + v[3] - v[0])));
        velocity[i] = form_.speed - form_.flux / (form_.still_depth + elevation[i]);
    }
}

}  // namespace boussinesq
