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

ComponentWave::ComponentWave(std::vector<WaveComponent> components, double position, double interval,
                             std::optional<BoundWaves> bound, WaveDuration duration)
    : components_(std::move(components)),
      position_(position),
      interval_(interval),
      bound_(std::move(bound)),
      duration_(duration) {
    const auto count = static_cast<Eigen::Index>(components_.size());
    shares_.resize(3 + (bound_ ? bound_->share.rows() : 0), count);
    for (Eigen::Index n = 0; n < count; ++n) {
        const WaveComponent& c = components_[static_cast<std::size_t>(n)];
        const double ahead = c.velocity_phase - c.elevation_phase;
        shares_(0, n) = c.elevation_amplitude;
        shares_(1, n) = c.velocity_amplitude * std::cos(ahead);
        shares_(2, n) = -c.velocity_amplitude * std::sin(ahead);
    }
    if (bound_) shares_.bottomRows(bound_->share.rows()) = bound_->share;
}

void ComponentWave::evaluate(double t, std::span<const double> x, std::span<double> elevation,
                             std::span<double> velocity) const {
    if (x.empty()) return;
    if (t < duration_.begin || t > duration_.end) {
        std::fill(elevation.begin(), elevation.end(), 0.0);
        std::fill(velocity.begin(), velocity.end(), 0.0);
        return;
    }
    const auto places = static_cast<Eigen::Index>(x.size());
    const double spacing = places > 1 ? (x.back() - x.front()) / static_cast<double>(places - 1) : 0.0;
    if (turn_real_.size() != shares_.cols() || spacing != turn_spacing_) {
        turn_spacing_ = spacing;
        turn_real_.resize(shares_.cols());
        turn_imaginary_.resize(shares_.cols());
        for (Eigen::Index n = 0; n < shares_.cols(); ++n) {
            const double angle = components_[static_cast<std::size_t>(n)].wave_number * spacing;
            turn_real_[n] = std::cos(angle);
            turn_imaginary_[n] = std::sin(angle);
        }
    }
    sum_real_.setZero(shares_.rows(), places);
    sum_imaginary_.setZero(shares_.rows(), places);
    const Eigen::Index batch = std::min<Eigen::Index>(128, shares_.cols());  // at all places, in the cache
    real_.resize(batch, places);
    imaginary_.resize(batch, places);
    for (Eigen::Index begin = 0; begin < shares_.cols(); begin += batch) {
        const Eigen::Index count = std::min(batch, shares_.cols() - begin);
        auto real = real_.topRows(count), imaginary = imaginary_.topRows(count);
        const auto turn_real = turn_real_.segment(begin, count),
                   turn_imaginary = turn_imaginary_.segment(begin, count);
        for (Eigen::Index n = 0; n < count; ++n) {
            const WaveComponent& c = components_[static_cast<std::size_t>(begin + n)];
            const double phase =
                c.wave_number * (x.front() - position_) - c.angular_frequency * t + c.elevation_phase;
            real(n, 0) = std::cos(phase);
            imaginary(n, 0) = std::sin(phase);
        }
        // Equal spacing: each place is the last one turned by k dx.
        for (Eigen::Index i = 1; i < places; ++i) {
            real.col(i) = real.col(i - 1).array() * turn_real - imaginary.col(i - 1).array() * turn_imaginary;
            imaginary.col(i) =
                imaginary.col(i - 1).array() * turn_real + real.col(i - 1).array() * turn_imaginary;
        }
        sum_real_.noalias() += shares_.middleCols(begin, count) * real;
        sum_imaginary_.noalias() += shares_.middleCols(begin, count) * imaginary;
    }
    Eigen::Map<Eigen::RowVectorXd> eta(elevation.data(), places), u(velocity.data(), places);
    eta = sum_real_.row(0);
    u = sum_real_.row(1) + sum_imaginary_.row(2);
    if (!bound_) return;
    const auto real = sum_real_.bottomRows(bound_->share.rows());
    const auto imaginary = sum_imaginary_.bottomRows(bound_->share.rows());
    const auto add = [&](auto& values, const Eigen::MatrixXd& of_real, const Eigen::MatrixXd& of_imaginary,
                         double mean) {
        product_.noalias() = of_real * real;
        values += real.cwiseProduct(product_).colwise().sum();
        product_.noalias() = of_imaginary * imaginary;
        values += imaginary.cwiseProduct(product_).colwise().sum();
        values.array() -= mean;
    };
    add(eta, bound_->elevation_real, bound_->elevation_imaginary, bound_->mean_elevation);
    add(u, bound_->velocity_real, bound_->velocity_imaginary, bound_->mean_velocity);
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
            evaluate(static_cast<double>(wanted) * interval_, x, found->elevation, found->velocity);
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

namespace {

constexpr double largest_kd = 5.0;  // of waves that the equations carry

/// Half-complex spectrum of values that begin at time.front() and are silent after time.back(), in GSL's
/// order.
std::vector<double> transform(const std::vector<double>& time, const std::vector<double>& values, double span,
                              std::size_t count) {
    std::vector<double> data(count, 0.0);
    const std::unique_ptr<gsl_interp_accel, void (*)(gsl_interp_accel*)> lookup(gsl_interp_accel_alloc(),
                                                                                gsl_interp_accel_free);
    const std::unique_ptr<gsl_spline, void (*)(gsl_spline*)> spline(
        gsl_spline_alloc(gsl_interp_cspline, time.size()), gsl_spline_free);
    gsl_spline_init(spline.get(), time.data(), values.data(), time.size());
    for (std::size_t i = 0; i < count; ++i) {
        const double t = time.front() + span * static_cast<double>(i) / static_cast<double>(count);
        if (t <= time.back()) data[i] = gsl_spline_eval(spline.get(), t, lookup.get());
    }
    gsl_fft_real_radix2_transform(data.data(), 1, count);
    return data;
}

/// Samples over `span`, a power of two, at least as close as the record's own (up to a million).
std::size_t sample_count(const std::vector<double>& time, double span) {
    double shortest = time.back() - time.front();
    for (std::size_t i = 1; i < time.size(); ++i) shortest = std::min(shortest, time[i] - time[i - 1]);
    std::size_t count = 64;
    while (span / static_cast<double>(count) > shortest && count < (1u << 20)) count *= 2;
    return count;
}

}  // namespace

std::vector<WaveComponent> record_components(const WaveRecord& record, double span,
                                             const LinearDispersion& dispersion, double depth) {
    const std::size_t count = sample_count(record.time, span);
    const std::vector<double> eta = transform(record.time, record.elevation, span, count);
    const std::vector<double> u = record.velocity.empty()
                                      ? std::vector<double>{}
                                      : transform(record.time, record.velocity, span, count);
    const double begin = record.time.front(), scale = 2.0 / static_cast<double>(count);
    std::vector<WaveComponent> components;
    double largest = 0;
    for (std::size_t n = 1; n < count / 2; ++n)
        largest = std::max(largest, std::hypot(eta[n], eta[count - n]));
    for (std::size_t n = 0; n < count / 2; ++n) {
        const double w = two_pi * static_cast<double>(n) / span;
        const double k = n == 0 ? 0.0 : dispersion.wave_number(w, depth);
        const double real = eta[n], imaginary = n == 0 ? 0.0 : eta[count - n];
        if (!std::isfinite(k) || k * depth > largest_kd ||
            (n > 0 && std::hypot(real, imaginary) < 1e-5 * largest))
            continue;
        // sum of Re(Z e^{i w (t - t0)}): k x - w t + phase with phase = w t0 - arg Z
        WaveComponent c{};
        c.angular_frequency = w;
        c.wave_number = k;
        c.elevation_amplitude = (n == 0 ? 0.5 : 1.0) * scale * std::hypot(real, imaginary);
        c.elevation_phase = w * begin - std::atan2(imaginary, real);
        if (u.empty()) {
            c.velocity_amplitude =
                c.elevation_amplitude * (n == 0 ? std::sqrt(gravity / depth) : w / (k * depth));
            c.velocity_phase = c.elevation_phase;
        } else {
            const double ur = u[n], ui = n == 0 ? 0.0 : u[count - n];
            c.velocity_amplitude = (n == 0 ? 0.5 : 1.0) * scale * std::hypot(ur, ui);
            c.velocity_phase = w * begin - std::atan2(ui, ur);
        }
        components.push_back(c);
    }
    return components;
}

WaveDuration record_duration(const WaveRecord& record, double from, double to, double period,
                             const LinearDispersion& dispersion, double depth) {
    const double slowest = dispersion.group_speed(largest_kd / depth, depth);
    return {record.time.front() - std::max(-from, 0.0) / slowest - period,
            record.time.back() + std::max(to, 0.0) / slowest + period};
}

RecordPeriod record_period(const WaveRecord& record, const LinearDispersion& dispersion, double depth) {
    const double span = 1.25 * (record.time.back() - record.time.front());
    const std::size_t count = sample_count(record.time, span);
    const std::vector<double> eta = transform(record.time, record.elevation, span, count);
    double all = 0, carried = 0, first_moment = 0;
    for (std::size_t n = 1; n < count / 2; ++n) {
        const double w = two_pi * static_cast<double>(n) / span;
        const double energy = eta[n] * eta[n] + eta[count - n] * eta[count - n];
        all += energy;
        const double k = dispersion.wave_number(w, depth);
        if (!std::isfinite(k) || k * depth > largest_kd) continue;
        carried += energy;
        first_moment += w * energy;
    }
    return {carried > 0 ? two_pi * carried / first_moment : 0.0, all > 0 ? 1.0 - carried / all : 0.0};
}

}  // namespace boussinesq
