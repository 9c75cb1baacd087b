/// Threads with results that do not depend on their number.
#pragma once

#include <omp.h>

#include <cstddef>

namespace common {

/// Sets the number of OpenMP threads. Call it first in main: with several threads the program may start
/// itself anew with passive waiting, because spinning is ruinous on shared cores.
void use_threads(int count);

/// body(i) for i in [0, count), statically shared out; each i must write only what belongs to it.
/// Below `serial_below` items it runs on the calling thread: waking threads costs microseconds.
template <class Body>
void parallel_for(std::size_t count, std::size_t serial_below, const Body& body) {
    if (count < serial_below || omp_get_max_threads() == 1) {
        for (std::size_t i = 0; i < count; ++i) body(i);
        return;
    }
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < count; ++i) body(i);
}

/// Sum of term(i) over [0, count) in blocks of fixed size, added in order: the same bits for any number of
/// threads.
template <class Term>
double ordered_sum(std::size_t count, const Term& term) {
    constexpr std::size_t block = 1024;
    constexpr std::size_t most_blocks = 64;
    double total = 0;
    for (std::size_t chunk = 0; chunk < count; chunk += block * most_blocks) {
        double partial[most_blocks] = {};
        const std::size_t left = count - chunk;
        const std::size_t blocks = left >= block * most_blocks ? most_blocks : (left + block - 1) / block;
        parallel_for(blocks, 8, [&](std::size_t b) {
            const std::size_t from = chunk + b * block;
            const std::size_t to = from + block < count ? from + block : count;
            double sum = 0;
            for (std::size_t i = from; i < to; ++i) sum += term(i);
            partial[b] = sum;
        });
        for (std::size_t b = 0; b < blocks; ++b) total += partial[b];
    }
    return total;
}

}  // namespace common
