/// An XDMF 3 index over a folder of windows, so that ParaView opens the folder as it is.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>

#include "common/window.hpp"

namespace common {

/// Collects one grid per sample of each picture a window holds (water surface, particles, flow grid, blocks)
/// and writes DIR/<stage>.xdmf. The index refers to the windows' datasets; it copies no values.
class XdmfIndex {
 public:
    /// Adds (or replaces) the samples of one window.
    void add(const Window& window);
    /// Atomic. Throws RunError.
    void write(const std::filesystem::path& folder, const std::string& stage) const;
    /// The index as text.
    std::string text() const;

 private:
    /// picture -> window index -> its grids as XML
    std::map<std::string, std::map<std::int64_t, std::string>> grids_;
};

}  // namespace common
