#include "law/velocity_axis.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "law/table_checks.hpp"

namespace granulaw {

namespace {

constexpr double big = 1e12;  // of a slope: its products stay finite

void check_number(double value, double low, double high, const std::string& where, const char* name)
{
  if (!(value >= low && value <= high))
    fail(where, fmt::format("'{}' is out of range", name), fmt::format("{:.6g}", value),
         fmt::format("{:.6g} to {:.6g}", low, high));
}

/// The Hermite cubic of X over the interval after node j, in t.
void overlap_cubic(const VelocityAxis::Table& table, std::size_t j, double (&c)[4])
{
  const double h = table.speed_end / static_cast<double>(table.impact_overlap.size() - 1);
  hermite(c, table.impact_overlap[j], table.impact_overlap[j + 1], h * table.impact_overlap_slope[j],
          h * table.impact_overlap_slope[j + 1]);
}

/// X at 0 < v < speed_end.
double overlap_at(const VelocityAxis::Table& table, double v)
{
  const double intervals = static_cast<double>(table.impact_overlap.size() - 1);
  const double position = std::min(v / table.speed_end * intervals, intervals);
  const auto j = std::min(static_cast<std::size_t>(position), table.impact_overlap.size() - 2);
  double c[4];
  overlap_cubic(table, j, c);
  return std::clamp(cubic(c, position - static_cast<double>(j)), 0.0, table.impact_overlap.back());
}

void check_speeds(const VelocityAxis::Table& table, const std::string& where)
{
  const std::size_t count = table.impact_overlap.size();
  if (count < 2 || count > 4096)
    fail(where, "'impact_overlap' has an unusable number of nodes", std::to_string(count), "2 to 4096");
  check_number(table.speed_end, 1e-9, 1e6, where, "speed_end");
  const bool rate = table.kind == VelocityAxis::Kind::rate;
  check_number(table.reference_radius, rate ? 1e-20 : 0, rate ? 1e20 : 0, where, "reference_radius");
  check_number(table.speed_begin, rate ? 1e-9 : 0, rate ? 0.999 * table.speed_end : 0, where, "speed_begin");
  check_values(table.impact_overlap, count, 0, 16, where, "impact_overlap");
  check_values(table.impact_overlap_slope, count, 0, big, where, "impact_overlap_slope");
  if (table.impact_overlap.front() != 0)
    fail(where, "'impact_overlap' does not begin at 0", fmt::format("{:.6g}", table.impact_overlap.front()));
  const double end = table.impact_overlap.back();
  check_number(end, 1e-24, 16, where, "impact_overlap at the last node");
  for (std::size_t j = 0; j + 1 < count; ++j) {
    double c[4];
    overlap_cubic(table, j, c);
    // rising at its ends, a cubic falls between them only where its slope has a minimum below 0 there
    const double vertex = c[3] > 0 ? -c[2] / (3.0 * c[3]) : 0.0;
    const double least = vertex > 0 && vertex < 1 ? cubic_slope(c, vertex) : 0.0;
    if (table.impact_overlap[j + 1] < table.impact_overlap[j] || least < -1e-9 * end)  // 1e-9: rounding
      fail(where, fmt::format("'impact_overlap' falls between nodes {} and {}", j, j + 1));
  }
}

void check_size(const VelocityAxis::Table& table, const std::string& where)
{
  const std::size_t levels = table.levels, nodes = table.ratio_nodes();
  const std::size_t least = table.kind == VelocityAxis::Kind::rate ? 2 : 1;
  if (levels < least || levels > 256)
    fail(where, "a velocity axis has an unusable number of impact levels ('slices')", std::to_string(levels),
         fmt::format("{} to 256", least));
  if (table.first_levels < 1 || table.first_levels > levels)
    fail(where, "a velocity axis has an unusable number of levels in its first spacing ('first_slices')",
         std::to_string(table.first_levels), fmt::format("1 to {}", levels));
  if (nodes < 2 || levels * nodes > 65536)
    fail(where, "a velocity axis has an unusable number of nodes an impact level", std::to_string(nodes),
         fmt::format("2 to {}", 65536 / levels));
  check_number(table.ratio_end, 1e-3, 1e3, where, "ratio_end");
}

void check_ends(const VelocityAxis::Table& table, const std::string& where)
{
  for (std::size_t k = 1; k <= table.levels; ++k)
    if (const std::size_t last = k * table.ratio_nodes() - 1;
        table.force_correction[last] != 0 || table.force_correction_slope[last] != 0)
      fail(where, fmt::format("'force_correction' of level {} does not end at 0 with slope 0", k),
           fmt::format("{:.6g}, slope {:.6g}", table.force_correction[last],
                       table.force_correction_slope[last]));
}

}  // namespace

VelocityAxis::VelocityAxis(const Table& table, const std::string& where) : table_(table)
{
  check_speeds(table, where);
  check_size(table, where);
  overlap_end_ = table.impact_overlap.back();
  place_levels(where);
  lay_out_cells(where);
  check_ends(table, where);
}

/// Where the levels lie, and what finds a place among them.
void VelocityAxis::place_levels(const std::string& where)
{
  scale_ = ImpactLevels::from_standstill(table_.levels, table_.first_levels, overlap_end_);
  if (table_.kind == Kind::rate) {
    const double first = overlap_at(table_, table_.speed_begin);
    check_number(first, 1e-24, 0.999 * overlap_end_, where, "impact_overlap at speed_begin");
    scale_ = ImpactLevels::by_octaves(table_.levels, first, overlap_end_);
  }
  const std::size_t nodes = table_.ratio_nodes();
  columns_ = static_cast<double>(nodes - 1);
  per_spacing_ = columns_ / table_.ratio_end;
  cells_a_level_ = static_cast<int>(nodes);
  last_row_ = static_cast<int>(table_.levels) - 1;
}

/// The cubics of all intervals. Their bounds hold for every X: a mean of two levels lies between them.
void VelocityAxis::lay_out_cells(const std::string& where)
{
  struct Function
  {
    const char* name;
    const std::vector<double>&value, &slope;
    double low, high, low_between, high_between;
    double (Cell::*cubic)[4];
  };
  const Function functions[] = {{"force_correction", table_.force_correction, table_.force_correction_slope,
                                 -0.9, 10, -0.95, 20, &Cell::force},
                                {"residual_correction", table_.residual_correction,
                                 table_.residual_correction_slope, -1, 1, -2, 2, &Cell::residual},
                                {"exponent_correction", table_.exponent_correction,
                                 table_.exponent_correction_slope, -10, 10, -20, 20, &Cell::exponent}};
  const std::size_t levels = table_.levels, nodes = table_.ratio_nodes();
  const double h = 1.0 / per_spacing_;
  cells_.assign((levels + 1) * nodes, Cell{});
  for (const Function& f : functions) {
    check_values(f.value, levels * nodes, f.low, f.high, where, f.name);
    check_values(f.slope, levels * nodes, -big, big, where, fmt::format("{}_slope", f.name));
    for (std::size_t k = 0; k < levels; ++k) {
      for (std::size_t l = 0; l + 1 < nodes; ++l) {
        const std::size_t at = k * nodes + l;
        double(&c)[4] = cells_[(k + 1) * nodes + l].*f.cubic;
        hermite(c, f.value[at], f.value[at + 1], h * f.slope[at], h * f.slope[at + 1]);
        check_between(c, f.low_between, f.high_between, where, f.name, at);
      }
      (cells_[(k + 1) * nodes + nodes - 1].*f.cubic)[0] = f.value[k * nodes + nodes - 1];
    }
  }
}

double VelocityAxis::impact_overlap(double v) const
{
  if (!(v > 0)) return 0.0;
  if (v >= table_.speed_end) return overlap_end_;
  return overlap_at(table_, std::max(v, table_.speed_begin));
}

std::vector<double> VelocityAxis::examined_overlaps() const
{
  std::vector<double> overlaps;
  const auto halves = static_cast<int>(2 * table_.levels);
  for (int half = static_cast<int>(2 * scale_.first_row()); half <= halves; ++half)
    if (half > 0) overlaps.push_back(scale_.overlap(0.5 * half));
  return overlaps;
}

}  // namespace granulaw
