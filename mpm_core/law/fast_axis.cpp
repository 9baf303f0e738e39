#include "law/fast_axis.hpp"

namespace granulaw {

FastAxis::FastAxis(const VelocityAxis& axis)
{
  const VelocityAxis::Table& table = axis.table();
  const std::size_t levels = table.levels, nodes = table.ratio_nodes();
  const double h = table.ratio_end / static_cast<double>(nodes - 1);
  scale_ = axis.scale();
  per_spacing_ = 1.0 / h;
  columns_ = static_cast<double>(nodes - 1);
  cells_a_level_ = static_cast<int>(nodes);
  cells_.assign((levels + 1) * nodes, Cell{});

  // coefficients of one function over interval l of level k; level 0 corrects nothing
  const auto cubic_of = [&](const std::vector<double>& value, const std::vector<double>& slope, std::size_t k,
                            std::size_t l, double(&c)[4]) {
    std::fill_n(c, 4, 0.0);
    if (k == 0) return;
    const std::size_t at = (k - 1) * nodes + l;
    if (l + 1 < nodes)
      hermite(c, value[at], value[at + 1], h * slope[at], h * slope[at + 1]);
    else
      c[0] = value[at];
  };
  struct Function
  {
    const std::vector<double>&value, &slope;
    CubicPair Cell::*low, Cell::*rise;
    int low_place, rise_place;
  };
  const Function functions[] = {
      {table.force_correction, table.force_correction_slope, &Cell::force, &Cell::force, 0, 1},
      {table.residual_correction, table.residual_correction_slope, &Cell::low, &Cell::rise, 0, 0},
      {table.exponent_correction, table.exponent_correction_slope, &Cell::low, &Cell::rise, 1, 1}};
  for (const Function& f : functions)
    for (std::size_t k = 0; k <= levels; ++k)
      for (std::size_t l = 0; l < nodes; ++l) {
        double low[4], rise[4];
        cubic_of(f.value, f.slope, k, l, low);
        cubic_of(f.value, f.slope, std::min(k + 1, levels), l, rise);
        for (int power = 0; power < 4; ++power) rise[power] -= low[power];
        Cell& cell = cells_[k * nodes + l];
        (cell.*f.low).set(f.low_place, low);
        (cell.*f.rise).set(f.rise_place, rise);
      }
}

}  // namespace granulaw
