#include "law/fast_axis.hpp"

namespace granulaw {

FastAxis::FastAxis(const InertiaAxis& axis)
{
  const InertiaAxis::Table& table = axis.table();
  const std::size_t slices = table.slices, nodes = table.ratio_nodes();
  const double h = table.ratio_end / static_cast<double>(nodes - 1);
  rows_ = static_cast<double>(slices);
  per_slice_ = rows_ / axis.overlap_end();
  per_spacing_ = 1.0 / h;
  columns_ = static_cast<double>(nodes - 1);
  cells_a_slice_ = static_cast<int>(nodes);
  cells_.assign((slices + 1) * nodes, Cell{});

  const auto lay_out = [&](Function Cell::*function, const std::vector<double>& value,
                           const std::vector<double>& slope) {
    // slice 0 corrects nothing: it stays 0
    for (std::size_t k = 0; k < slices; ++k) {
      for (std::size_t l = 0; l < nodes; ++l) {
        const std::size_t at = k * nodes + l;
        double(&c)[4] = (cells_[at + nodes].*function).low;
        if (l + 1 < nodes)
          hermite(c, value[at], value[at + 1], h * slope[at], h * slope[at + 1]);
        else
          c[0] = value[at];
        Function& below = cells_[at].*function;
        for (int power = 0; power < 4; ++power) below.rise[power] = c[power] - below.low[power];
      }
    }
  };
  lay_out(&Cell::force, table.force_correction, table.force_correction_slope);
  lay_out(&Cell::residual, table.residual_correction, table.residual_correction_slope);
  lay_out(&Cell::exponent, table.exponent_correction, table.exponent_correction_slope);
}

}  // namespace granulaw
