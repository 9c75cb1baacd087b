#include "cmps/neighbours.hpp"

#include <algorithm>
#include <cmath>

#include "common/parallel.hpp"

namespace cmps {
namespace {

/// Cells over the particles' bounding box, column-major (z runs fastest).
struct CellGrid {
    double x0, z0, edge;
    std::size_t columns, rows;

    CellGrid(const Particles& particles, std::size_t from, double cell_edge) : edge(cell_edge) {
        double x1 = -1e300, z1 = -1e300;
        x0 = 1e300, z0 = 1e300;
        for (std::size_t i = from; i < particles.size(); ++i) {
            x0 = std::min(x0, particles.x[i]), x1 = std::max(x1, particles.x[i]);
            z0 = std::min(z0, particles.z[i]), z1 = std::max(z1, particles.z[i]);
        }
        columns = static_cast<std::size_t>((x1 - x0) / edge) + 1;
        rows = static_cast<std::size_t>((z1 - z0) / edge) + 1;
    }
    std::size_t cell(double x, double z) const {
        return static_cast<std::size_t>((x - x0) / edge) * rows + static_cast<std::size_t>((z - z0) / edge);
    }
};

}  // namespace

bool NeighbourSearch::update(const Particles& particles) {
    if (is_valid_ && built_x_.size() == particles.size()) {
        const double allowed = 0.25 * skin_ * skin_;  // (half the skin) squared
        double largest = 0;
#pragma omp simd reduction(max : largest)
        for (std::size_t i = 0; i < particles.size(); ++i) {
            const double dx = particles.x[i] - built_x_[i], dz = particles.z[i] - built_z_[i];
            const double moved = dx * dx + dz * dz;
            largest = moved > largest ? moved : largest;
        }
        if (largest < allowed) return false;
    }
    build(particles);
    is_valid_ = true;
    return true;
}

void NeighbourSearch::build(const Particles& particles) {
    const std::size_t count = particles.size(), first = particles.first_wall(), rows = count - first;
    built_x_ = particles.x;
    built_z_ = particles.z;
    lists_.start.assign(rows + 1, 0);
    lists_.carriers.assign(rows, 0);
    if (count == 0) return;

    const double reach = radius_ + skin_;
    const CellGrid grid(particles, 0, reach);
    cell_start_.assign(grid.columns * grid.rows + 1, 0);
    cell_of_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        cell_of_[i] = static_cast<std::uint32_t>(grid.cell(particles.x[i], particles.z[i]));
        ++cell_start_[cell_of_[i] + 1];
    }
    for (std::size_t c = 0; c + 1 < cell_start_.size(); ++c) cell_start_[c + 1] += cell_start_[c];
    cell_members_.resize(count);
    for (std::size_t i = 0; i < count; ++i) cell_members_[cell_start_[cell_of_[i]]++] = static_cast<std::int32_t>(i);
    for (std::size_t c = cell_start_.size() - 1; c > 0; --c) cell_start_[c] = cell_start_[c - 1];
    cell_start_[0] = 0;

    // Visits candidates of particle i within reach.
    const auto visit = [&](std::size_t i, const auto& found) {
        const std::size_t column = cell_of_[i] / grid.rows, row = cell_of_[i] % grid.rows;
        const std::size_t row0 = row > 0 ? row - 1 : 0, row1 = std::min(row + 1, grid.rows - 1);
        const double x = particles.x[i], z = particles.z[i];
        for (std::size_t c = column > 0 ? column - 1 : 0; c <= std::min(column + 1, grid.columns - 1); ++c)
            for (std::size_t m = cell_start_[c * grid.rows + row0]; m < cell_start_[c * grid.rows + row1 + 1]; ++m) {
                const std::int32_t j = cell_members_[m];
                const double dx = particles.x[j] - x, dz = particles.z[j] - z;
                if (dx * dx + dz * dz < reach * reach && static_cast<std::size_t>(j) != i) found(j);
            }
    };
    constexpr std::size_t serial_below = 4000;  // rows; less is done before threads are awake
    common::parallel_for(rows, serial_below, [&](std::size_t r) {
        std::uint32_t neighbours = 0;
        visit(first + r, [&](std::int32_t) { ++neighbours; });
        lists_.start[r + 1] = neighbours;
    });
    for (std::size_t r = 0; r < rows; ++r) lists_.start[r + 1] += lists_.start[r];
    lists_.neighbour.resize(lists_.start[rows]);
    common::parallel_for(rows, serial_below, [&](std::size_t r) {
        std::uint32_t next = lists_.start[r];
        visit(first + r, [&](std::int32_t j) { lists_.neighbour[next++] = j; });
        const auto begin = lists_.neighbour.begin() + lists_.start[r], end = lists_.neighbour.begin() + next;
        std::sort(begin, end);
        lists_.carriers[r] = static_cast<std::uint32_t>(
            std::lower_bound(begin, end, static_cast<std::int32_t>(first)) - lists_.neighbour.begin());
    });
}

void NeighbourSearch::sort_fluid(Particles& particles, double edge) {
    if (particles.fluid == 0) return;
    const std::size_t first = particles.first_fluid(), count = particles.fluid;
    const CellGrid grid(particles, first, edge);
    order_.resize(count);
    std::vector<std::uint32_t>& cell = cell_of_;
    cell.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        order_[i] = static_cast<std::int32_t>(first + i);
        cell[i] = static_cast<std::uint32_t>(grid.cell(particles.x[first + i], particles.z[first + i]));
    }
    std::sort(order_.begin(), order_.end(), [&](std::int32_t a, std::int32_t b) {
        const std::size_t ca = cell[static_cast<std::size_t>(a) - first], cb = cell[static_cast<std::size_t>(b) - first];
        return ca != cb ? ca < cb : a < b;
    });
    particles.for_each_array([&](auto& array) {
        using Value = typename std::remove_reference_t<decltype(array)>::value_type;
        auto& buffer = [this]() -> auto& {
            if constexpr (std::is_same_v<Value, double>)
                return sort_buffer_;
            else
                return sort_integers_;
        }();
        buffer.resize(count);
        for (std::size_t i = 0; i < count; ++i) buffer[i] = array[order_[i]];
        std::copy(buffer.begin(), buffer.end(), array.begin() + static_cast<std::ptrdiff_t>(first));
    });
    is_valid_ = false;
}

}  // namespace cmps
