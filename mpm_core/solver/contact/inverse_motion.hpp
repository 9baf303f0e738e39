#pragma once

#include <memory>
#include <vector>

#include "solver/body/body.hpp"
#include "solver/contact/rows.hpp"

namespace granulaw {

/// The reference grid of a sphere about its origin, for the inverse of its motion: the polynomials of every
/// cell, and for cells without a part of the body the nearest that has one. Shared by bodies of one
/// reference.
class SphereGridTables
{
 public:
  SphereGridTables(const Reference& reference, double radius);
  SphereGridTables(const SphereGridTables&) = delete;
  const SphereGrid& grid() const { return grid_; }

 private:
  std::array<std::vector<CellPolynomials>, 3> cells_;
  std::array<std::vector<int>, 3> first_;
  std::array<std::vector<double>, 3> lines_;
  std::vector<SphereGrid::Holder> holders_;
  SphereGrid grid_{};
};

}  // namespace granulaw
