#include "boussinesq/gauge_record.hpp"

#include <algorithm>

#include "common/data_file.hpp"
#include "common/window_channel.hpp"

namespace boussinesq {

void add_gauges(common::Window& window, const std::vector<GaugeRecord>& records) {
    for (const GaugeRecord& record : records) {
        const double sliver = 1e-9;
        const auto first = std::lower_bound(record.time.begin(), record.time.end(), window.t_begin - sliver);
        const auto from = first - record.time.begin();
        const auto count = static_cast<std::size_t>(record.time.end() - first);
        const auto part = [&](const std::vector<double>& values) {
            return std::vector<double>(values.begin() + from, values.end());
        };
        const std::string group = "/gauges/" + record.name;
        window.datasets[group + "/time"] = common::real64("s", {count}, part(record.time));
        window.datasets[group + "/surface_elevation"] = common::real64("m", {count}, part(record.elevation));
        window.datasets[group + "/velocity"] = common::real64("m/s", {count}, part(record.velocity));
        if (record.has_array()) {
            window.datasets[group + "/second_elevation"] =
                common::real64("m", {count}, part(record.second_elevation));
            window.datasets[group + "/third_elevation"] =
                common::real64("m", {count}, part(record.third_elevation));
        }
    }
}

void read_gauges(const std::filesystem::path& folder, std::int64_t count, std::vector<GaugeRecord>& records) {
    for (std::int64_t index = 0; index < count; ++index) {
        const common::DataFile file = common::read_data_file(common::window_path(folder, index));
        for (GaugeRecord& record : records) {
            const std::string group = "/gauges/" + record.name;
            const auto& time = file.at(group + "/time").doubles();
            const auto& elevation = file.at(group + "/surface_elevation").doubles();
            const auto& velocity = file.at(group + "/velocity").doubles();
            const std::vector<double> none;
            const auto& second = record.has_array() ? file.at(group + "/second_elevation").doubles() : none;
            const auto& third = record.has_array() ? file.at(group + "/third_elevation").doubles() : none;
            for (std::size_t i = 0; i < time.size(); ++i) {
                if (!record.time.empty() && time[i] <= record.time.back()) continue;  // both ends included
                record.time.push_back(time[i]);
                record.elevation.push_back(elevation[i]);
                record.velocity.push_back(velocity[i]);
                if (record.has_array()) {
                    record.second_elevation.push_back(second[i]);
                    record.third_elevation.push_back(third[i]);
                }
            }
        }
    }
}

}  // namespace boussinesq
