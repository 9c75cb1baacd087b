#include "common/check_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace common {

void print_check_report(const std::vector<EffectRecord>& effects, const std::vector<ForecastLine>& forecast) {
    std::size_t width = 0;
    for (const auto& effect : effects) width = std::max(width, effect.name.size());
    for (const auto& line : forecast) width = std::max(width, line.name.size());
    fmt::print("effects\n");
    for (const auto& effect : effects)
        fmt::print("  {:<{}}  {:<4} {}\n", effect.name, width, effect.is_on ? "on" : "off", effect.reason);
    fmt::print("forecast\n");
    for (const auto& line : forecast) fmt::print("  {:<{}}  {}\n", line.name, width, line.text);
}

std::string run_time_text(double seconds) {
    constexpr double minute = 60, hour = 3600, largest_number = 100;
    if (seconds < largest_number) return fmt::format("{:.2g} s", seconds);
    if (seconds < largest_number * minute) return fmt::format("{:.2g} min", seconds / minute);
    return fmt::format("{:.3g} h", seconds / hour);
}

}  // namespace common
