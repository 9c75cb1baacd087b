/// Envelope of the surface over the last waves, and how far the water runs up.
#pragma once

#include <vector>

#include "boussinesq/simulation.hpp"
#include "common/data_file.hpp"

namespace boussinesq {

/// Highest, lowest and mean surface of every cell from `begin` (s) on.
class Envelope {
 public:
    Envelope(const Grid& grid, double begin)
        : begin_(begin), highest_(grid.cells), lowest_(grid.cells), sum_(grid.cells) {}
    void look(const Simulation& simulation);
    bool is_empty() const { return duration_ <= 0.0; }
    /// /x, /highest_surface, /lowest_surface, /mean_surface, /wave_height and the interval; for envelope.h5.
    common::DataFile file(const Simulation& simulation) const;
    void save(common::DataFile& state) const;
    void restore(const common::DataFile& state);

 private:
    double begin_, duration_ = 0;
    std::vector<double> highest_, lowest_, sum_;
};

/// The waterline of a beach: followed from step to step.
class Waterline {
 public:
    /// Water deeper than `film` (m) counts.
    Waterline(const Grid& grid, double film) : film_(film), last_wet_(grid.cells - 1) {}
    void look(const Simulation& simulation);
    bool has_beach() const { return has_beach_; }
    double run_up = -1e30, run_up_time = 0;     ///< highest level reached, m; when, s
    double run_down = 1e30, run_down_time = 0;  ///< lowest waterline after the first run-up, m
    double farthest = 0;                        ///< x of the highest waterline, m
    void save(common::DataFile& state) const;
    void restore(const common::DataFile& state);

 private:
    double film_;
    std::size_t last_wet_;
    bool has_beach_ = false;
};

}  // namespace boussinesq
