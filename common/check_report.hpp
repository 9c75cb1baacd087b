/// What `check` prints, the same for all stages.
#pragma once

#include <string>
#include <vector>

#include "common/run_record.hpp"

namespace common {

/// One line of the forecast: "steps", "about 3372 of 0.012 s".
struct ForecastLine {
    std::string name, text;
};

/// Prints the effects with their reasons and the forecast to stdout.
void print_check_report(const std::vector<EffectRecord>& effects, const std::vector<ForecastLine>& forecast);

/// "0.35 s", "5.2 min", "3.1 h": a run time that nobody knows to more than two digits.
std::string run_time_text(double seconds);

}  // namespace common
