/// What is carried from step to step.
#pragma once

#include "boussinesq/cell_array.hpp"
#include "boussinesq/grid.hpp"

namespace boussinesq {

/// Conserved quantities of every cell, padded.
struct WaveState {
    CellArray depth;      ///< total water depth h, m
    CellArray discharge;  ///< h u, m2/s

    explicit WaveState(const Grid& grid) : depth(grid.padded(), 0.0), discharge(grid.padded(), 0.0) {}
};

/// What happens at an end of the flume.
enum class End {
    wall,  ///< impermeable: mirrored depth, odd discharge
    open   ///< long waves leave: the incoming invariant u -+ 2 sqrt(g h) is that of still water
};

/// The numbers the equations need; everything else is arrays.
struct FlowParameters {
    double spacing;           ///< m
    double alpha = 1.153;     ///< dispersion constant (Bonneton et al. 2011); 1: classical Serre-Green-Naghdi
    double dry_depth = 1e-5;  ///< cells below it count as dry, m
    double discharge_scale = 1e-3;  ///< size of a change of discharge that is no jump to WENO, m2/s
    double elevation_scale = 1e-3;  ///< size of a change of elevation that is no jump to WENO, m
    End offshore = End::wall;
    End shoreward = End::wall;
};

}  // namespace boussinesq
