#include "common/window.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"

namespace common {

const Dataset& Window::at(const std::string& name) const {
    const auto found = datasets.find(name);
    if (found == datasets.end())
        throw InputError(fmt::format("window {} of {}: dataset {} is missing", index, stage, name));
    return found->second;
}

}  // namespace common
