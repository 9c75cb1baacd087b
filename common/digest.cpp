#include "common/digest.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <array>

#include "common/errors.hpp"

namespace common {

std::string digest_of(std::string_view content) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> bytes{};
    unsigned int length = 0;
    if (EVP_Digest(content.data(), content.size(), bytes.data(), &length, EVP_sha256(), nullptr) != 1)
        throw RunError("SHA-256 is not available in this system's cryptography library");
    constexpr unsigned kept = 16;
    std::string text;
    for (unsigned i = 0; i < kept; ++i) text += fmt::format("{:02x}", bytes[i]);
    return text;
}

}  // namespace common
