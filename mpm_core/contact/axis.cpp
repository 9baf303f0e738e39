#include "contact/axis.hpp"

namespace granulaw {

Axis::Axis(const AxisTable& table, const HermiteColumn& mean, const std::vector<double>& kept,
           const std::vector<double>& span)
    : end_(table.level.back()), share_end_(table.share_end)
{
  const std::size_t count = table.level.size(), nodes = table.shares();
  const double h = table.share_spacing();
  per_spacing_ = 1.0 / h;
  columns_ = static_cast<double>(nodes - 1);
  cells_a_level_ = static_cast<int>(nodes);

  // of no speed: nothing; of a rate, which has no slow press: the first level
  const bool rate = table.by == AxisTable::By::rate;
  levels_.resize(count + 1);
  for (std::size_t k = 0; k <= count; ++k) {
    if (k > 0) levels_[k].x = table.level[k - 1];
    if (k > 0 || rate) levels_[k].losses = Two{kept[k ? k - 1 : 0], span[k ? k - 1 : 0]};
  }
  for (std::size_t k = 0; k < count; ++k) {
    levels_[k].next = levels_[k + 1].x;
    levels_[k].per_gap = 1.0 / (levels_[k + 1].x - levels_[k].x);
    levels_[k].rise = levels_[k + 1].losses - levels_[k].losses;
  }

  const auto bin_of = [](double x) { return std::bit_cast<std::uint64_t>(x) >> shift; };
  first_bin_ = bin_of(table.level.front());
  rows_.resize(bin_of(end_) - first_bin_ + 1);
  for (std::size_t bin = 0, k = 0; bin < rows_.size(); ++bin) {
    const double begin = std::bit_cast<double>((first_bin_ + bin) << shift);
    while (k < count && levels_[k + 1].x <= begin) ++k;
    rows_[bin] = static_cast<std::uint8_t>(k);
  }

  const auto cubic_of = [&](const HermiteColumn& column, std::size_t k, std::size_t l, double(&c)[4]) {
    std::fill_n(c, 4, 0.0);
    if (k == 0 && !rate) return;
    const std::size_t at = (k ? k - 1 : 0) * nodes + l;
    if (l + 1 < nodes)
      hermite(c, column.value[at], column.value[at + 1], h * column.slope[at], h * column.slope[at + 1]);
    else
      c[0] = column.value[at];
  };
  cells_.resize((count + 1) * nodes);
  for (std::size_t k = 0; k <= count; ++k)
    for (std::size_t l = 0; l < nodes; ++l)
      for (const auto& [column, pair] : {std::pair{&table.force, &Cell::force}, {&mean, &Cell::mean}}) {
        double low[4], rise[4];
        cubic_of(*column, k, l, low), cubic_of(*column, std::min(k + 1, count), l, rise);
        for (int power = 0; power < 4; ++power) rise[power] -= low[power];
        (cells_[k * nodes + l].*pair).set(0, low), (cells_[k * nodes + l].*pair).set(1, rise);
      }
}

}  // namespace granulaw
