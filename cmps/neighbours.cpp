#include "cmps/neighbours.hpp"

#include <algorithm>
#include <type_traits>

#include "common/parallel.hpp"

namespace cmps {

/// Cells over the particles' bounding box; z runs fastest.
struct NeighbourSearch::Cells {
    double x0 = 1e300, z0 = 1e300, edge;
    std::size_t columns, rows;

    Cells(const Particles& particles, double cell_edge) : edge(cell_edge) {
        double x1 = -1e300, z1 = -1e300;
        for (std::size_t i = 0; i < particles.size(); ++i) {
            x0 = std::min(x0, particles.x[i]), x1 = std::max(x1, particles.x[i]);
            z0 = std::min(z0, particles.z[i]), z1 = std::max(z1, particles.z[i]);
        }
        columns = static_cast<std::size_t>((x1 - x0) / edge) + 1;
        rows = static_cast<std::size_t>((z1 - z0) / edge) + 1;
    }
    std::size_t column(double x) const { return static_cast<std::size_t>((x - x0) / edge); }
    std::size_t row(double z) const { return static_cast<std::size_t>((z - z0) / edge); }
    std::size_t cell(double x, double z) const { return column(x) * rows + row(z); }
};

bool NeighbourSearch::update(Particles& particles, const std::vector<std::vector<double>*>& companions) {
    if (is_valid_ && built_x_.size() == particles.size() && lists_hold(particles)) return false;
    build(particles, companions);
    return true;
}

/// Two particles that were not listed were a skin out of reach. What counts is how far they have moved
/// against each other, and only those near each other: water that moves together keeps its lists. The water
/// is cut into strips in x, wider than any link; the displacements of two strips side by side lie in a box,
/// whose diagonal no pair of theirs exceeds.
bool NeighbourSearch::lists_hold(const Particles& particles) {
    const double width = 2 * (radius_ + skin_), per_width = 1 / width;
    Displacements none;
    displacements_.assign(static_cast<std::size_t>((right_ - left_) * per_width) + 1, none);
    std::size_t strip = 0;
    Displacements here = none;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const auto now = static_cast<std::size_t>((built_x_[i] - left_) * per_width);
        if (now != strip) {  // seldom: the fluid stands in the order of x
            displacements_[strip] = here;
            here = displacements_[strip = now];
        }
        here.include(particles.x[i] - built_x_[i], particles.z[i] - built_z_[i]);
    }
    if (particles.size() > 0) displacements_[strip] = here;
    const double farthest2 = 0.25 * radius_ * radius_;  // strips farther apart cannot have met within this
    for (std::size_t s = 0; s < displacements_.size(); ++s) {
        Displacements both = displacements_[s];
        if (s + 1 < displacements_.size()) both.include(displacements_[s + 1]);
        if (both.x1 < both.x0) continue;  // nobody
        const double dx = both.x1 - both.x0, dz = both.z1 - both.z0;
        const double x = std::max(-both.x0, both.x1), z = std::max(-both.z0, both.z1);
        if (!(dx * dx + dz * dz < skin_ * skin_ && x * x + z * z < farthest2)) return false;
    }
    return true;
}

void NeighbourSearch::restore(const Particles& particles, const std::vector<double>& x,
                              const std::vector<double>& z) {
    is_valid_ = false;
    if (x.size() != particles.size()) return;  // someone came or left since: they are built anew anyway
    Particles then = particles;
    then.x = x, then.z = z;
    build(then, {});
    built_x_ = x, built_z_ = z;
}

