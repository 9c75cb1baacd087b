/// Asks for memory before it is needed.
#pragma once

#include <algorithm>
#include <cstddef>

namespace dem {

/// Asks for elements [first, first + count) of an array, as far as it has them. Thousands of blocks do not
/// stay in the near caches, and what a step reads of them lies in more arrays than the processor follows by
/// itself.
template <class Array>
void fetch_ahead(const Array& array, std::size_t first, std::size_t count) {
    constexpr std::size_t line = 64;  // bytes
    const std::size_t end = std::min(first + count, array.size());
    if (first >= end) return;
    const auto* bytes = reinterpret_cast<const char*>(array.data() + first);
    const std::size_t size = (end - first) * sizeof(array[0]);
    for (std::size_t byte = 0; byte < size; byte += line) __builtin_prefetch(bytes + byte);
    __builtin_prefetch(bytes + size - 1);  // the elements need not begin where a line does
}

}  // namespace dem
