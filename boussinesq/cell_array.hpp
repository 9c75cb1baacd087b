/// Arrays over cells, on huge pages where they are long: a sweep over a million cells otherwise waits for
/// page look-ups.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

namespace boussinesq {

template <class T>
struct HugePageAllocator {
    using value_type = T;
    static constexpr std::size_t page = std::size_t{2} << 20;

    HugePageAllocator() = default;
    template <class U>
    HugePageAllocator(const HugePageAllocator<U>&) {}

    T* allocate(std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        const std::size_t unit = bytes >= 2 * page ? page : 64;
        void* memory = std::aligned_alloc(unit, (bytes + unit - 1) / unit * unit);
        if (memory == nullptr) throw std::bad_alloc();
        if (unit == page) madvise(memory, bytes, MADV_HUGEPAGE);  // advice: without it all works, slower
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t) { std::free(memory); }
    friend bool operator==(const HugePageAllocator&, const HugePageAllocator&) { return true; }
};

using CellArray = std::vector<double, HugePageAllocator<double>>;

}  // namespace boussinesq
