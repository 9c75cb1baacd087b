#include "cmps/running_mean.hpp"

#include <algorithm>

namespace cmps {

std::span<double> RunningMean::add_step(double step) {
    double covered = step;
    std::size_t kept = 0;
    for (; kept < count_ && covered < duration_; ++kept) covered += steps_[slot(kept)];
    count_ = kept;
    if (count_ == steps_.size()) {
        const std::vector<double> held = state();
        const std::size_t room = std::max<std::size_t>(16, 2 * count_);
        steps_.assign(room, 0.0), values_.assign(room * channels_, 0.0);
        restore(held);
    }
    const std::size_t place = next_;
    steps_[place] = step;
    next_ = (next_ + 1) % steps_.size();
    ++count_;
    return {values_.data() + place * channels_, channels_};
}

double RunningMean::mean(std::size_t channel) const {
    double sum = 0, covered = 0;
    for (std::size_t age = 0; age < count_ && covered < duration_; ++age) {
        const double share = std::min(steps_[slot(age)], duration_ - covered);
        sum += share * values_[slot(age) * channels_ + channel], covered += share;
    }
    return covered > 0 ? sum / covered : values_[slot(0) * channels_ + channel];
}

std::vector<double> RunningMean::state() const {
    std::vector<double> state;
    state.reserve(count_ * (1 + channels_));
    for (std::size_t age = count_; age-- > 0;) {
        const auto values = values_.begin() + static_cast<std::ptrdiff_t>(slot(age) * channels_);
        state.push_back(steps_[slot(age)]);
        state.insert(state.end(), values, values + static_cast<std::ptrdiff_t>(channels_));
    }
    return state;
}

void RunningMean::restore(const std::vector<double>& state) {
    const std::size_t row = 1 + channels_;
    count_ = state.size() / row;
    if (steps_.size() < count_) steps_.resize(count_), values_.resize(count_ * channels_);
    for (std::size_t k = 0; k < count_; ++k) {
        steps_[k] = state[k * row];
        std::copy_n(state.begin() + static_cast<std::ptrdiff_t>(k * row + 1), channels_,
                    values_.begin() + static_cast<std::ptrdiff_t>(k * channels_));
    }
    next_ = steps_.empty() ? 0 : count_ % steps_.size();
}

}  // namespace cmps
