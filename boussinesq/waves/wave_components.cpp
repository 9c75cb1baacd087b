#include "boussinesq/waves/wave_components.hpp"

#include <gsl/gsl_fft_real.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_spline.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "boussinesq/grid.hpp"

namespace boussinesq {
namespace {
constexpr double two_pi = 2.0 * std::numbers::pi;
}

ComponentWave::ComponentWave(std::vector<WaveComponent> components, double position, double interval)
    : components_(std::move(components)), position_(position), interval_(interval) {}

void ComponentWave::evaluate(double t, std::span<const double> x, double* elevation, double* velocity) const {
    std::fill(elevation, elevation + x.size(), 0.0);
    std::fill(velocity, velocity + x.size(), 0.0);
    if (x.empty()) return;
    const double spacing = x.size() > 1 ? (x.back() - x.front()) / static_cast<double>(x.size() - 1) : 0.0;
    for (const WaveComponent& c : components_) {
        // Equal spacing: each place is the last one turned by k dx.
        const double phase = c.wave_number * (x.front() - position_) - c.angular_frequency * t;
        const double turn_cos = std::cos(c.wave_number * spacing),
                     turn_sin = std::sin(c.wave_number * spacing);
        double ec = c.elevation_amplitude * std::cos(phase + c.elevation_phase),
               es = c.elevation_amplitude * std::sin(phase + c.elevation_phase);
        double uc = c.velocity_amplitude * std::cos(phase + c.velocity_phase),
               us = c.velocity_amplitude * std::sin(phase + c.velocity_phase);
        for (std::size_t i = 0; i < x.size(); ++i) {
            elevation[i] += ec;
            velocity[i] += uc;
            const double ec_next = ec * turn_cos - es * turn_sin, uc_next = uc * turn_cos - us * turn_sin;
            es = es * turn_cos + ec * turn_sin;
            us = us * turn_cos + uc * turn_sin;
            ec = ec_next;
            uc = uc_next;
        }
    }
}

void ComponentWave::at(double t, std::span<const double> x, std::span<double> elevation,
                       std::span<double> velocity) const {
    const auto number = static_cast<std::int64_t>(std::floor(t / interval_));
    const double s = t / interval_ - static_cast<double>(number);
    const Sample* around[4];
    samples_.reserve(8);
    for (int j = 0; j < 4; ++j) {
        const std::int64_t wanted = number - 1 + j;
        auto found = std::find_if(samples_.begin(), samples_.end(), [&](const Sample& sample) {
            return sample.number == wanted && sample.elevation.size() == x.size();
        });
        if (found == samples_.end()) {
            if (samples_.size() < 8) {
                samples_.push_back({});
                found = samples_.end() - 1;
            } else {  // the oldest gives way
                found =
                    std::min_element(samples_.begin(), samples_.end(),
                                     [](const Sample& a, const Sample& b) { return a.number < b.number; });
            }
            found->number = wanted;
            found->elevation.resize(x.size());
            found->velocity.resize(x.size());
            evaluate(static_cast<double>(wanted) * interval_, x, found->elevation.data(),
                     found->velocity.data());
        }
        around[j] = &*found;
    }
    // Lagrange weights of four equidistant times
    const double w[4] = {-s * (s - 1.0) * (s - 2.0) / 6.0, (s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0,
                         -(s + 1.0) * s * (s - 2.0) / 2.0, (s + 1.0) * s * (s - 1.0) / 6.0};
    for (std::size_t i = 0; i < x.size(); ++i) {
        elevation[i] = w[0] * around[0]->elevation[i] + w[1] * around[1]->elevation[i] +
                       w[2] * around[2]->elevation[i] + w[3] * around[3]->elevation[i];
        velocity[i] = w[0] * around[0]->velocity[i] + w[1] * around[1]->velocity[i] +
                      w[2] * around[2]->velocity[i] + w[3] * around[3]->velocity[i];
    }
}

double spectral_shape(const SeaState& sea, double frequency) {
    const double ratio = sea.peak_period * frequency;
    const double pierson_moskowitz = std::pow(frequency, -5.0) * std::exp(-1.25 * std::pow(ratio, -4.0));
    if (sea.spectrum == Spectrum::bretschneider_mitsuyasu) return pierson_moskowitz;
    const double width = ratio <= 1.0 ? 0.07 : 0.09;
    return pierson_moskowitz *
           std::pow(sea.peak_enhancement, std::exp(-0.5 * std::pow((ratio - 1.0) / width, 2.0)));
}

std::vector<WaveComponent> sea_components(const SeaState& sea, const LinearDispersion& dispersion,
                                          double depth) {
    const double lowest = 0.4 / sea.peak_period;
    const double deepest = dispersion.angular_frequency(5.0 / depth, depth) / two_pi;
    const double highest = std::min(3.0 / sea.peak_period, deepest);
    constexpr std::size_t fine = 4000;
    std::vector<double> energy(fine + 1, 0.0);
    const double df = (highest - lowest) / fine;
    for (std::size_t i = 0; i < fine; ++i)
        energy[i + 1] = energy[i] + spectral_shape(sea, lowest + (static_cast<double>(i) + 0.5) * df);

    const std::unique_ptr<gsl_rng, void (*)(gsl_rng*)> random(gsl_rng_alloc(gsl_rng_mt19937), gsl_rng_free);
    gsl_rng_set(random.get(), sea.seed);
    const double amplitude =
        sea.significant_height / 4.0 * std::sqrt(2.0 / static_cast<double>(sea.components));
    std::vector<WaveComponent> components(sea.components);
    for (std::size_t n = 0; n < sea.components; ++n) {
        const double share =
            (static_cast<double>(n) + gsl_rng_uniform(random.get())) / static_cast<double>(sea.components);
        const double target = share * energy[fine];
        const auto upper = std::upper_bound(energy.begin(), energy.end(), target);
        const auto i =
            static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(upper - energy.begin() - 1, 0, fine - 1));
        const double frequency =
            lowest + (static_cast<double>(i) + (target - energy[i]) / (energy[i + 1] - energy[i])) * df;
        const double w = two_pi * frequency, k = dispersion.wave_number(w, depth);
        const double phase = two_pi * gsl_rng_uniform(random.get());
        components[n] = {.angular_frequency = w,
                         .wave_number = k,
                         .elevation_amplitude = amplitude,
                         .elevation_phase = phase,
                         .velocity_amplitude = amplitude * w / (k * depth),
                         .velocity_phase = phase};
    }
    return components;
}

std::vector<WaveComponent> record_components(const std::vector<double>& time,
                                             const std::vector<double>& elevation,
                                             const std::vector<double>& velocity,
                                             const LinearDispersion& dispersion, double depth) {
    const double duration = time.back() - time.front();
    double shortest = duration;
    for (std::size_t i = 1; i < time.size(); ++i) shortest = std::min(shortest, time[i] - time[i - 1]);
    const double span = 1.25 * duration;  // the silent rest keeps the record from following itself
    std::size_t count = 64;
    while (span / static_cast<double>(count) > shortest && count < (1u << 16)) count *= 2;
    const double dt = span / static_cast<double>(count);

    const auto transform = [&](const std::vector<double>& values) {
        std::vector<double> data(count, 0.0);
        const std::unique_ptr<gsl_interp_accel, void (*)(gsl_interp_accel*)> lookup(gsl_interp_accel_alloc(),
                                                                                    gsl_interp_accel_free);
        const std::unique_ptr<gsl_spline, void (*)(gsl_spline*)> spline(
            gsl_spline_alloc(gsl_interp_cspline, time.size()), gsl_spline_free);
        gsl_spline_init(spline.get(), time.data(), values.data(), time.size());
        for (std::size_t i = 0; i < count; ++i) {
            const double t = time.front() + static_cast<double>(i) * dt;
            if (t <= time.back()) data[i] = gsl_spline_eval(spline.get(), t, lookup.get());
        }
        gsl_fft_real_radix2_transform(data.data(), 1, count);
        return data;
    };
    const std::vector<double> eta = transform(elevation);
    const std::vector<double> u = velocity.empty() ? std::vector<double>{} : transform(velocity);
    const double scale = 2.0 / static_cast<double>(count);
    std::vector<WaveComponent> components;
    double largest = 0;
    for (std::size_t n = 1; n < count / 2; ++n)
        largest = std::max(largest, std::hypot(eta[n], eta[count - n]));
    for (std::size_t n = 0; n < count / 2; ++n) {
        const double w = two_pi * static_cast<double>(n) / span;
        const double k = n == 0 ? 0.0 : dispersion.wave_number(w, depth);
        const double real = eta[n], imaginary = n == 0 ? 0.0 : eta[count - n];
        // What the equations do not carry, and what is no more than the record's rounding, is left out.
        if (!std::isfinite(k) || k * depth > 5.0 || (n > 0 && std::hypot(real, imaginary) < 1e-5 * largest))
            continue;
        // sum of Re(Z e^{i w (t - t0)}): k x - w t + phase with phase = w t0 - arg Z
        WaveComponent c{};
        c.angular_frequency = w;
        c.wave_number = k;
        c.elevation_amplitude = (n == 0 ? 0.5 : 1.0) * scale * std::hypot(real, imaginary);
        c.elevation_phase = w * time.front() - std::atan2(imaginary, real);
        if (u.empty()) {
            c.velocity_amplitude =
                c.elevation_amplitude * (n == 0 ? std::sqrt(gravity / depth) : w / (k * depth));
            c.velocity_phase = c.elevation_phase;
        } else {
            const double ur = u[n], ui = n == 0 ? 0.0 : u[count - n];
            c.velocity_amplitude = (n == 0 ? 0.5 : 1.0) * scale * std::hypot(ur, ui);
            c.velocity_phase = w * time.front() - std::atan2(ui, ur);
        }
        components.push_back(c);
    }
    return components;
}

}  // namespace boussinesq