void NeighbourSearch::build(Particles& particles, const std::vector<std::vector<double>*>& companions) {
    const std::size_t count = particles.size(), first = particles.first_wall(), rows = count - first;
    lists_.start.assign(rows + 1, 0);
    lists_.carriers.assign(rows, 0);
    lists_.neighbour.clear();
    is_valid_ = true;
    if (count == 0) return;

    const double reach = radius_ + skin_, reach2 = reach * reach;
    const Cells cells(particles, 0.5 * reach);
    sort_fluid(particles, cells, companions);
    sort_boundary(particles, cells);
    built_x_ = particles.x;
    built_z_ = particles.z;
    const auto [leftmost, rightmost] = std::minmax_element(built_x_.begin(), built_x_.end());
    left_ = *leftmost, right_ = *rightmost;

    const double* const x = particles.x.data();
    const double* const z = particles.z.data();
    const std::size_t first_fluid = particles.first_fluid();
    // Where the candidates of a cell stand: the same for all particles in it, which come one after another.
    struct Runs {
        std::size_t cell = static_cast<std::size_t>(-1), columns = 0, candidates = 0;
        std::uint32_t boundary[5][2], fluid[5][2];
        bool has_boundary = false;
    };
    const auto find_runs = [&](std::size_t column, std::size_t row, Runs& runs) {
        const std::size_t row0 = row > 2 ? row - 2 : 0, row1 = std::min(row + 2, cells.rows - 1);
        const std::size_t column0 = column > 2 ? column - 2 : 0;
        runs.columns = std::min(column + 2, cells.columns - 1) - column0 + 1;
        runs.candidates = 0;
        runs.has_boundary = false;
        for (std::size_t c = 0; c < runs.columns; ++c) {
            const std::size_t from = (column0 + c) * cells.rows + row0,
                              to = (column0 + c) * cells.rows + row1 + 1;
            runs.boundary[c][0] = boundary_start_[from], runs.boundary[c][1] = boundary_start_[to];
            runs.fluid[c][0] = fluid_start_[from], runs.fluid[c][1] = fluid_start_[to];
            const std::uint32_t boundary = boundary_start_[to] - boundary_start_[from];
            runs.candidates += boundary + fluid_start_[to] - fluid_start_[from];
            runs.has_boundary |= boundary > 0;
        }
    };
    // Writes the neighbours of row r, ascending, to `out` (room for all candidates); returns how many, and
    // how many of them are dummies.
    const auto collect = [&](std::size_t r, const Runs& runs, std::int32_t* out, std::uint32_t& dummies) {
        const auto i = static_cast<std::int32_t>(first + r);
        const double xi = x[i], zi = z[i];
        std::size_t found = 0;
        // a candidate is written in any case, and overwritten by the next one where it is too far: no branch
        const auto test = [&](std::int32_t j) {
            const double dx = x[j] - xi, dz = z[j] - zi;
            out[found] = j;
            found += (dx * dx + dz * dz < reach2) & (j != i);
        };
        dummies = 0;
        if (runs.has_boundary) {
            for (std::size_t c = 0; c < runs.columns; ++c)
                for (std::size_t m = runs.boundary[c][0]; m < runs.boundary[c][1]; ++m)
                    test(boundary_members_[m]);
            std::sort(out, out + found);
            dummies = static_cast<std::uint32_t>(
                std::lower_bound(out, out + found, static_cast<std::int32_t>(first)) - out);
        }
        for (std::size_t c = 0; c < runs.columns; ++c) {
            const auto end = static_cast<std::int32_t>(first_fluid + runs.fluid[c][1]);
            for (auto j = static_cast<std::int32_t>(first_fluid + runs.fluid[c][0]); j < end; ++j) test(j);
        }
        return static_cast<std::uint32_t>(found);
    };

    // Blocks of rows are collected side by side, then joined: the same lists for any number of threads.
    constexpr std::size_t block = 512;
    const std::size_t blocks = (rows + block - 1) / block;
    blocks_.resize(std::max(blocks_.size(), blocks));
    common::parallel_for(blocks, 8, [&](std::size_t b) {
        std::vector<std::int32_t>& found = blocks_[b];
        std::size_t used = 0;
        Runs runs;
        for (std::size_t r = b * block; r < std::min(rows, (b + 1) * block); ++r) {
            const std::size_t column = cells.column(x[first + r]), row = cells.row(z[first + r]);
            if (column * cells.rows + row != runs.cell) {
                find_runs(column, row, runs);
                runs.cell = column * cells.rows + row;
            }
            const std::size_t room = used + runs.candidates + 1;
            if (found.size() < room) found.resize(2 * room);
            std::uint32_t dummies = 0;
            const std::uint32_t count_here = collect(r, runs, found.data() + used, dummies);
            lists_.start[r + 1] = count_here;
            lists_.carriers[r] = dummies;
            used += count_here;
        }
    });
    for (std::size_t r = 0; r < rows; ++r) {
        lists_.carriers[r] += lists_.start[r];
        lists_.start[r + 1] += lists_.start[r];
    }
    lists_.neighbour.resize(lists_.start[rows]);
    common::parallel_for(blocks, 8, [&](std::size_t b) {
        const std::size_t from = b * block, to = std::min(rows, from + block);
        std::copy_n(blocks_[b].begin(), lists_.start[to] - lists_.start[from],
                    lists_.neighbour.begin() + lists_.start[from]);
    });
}

