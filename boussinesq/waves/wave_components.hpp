/// Waves as a sum of linear components: irregular sea states and waves known from a record.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "boussinesq/waves/bound_waves.hpp"
#include "boussinesq/waves/incident_wave.hpp"
#include "boussinesq/waves/wave_theory.hpp"

namespace boussinesq {

/// eta = amplitude cos(k x - w t + phase), u likewise with its own amplitude and phase.
struct WaveComponent {
    double angular_frequency, wave_number;        ///< rad/s, rad/m
    double elevation_amplitude, elevation_phase;  ///< m, rad
    double velocity_amplitude, velocity_phase;    ///< m/s, rad
};

/// Waves come in from `begin` to `end` (s) only; before and after there is none, to the last bit.
struct WaveDuration {
    double begin = -std::numeric_limits<double>::infinity(), end = std::numeric_limits<double>::infinity();
};

/// Sum of components, and of the waves bound to them; x is counted from `position`.
///
/// A sum over hundreds of components at every cell and step would cost more than the flow itself, so it is
/// evaluated at times a sixtieth of the shortest period of weight apart and followed in between by cubic
/// interpolation (1e-6 of the height). Times are fixed multiples of that interval: the values do not depend
/// on the steps taken.
class ComponentWave : public IncidentWave {
 public:
    ComponentWave(std::vector<WaveComponent> components, double position, double interval,
                  std::optional<BoundWaves> bound = {}, WaveDuration duration = {});
    void at(double t, std::span<const double> x, std::span<double> elevation,
            std::span<double> velocity) const override;
    const std::vector<WaveComponent>& components() const { return components_; }

 private:
    void evaluate(double t, std::span<const double> x, std::span<double> elevation,
                  std::span<double> velocity) const;
    std::vector<WaveComponent> components_;
    double position_, interval_;
    std::optional<BoundWaves> bound_;
    WaveDuration duration_;
    Eigen::MatrixXd
        shares_;  ///< rows: elevation, velocity (two), shares of the bound waves; a column a component
    /// Values at four neighbouring times, by number of the interval; filled on demand.
    struct Sample {
        std::int64_t number;
        std::vector<double> elevation, velocity;
    };
    mutable std::vector<Sample> samples_;
    mutable Eigen::ArrayXd turn_real_, turn_imaginary_;  ///< of each component from place to place
    mutable double turn_spacing_ = 0;
    mutable Eigen::MatrixXd real_, imaginary_, sum_real_, sum_imaginary_, product_;  ///< scratch of evaluate
};

/// Shape of an irregular sea state.
enum class Spectrum { jonswap, bretschneider_mitsuyasu };

struct SeaState {
    Spectrum spectrum = Spectrum::jonswap;
    double significant_height = 0;  ///< H_1/3 = 4 sqrt(m0), m
    double peak_period = 0;         ///< s
    double peak_enhancement = 3.3;  ///< JONSWAP gamma
    std::size_t components = 200;
    std::uint64_t seed = 1;
};

/// Spectral density (m2 s) at frequency f (Hz) of unit m0 shape, not normalised.
double spectral_shape(const SeaState& sea, double frequency);

/// Components of equal energy, frequency drawn inside its band and phase uniform (seeded, so that a run
/// repeats). Bands end at 3 peak frequencies and where the equations' dispersion ends being good (k d = 5).
std::vector<WaveComponent> sea_components(const SeaState& sea, const LinearDispersion& dispersion,
                                          double depth);

/// A record of the incident wave at one place.
struct WaveRecord {
    std::vector<double> time, elevation;  ///< s, m
    std::vector<double> velocity;         ///< m/s; empty: linear theory gives it
};

/// Components of a record, by FFT after resampling with a cubic spline over `span` seconds, of which it fills
/// the first; the rest is silent. A sum of them repeats itself every `span`: see record_duration. Left out
/// are kd > 5, which the equations do not carry, and what is no more than the record's rounding.
std::vector<WaveComponent> record_components(const WaveRecord& record, double span,
                                             const LinearDispersion& dispersion, double depth);

/// When a record's waves are somewhere in [from, to], places counted from where it was taken (m): from its
/// first time, less what its slowest waves (kd = 5) need from the place farthest offshore, to its last and
/// what they need to the place farthest shoreward; a period more at both ends for the ripples of a record
/// that begins or ends amid a wave.
WaveDuration record_duration(const WaveRecord& record, double from, double to, double period,
                             const LinearDispersion& dispersion, double depth);

/// Energy mean period of a record, m0 / m1 of its spectrum up to kd = 5, s, and the share of its variance
/// beyond, which the equations do not carry. Quiet parts and a silent lead-in have no weight; a single pulse
/// has the period of a wave of which it is the crest.
struct RecordPeriod {
    double period, share_left_out;
};
RecordPeriod record_period(const WaveRecord& record, const LinearDispersion& dispersion, double depth);

}  // namespace boussinesq
