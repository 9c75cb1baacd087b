/// SHA-256 digests: names of scenes and checks of files.
#pragma once

#include <string>
#include <string_view>

namespace common {

/// First 32 hexadecimal characters of SHA-256 of `content`.
std::string digest_of(std::string_view content);

}  // namespace common