void NeighbourSearch::sort_fluid(Particles& particles, const Cells& cells,
                                 const std::vector<std::vector<double>*>& companions) {
    const std::size_t first = particles.first_fluid(), count = particles.fluid;
    fluid_start_.assign(cells.columns * cells.rows + 1, 0);
    cell_of_.resize(count), order_.resize(count);
    for (std::size_t f = 0; f < count; ++f) {
        cell_of_[f] = static_cast<std::uint32_t>(cells.cell(particles.x[first + f], particles.z[first + f]));
        ++fluid_start_[cell_of_[f]];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& start : fluid_start_) {
        const std::uint32_t here = start;
        start = sum;
        sum += here;
    }
    for (std::size_t f = 0; f < count; ++f)
        order_[fluid_start_[cell_of_[f]]++] = static_cast<std::int32_t>(f);
    for (std::size_t c = fluid_start_.size() - 1; c > 0; --c) fluid_start_[c] = fluid_start_[c - 1];
    fluid_start_[0] = 0;
    if (std::is_sorted(order_.begin(), order_.end())) return;

    const auto reorder = [&](auto& array) {
        using Value = typename std::remove_reference_t<decltype(array)>::value_type;
        auto& buffer = [this]() -> auto& {
            if constexpr (std::is_same_v<Value, double>)
                return real_buffer_;
            else
                return integer_buffer_;
        }
        ();
        buffer.resize(count);
        for (std::size_t f = 0; f < count; ++f) buffer[f] = array[first + order_[f]];
        std::copy(buffer.begin(), buffer.end(), array.begin() + static_cast<std::ptrdiff_t>(first));
    };
    reorder(particles.x), reorder(particles.z), reorder(particles.u), reorder(particles.w);
    reorder(particles.pressure);
    for (auto& mean : particles.path_u) reorder(mean);
    for (auto& mean : particles.path_w) reorder(mean);
    reorder(particles.identity);
    for (std::vector<double>* const companion : companions) reorder(*companion);
}

void NeighbourSearch::sort_boundary(const Particles& particles, const Cells& cells) {
    const std::size_t count = particles.first_fluid();
    boundary_start_.assign(cells.columns * cells.rows + 1, 0);
    cell_of_.resize(count), boundary_members_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        cell_of_[i] = static_cast<std::uint32_t>(cells.cell(particles.x[i], particles.z[i]));
        ++boundary_start_[cell_of_[i]];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& start : boundary_start_) {
        const std::uint32_t here = start;
        start = sum;
        sum += here;
    }
    for (std::size_t i = 0; i < count; ++i)
        boundary_members_[boundary_start_[cell_of_[i]]++] = static_cast<std::int32_t>(i);
    for (std::size_t c = boundary_start_.size() - 1; c > 0; --c) boundary_start_[c] = boundary_start_[c - 1];
    boundary_start_[0] = 0;
}

}  // namespace cmps
