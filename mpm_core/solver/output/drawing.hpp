#pragma once

#include <span>

#include "solver/body/body.hpp"
#include "solver/output/fields.hpp"

namespace granulaw {

/// Bodies as they are drawn, solver units, in the frame of the first one.
struct Drawing
{
  FieldFrame frame;                             ///< without time, overlap and force
  std::vector<std::array<int, 4>> cells;        ///< axisymmetric: corners of each material point's piece
  std::vector<std::array<int, 8>> solid_cells;  ///< three dimensions: corners of each cell
};

/// The bodies at the end of a step. Their plastic state is brought up to the displacements in a copy: a run
/// is the same whether anyone looks or not. A second body, which is kept mirrored, is drawn where it is.
Drawing draw(std::span<const Body> bodies);

}  // namespace granulaw
