#include "solver/contact/inverse_motion.hpp"

#include <algorithm>

#include "solver/grid/cell_cutter.hpp"

namespace granulaw {

SphereGridTables::SphereGridTables(const Reference& reference, double radius)
{
  constexpr int buckets_a_cell = 4;
  const SplineCells& cells = reference.cells;
  const std::array<int, 3> stride = cells.strides();
  grid_.radius = radius;
  for (int d = 0; d < 3; ++d) {
    const SplineAxis& axis = cells.axes[d];
    lines_[d] = axis.lines();
    for (int c = 0; c < axis.cells(); ++c) {
      const CellSplines splines(axis, c);
      CellPolynomials& cell = cells_[d].emplace_back(CellPolynomials{splines.middle, 1 / splines.edge, {}});
      std::copy_n(&splines.n[0][0], 9, &cell.n[0][0]);
    }
    const int buckets = buckets_a_cell * axis.cells();
    const double low = lines_[d].front(), per_bucket = buckets / (lines_[d].back() - low);
    for (int b = 0; b < buckets; ++b) first_[d].push_back(axis.cell(low + b / per_bucket));
    grid_.axis[d] = {
        low, per_bucket, buckets, axis.cells(), first_[d].data(), lines_[d].data(), cells_[d].data()};
    grid_.stride[d] = 4 * stride[d];
  }
  for (int k = 0; k < cell_nodes; ++k)
    grid_.offset[k] = k / 9 * grid_.stride[0] + k / 3 % 3 * grid_.stride[1] + k % 3 * grid_.stride[2];
  std::array<int, 3> count{};
  for (int d = 0; d < 3; ++d) count[d] = cells.axes[d].cells();
  const auto number = [&](const std::array<int, 3>& c) {
    return (std::size_t(c[2]) * count[1] + c[1]) * count[0] + c[0];
  };
  const auto holder = [](const SpatialCell& c) {
    return SphereGrid::Holder{{c.column[0], c.column[1], c.column[2]}, 4 * c.node};
  };
  holders_.assign(std::size_t(count[0]) * count[1] * count[2], {{}, -1});
  std::vector<const SpatialCell*> rim;  // the nearest cell with a part of the body is cut
  for (const SpatialCell& c : cells.cells) {
    holders_[number(c.column)] = holder(c);
    if (c.cut >= 0) rim.push_back(&c);
  }
  for (int z = 0; z < count[2]; ++z)
    for (int y = 0; y < count[1]; ++y)
      for (int x = 0; x < count[0]; ++x) {
        SphereGrid::Holder& own = holders_[number({x, y, z})];
        if (own.lowest >= 0) continue;
        const auto away = [&](const SpatialCell* c) {
          const int i = c->column[0] - x, j = c->column[1] - y, k = c->column[2] - z;
          return i * i + j * j + k * k;
        };
        own = holder(**std::min_element(rim.begin(), rim.end(),
                                        [&](const auto* a, const auto* b) { return away(a) < away(b); }));
      }
  grid_.holder = holders_.data();
}

}  // namespace granulaw
