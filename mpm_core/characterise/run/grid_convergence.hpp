#pragma once

#include "solver/runs.hpp"

namespace granulaw {

/// What the cells of a run cost, relative (0.01 is 1 %).
struct DiscretisationError
{
  double force = 0;        ///< of the loading force
  double restitution = 0;  ///< of e
};

/// Discretisation error of the finer of two runs that differ in their cells alone: the grid convergence index
/// (Roache, J. Fluids Eng. 116, 1994, eq. 5),
///     u = 1.25 |f_coarse/f_fine - 1|/(r^p - 1),    r the ratio of their cells, p = 1.65 the observed order.
/// Of the force f is a smooth fit of ln F over ln delta (TreatedLoading), and the largest change between 0.4
/// and 1 of the largest overlap counts: contact-edge grid noise and the ringing of an impact are in no fit,
/// and two curves do not agree by chance, as two peaks do. Two values of e may; so u of e is at least u of
/// the force. The order: 17, 24 and 48 cells, 25 impacts and presses, E*/Y 30 to 2000 (docs/decisions.md).
/// Infinite where thin layers give both runs the same grid. Throws Error where the loading of a run has too
/// few samples.
DiscretisationError grid_convergence(const RunResult& fine, const RunResult& coarse);

/// The index of any quantity: `change` is |f_coarse/f_fine - 1|, `cell_ratio` that of the cells, over 1.
double convergence_index(double change, double cell_ratio);

}  // namespace granulaw
