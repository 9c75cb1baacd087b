/// Publishing and receiving windows: the only thing that passes between stages.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "common/window.hpp"

namespace common {

/// DIR/window_000042.h5
std::filesystem::path window_path(const std::filesystem::path& folder, std::int64_t index);

/// Writes one window atomically with the root attributes of the contract. Refuses non-finite values,
/// times out of order or outside [t_begin, t_end] (RunError: garbage is never published).
void publish_window(const std::filesystem::path& folder, const Window& window);

/// Reads and checks one window: schema, stage, index, shapes, units, finite values, time order and coverage.
/// Throws InputError naming file and dataset.
Window read_window(const std::filesystem::path& path, const std::string& stage,
                   const std::vector<ExpectedDataset>& expected);

/// Receives the windows of an upstream stage one after the other.
class WindowReader {
 public:
    /// `follow`: wait for windows that are not there yet, until the upstream run.json says it is done.
    WindowReader(std::filesystem::path folder, std::string stage, std::vector<ExpectedDataset> expected,
                 bool follow);

    /// The window `index`, or nothing when the upstream stage ended before it (or, without follow, when it is
    /// not there). Throws InputError on a damaged window, a gap (window missing while later ones exist), or
    /// windows of different digests; RunError when the upstream stage failed or died while followed;
    /// Interrupted.
    std::optional<Window> receive(std::int64_t index);

    /// The first window (waits with follow). Throws InputError when the folder holds none.
    const Window& first();

    /// Index of the window that holds time t (the later one where two meet), by scanning headers from the
    /// first window on; nothing when no window reaches t.
    std::optional<std::int64_t> index_at(double t);

    /// File of the window `index`, for messages.
    std::filesystem::path path_of(std::int64_t index) const { return window_path(folder_, index); }

    /// The end of the last window that is there now (s), or t_begin of nothing (NaN) when there is none.
    double available_until();

 private:
    bool wait_for(const std::filesystem::path& path);
    std::filesystem::path folder_;
    std::string stage_;
    std::vector<ExpectedDataset> expected_;
    bool follow_, has_told_ = false;
    std::optional<Window> first_;
};

}  // namespace common
