#include "contact/curve.hpp"

#include <cstdio>

namespace granulaw {

namespace {

constexpr double big = 1e12;  // of a slope: its products stay finite

std::string number(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}
std::string range(double low, double high)
{
  return number(low) + " to " + number(high);
}

Fault outside(const std::string& name, double value, double low, double high)
{
  if (value >= low && value <= high) return {};  // NaN is not
  return {name + " is out of range", number(value), range(low, high)};
}

Fault wrong_values(const char* name, const std::vector<double>& values, std::size_t count, double low,
                   double high)
{
  std::string quoted = "'";
  quoted.append(name).append("'");
  if (values.size() != count)
    return {quoted + " has the wrong length", std::to_string(values.size()), std::to_string(count)};
  for (std::size_t k = 0; k < count; ++k)
    if (Fault f = outside(quoted + " at node " + std::to_string(k), values[k], low, high)) return f;
  return {};
}

Fault wrong_column(const char* name, const HermiteColumn& column, std::size_t count, double low, double high)
{
  if (Fault f = wrong_values(name, column.value, count, low, high)) return f;
  return wrong_values((std::string(name) + "_slope").c_str(), column.slope, count, -big, big);
}

/// `sign` 1: the column rises between nodes at x; -1: it falls.
Fault turns(const char* name, const HermiteColumn& column, const std::vector<double>& x, int sign)
{
  for (std::size_t k = 0; k + 1 < x.size(); ++k) {
    const double h = x[k + 1] - x[k];
    double c[4];
    hermite(c, sign * column.value[k], sign * column.value[k + 1], sign * h * column.slope[k],
            sign * h * column.slope[k + 1]);
    if (!(least_slope(c) >= -1e-9 * std::abs(column.value[k])))  // 1e-9: rounding
      return {std::string("'") + name + "' " + (sign > 0 ? "falls" : "rises") + " between nodes " +
              std::to_string(k) + " and " + std::to_string(k + 1)};
  }
  return {};
}

std::vector<double> even_nodes(std::size_t count, double end)
{
  std::vector<double> nodes(count);
  for (std::size_t k = 0; k < count; ++k)
    nodes[k] = end * static_cast<double>(k) / static_cast<double>(count - 1);
  return nodes;
}

/// Coefficients in t from 0 to `width` of the Hermite cubic between nodes k and k + 1, `length` apart.
void cubic_of(const HermiteColumn& column, std::size_t k, double length, double width, double (&c)[4])
{
  hermite(c, column.value[k], column.value[k + 1], length * column.slope[k], length * column.slope[k + 1]);
  double scale = 1;
  for (int power = 1; power < 4; ++power) c[power] *= scale /= width;
}

Fault curve_fault(const CurveTable& t)
{
  constexpr int most_octaves = 64;
  if (!(t.onset >= 1e-24)) return outside("'onset'", t.onset, 1e-24, std::numeric_limits<double>::infinity());
  if (Fault f = outside("'end'", t.end, 1e-24, 16)) return f;
  if (t.octaves < 0 || t.octaves > most_octaves) return outside("'octaves'", t.octaves, 0, most_octaves);
  if (!(t.node(0) < t.end))
    return {"'end' lies below the first node", number(t.end), "over " + number(t.node(0))};
  const std::vector<double> x = t.nodes(), yielding = t.yielding_nodes();
  const std::size_t count = x.size(), late = yielding.size();
  if (Fault f = wrong_column("force", t.force, count, 1e-40, 1e6)) return f;
  if (Fault f = wrong_column("radius", t.radius, count, 1e-20, 1e3)) return f;
  if (Fault f = wrong_column("kept", t.kept, late, 1e-9, 1)) return f;
  if (Fault f = wrong_column("span", t.span, late, 1e-6, 1)) return f;
  if (Fault f = wrong_column("hertz_share", t.hertz_share, late, 0, UnloadingShape::largest_hertz_share))
    return f;
  if (!t.unloading_radius.empty() && t.unloading_radius.size() != late)
    return {"'unloading_radius' has the wrong length", std::to_string(3 * t.unloading_radius.size()),
            std::to_string(3 * late)};
  for (const auto& row : t.unloading_radius)
    for (const double k : row)
      if (Fault f = outside("'unloading_radius'", k, UnloadingRadius::least, UnloadingRadius::most)) return f;
  // below its first node the curve is Hertz's: it starts as that; a fit may round
  if (const double ratio = t.force.value.front() / std::pow(x.front(), 1.5); !(std::abs(ratio - 1) <= 1e-3))
    return {"the force does not begin as Hertz's: 'force' at node 0 over it is out of range", number(ratio), "1"};
  if (Fault f = turns("force", t.force, x, 1)) return f;
  if (Fault f = turns("radius", t.radius, x, 1)) return f;
  if (Fault f = turns("kept", t.kept, yielding, -1)) return f;
  return turns("span", t.span, yielding, -1);
}

Fault axis_fault(const AxisTable& a)
{
  const bool rate = a.by == AxisTable::By::rate;
  const std::size_t speeds = a.reach.size(), levels = a.level.size(), shares = a.shares();
  if (speeds < 2 || speeds > 4096)
    return {"'reach' has an unusable number of nodes", std::to_string(speeds), "2 to 4096"};
  if (Fault f = outside("'speed_end'", a.speed_end, 1e-9, 1e6)) return f;
  if (Fault f = outside("'reference_radius'", a.reference_radius, rate ? 1e-20 : 0, rate ? 1e20 : 0))
    return f;
  if (Fault f = outside("'speed_begin'", a.speed_begin, rate ? 1e-9 : 0, rate ? 0.999 * a.speed_end : 0))
    return f;
  if (Fault f = wrong_column("reach", a.reach, speeds, 0, 16)) return f;
  if (a.reach.value.front() != 0) return {"'reach' does not begin at 0", number(a.reach.value.front())};
  if (Fault f = turns("reach", a.reach, even_nodes(speeds, a.speed_end), 1)) return f;
  const std::size_t least = rate ? 2 : 1;
  if (levels < least || levels > Axis::most_levels)
    return {"a velocity axis has an unusable number of levels", std::to_string(levels),
            std::to_string(least) + " to " + std::to_string(Axis::most_levels)};
  if (Fault f = wrong_values("level", a.level, levels, 1e-24, 16)) return f;
  for (std::size_t k = 0; k + 1 < levels; ++k)
    if (!(a.level[k + 1] >= Axis::least_gap * a.level[k]))
      return {"'level' does not rise after node " + std::to_string(k), number(a.level[k + 1]),
              "at least " + number(Axis::least_gap) + " times " + number(a.level[k])};
  if (std::log2(a.level.back() / a.level.front()) > 40)
    return {"'level' spans too much", range(a.level.front(), a.level.back()), "40 octaves"};
  if (!(std::abs(a.reach.value.back() / a.level.back() - 1) <= 1e-6))
    return {"the last 'level' is not the last 'reach'", number(a.level.back()), number(a.reach.value.back())};
  if (Fault f = wrong_values("kept", a.kept, levels, 1e-9, 1)) return f;
  if (Fault f = wrong_values("span", a.span, levels, 1e-6, 1)) return f;
  if (shares < 3 || shares * levels != a.force.size() || shares * levels > 65536)
    return {"a velocity axis has an unusable number of nodes a level", std::to_string(a.force.size()),
            "levels times 3 or more, up to 65536"};
  if (Fault f = outside("'share_end'", a.share_end, 1e-3, 1e3)) return f;
  if (Fault f = wrong_column("force", a.force, shares * levels, -0.9, 10)) return f;
  for (std::size_t k = 0; k < levels; ++k)
    if (const std::size_t last = (k + 1) * shares - 1; a.force.value[last] != 0 || a.force.slope[last] != 0)
      return {"'force' of level " + std::to_string(k) + " does not end at 0 with slope 0",
              number(a.force.value[last]) + ", slope " + number(a.force.slope[last])};
  return {};
}

}  // namespace

CurveTable::CurveTable(double onset_overlap, double end_overlap) : onset(onset_overlap), end(end_overlap)
{
  constexpr double hertz_below = 0x1p-40;
  while (node(0) > hertz_below) ++octaves;
}

std::vector<double> CurveTable::nodes() const
{
  std::vector<double> x{node(0)};
  for (std::size_t k = 1; x.back() < end; ++k) x.push_back(node(k));
  return x;
}

std::vector<double> CurveTable::yielding_nodes() const
{
  if (!yields()) return {};
  std::vector<double> x = nodes();
  x.erase(x.begin(), x.begin() + octaves * nodes_an_octave);
  return x;
}

Fault Curve::fault(const CurveTable& table, const AxisTable* axis)
{
  if (Fault f = curve_fault(table)) return f;
  if (!axis) return {};
  if (Fault f = axis_fault(*axis)) return f;
  // 5 %: so far the linear continuation is still within about a per cent
  if (axis->level.back() > 1.05 * table.end)
    return {"the velocity axis goes deeper than the curve: the last 'level'", number(axis->level.back()),
            "up to " + number(1.05 * table.end)};
  const Curve curve(table, *axis);
  const std::size_t columns = 8 * (axis->shares() - 1);
  for (const double latched : curve.examined_levels())
    for (std::size_t l = 1; l <= columns; ++l) {
      const double x = axis->share_end * static_cast<double>(l) / static_cast<double>(columns) * latched;
      const Loading now = curve.loading(x, latched);
      if (!(now.force > 0 && now.stiffness >= -1e-9 * now.force / x))  // 1e-9: rounding
        return {"with the velocity axis the loading force falls at overlap " + number(x) +
                " after an impact to " + number(latched)};
      if (!(curve.work(x, latched) > 0))
        return {"with the velocity axis the work of loading is not positive at overlap " + number(x) +
                " after an impact to " + number(latched)};
    }
  return {};
}

Curve::Curve(CurveTable table, std::optional<AxisTable> axis)
    : per_unit_(1.0 / table.unit()),
      unit_(table.unit()),
      end_(table.end),
      table_(std::move(table)),
      axis_table_(std::move(axis))
{
  const std::size_t intervals = table_.force.size() - 1;
  const double first = table_.node(0);
  first_bits_ = static_cast<std::uint64_t>(1023 - table_.octaves) << 52;
  places_ = place(end_ * per_unit_) + 1;
  first_ = {table_.force.value[0], 1.5 * table_.force.value[0] / first, table_.radius.value[0]};
  loading_.resize(intervals), work_.resize(intervals);
  double c[4], work = first_.force * first / 2.5;
  for (std::size_t k = 0; k < intervals; ++k) {
    const double length = table_.node(k + 1) - table_.node(k), width = length / unit_;
    cubic_of(table_.force, k, length, width, c);
    loading_[k].set(0, c);
    work_[k] = work;
    work += length * (0.5 * (table_.force.value[k] + table_.force.value[k + 1]) +
                      length / 12.0 * (table_.force.slope[k] - table_.force.slope[k + 1]));
    cubic_of(table_.radius, k, length, width, c);
    loading_[k].set(1, c);
  }
  const double at_end = end_ * per_unit_;
  const Place p{loading_.back(), at_end - table_.node(intervals - 1) * per_unit_, intervals - 1};
  const Two now = p.loading.both(p.t);
  last_ = {now[0], p.loading.first_slope(p.t) * per_unit_, now[1]};
  // an end that is a node begins an interval
  const double last_width = (table_.node(intervals) - table_.node(intervals - 1)) * per_unit_;
  loading_.push_back(loading_.back().continued(last_width)), work_.push_back(work);

  if (table_.yields()) {
    yields_from_ = table_.onset;
    first_turn_ = static_cast<std::size_t>(table_.octaves) * CurveTable::nodes_an_octave;
    std::vector<double> x = table_.yielding_nodes();
    HermiteColumn kept = table_.kept, span = table_.span;
    if (axis_table_) {  // the axis changes logarithms: they are what is interpolated
      for (HermiteColumn* column : {&kept, &span}) {
        for (std::size_t k = 0; k < x.size(); ++k) {
          column->slope[k] = -column->slope[k] / column->value[k];
          column->value[k] = -std::log(column->value[k]);
        }
        make_rise(*column, x);
      }
    }
    turns_.resize(x.size() - 1);
    for (std::size_t k = 0; k < turns_.size(); ++k) {
      const double length = x[k + 1] - x[k], width = length / unit_;
      cubic_of(kept, k, length, width, c), turns_[k].losses.set(0, c);
      cubic_of(span, k, length, width, c), turns_[k].losses.set(1, c);
      cubic_of(table_.hertz_share, k, length, width, turns_[k].share);
    }
    const Turn& end = turns_.back();
    turns_.push_back(
        {end.losses.continued(last_width), {cubic(end.share, last_width), cubic_slope(end.share, last_width), 0, 0}});
  }
  if (axis_table_) add_axis();
}

/// M of W = W_slow (1 + M) at the axis's nodes, by Simpson's rule over sqrt(x) in each of its intervals, and
/// the levels' losses beyond the slow press's.
void Curve::add_axis()
{
  const AxisTable& a = *axis_table_;
  const std::size_t nodes = a.shares();
  const double h = a.share_spacing();
  HermiteColumn mean;
  std::vector<double> kept, span;
  for (std::size_t k = 0; k < a.level.size(); ++k) {
    const double latched = a.level[k];
    double extra = 0;  // work beyond the slow press's
    for (std::size_t l = 0; l < nodes; ++l) {
      const std::size_t at = k * nodes + l;
      if (l == 0) {  // F is Hertz's times 1 + A + A' x/X
        mean.add(a.force.value[at], 5.0 / 7.0 * a.force.slope[at]);
        continue;
      }
      double c[4];
      hermite(c, a.force.value[at - 1], a.force.value[at], h * a.force.slope[at - 1], h * a.force.slope[at]);
      constexpr int pieces = 32;  // intervals of the curve lie within: 1e-6 of the work is left
      const double from = std::sqrt(static_cast<double>(l - 1)), to = std::sqrt(static_cast<double>(l));
      const auto extra_force = [&](double root) {
        const double place = root * root;
        return 2.0 * root * h * latched * force(place * h * latched) *
               cubic(c, place - static_cast<double>(l - 1));
      };
      for (int n = 0; n < pieces; ++n) {
        const double s = from + (to - from) * n / pieces, e = from + (to - from) * (n + 1) / pieces;
        extra += (e - s) / 6.0 * (extra_force(s) + 4.0 * extra_force(0.5 * (s + e)) + extra_force(e));
      }
      const double x = h * static_cast<double>(l) * latched, slow = slow_work(x), m = extra / slow;
      mean.add(m, latched * force(x) * (a.force.value[at] - m) / slow);
    }
    const double x = std::min(latched, end_);
    Two slow{};
    if (x > yields_from_) {
      const Place p = at(x * per_unit_);
      slow = turns_[p.k - first_turn_].losses.both(p.t);
    }
    kept.push_back(-std::log(a.kept[k]) - slow[0]);
    span.push_back(-std::log(a.span[k]) - slow[1]);
  }
  axis_ = Axis(a, mean, kept, span);
  corrected_from_ = Axis::negligible;
}

std::size_t Curve::bytes() const
{
  return loading_.size() * sizeof(CubicPair) + work_.size() * sizeof(double) + turns_.size() * sizeof(Turn) +
         axis_.bytes();
}

Curve::Loading Curve::far_loading(double x, double latched) const
{
  Loading slow;
  if (x > end_)
    slow = {last_.force + last_.stiffness * (x - end_), last_.stiffness, last_.radius * std::sqrt(x / end_)};
  else {
    const double ratio = x / table_.node(0), root = std::sqrt(ratio);
    slow = {first_.force * ratio * root, first_.stiffness * root, first_.radius * root};
  }
  return corrected(slow, x, latched);
}

UnloadingRadius Curve::unloading_radius(double x_max) const
{
  UnloadingRadius at_top;
  if (!(x_max > yields_from_) || table_.unloading_radius.empty()) return at_top;
  const double r = std::min(end_, x_max) * per_unit_;
  const Place p = at(r);
  const std::size_t row = p.k - first_turn_, next = std::min(row + 1, table_.unloading_radius.size() - 1);
  const double octave = std::bit_cast<double>(std::bit_cast<std::uint64_t>(r) >> 52 << 52),
               place = CurveTable::nodes_an_octave * p.t / octave;
  for (std::size_t j = 0; j < 3; ++j) {
    const double below = table_.unloading_radius[row][j];
    at_top.k[j] = below + place * (table_.unloading_radius[next][j] - below);
  }
  return at_top;
}

double Curve::slow_work(double x) const
{
  if (const double r = x * per_unit_; in_table(r)) return work_at(at(r));
  if (!(x > end_)) {
    const double first = table_.node(0), ratio = x / first;
    return first_.force * first / 2.5 * ratio * ratio * std::sqrt(ratio);
  }
  const double beyond = x - end_;
  return work_at(at(end_ * per_unit_)) + beyond * (last_.force + 0.5 * beyond * last_.stiffness);
}

Curve::Top Curve::other_top(double x_max, double latched) const
{
  const double x = std::min(end_, x_max);      // of no number: the end
  if (!(x_max > yields_from_)) [[unlikely]] {  // it unloads as it loads: F_m n is the stiffness
    const Loading now = loading(x, latched);
    const double all = work(x, latched), n = x * now.stiffness / now.force;
    return {now.force, all, 1.0, 1.0, UnloadingShape::hertz_share_of(all / (now.force * x), n)};
  }
  const Place p = at(x * per_unit_);
  double force = p.loading.first(p.t), put_in = work_at(p);
  if (x_max > end_) [[unlikely]] {
    const double beyond = x_max - end_;
    put_in += beyond * (force + 0.5 * beyond * last_.stiffness);
    force += beyond * last_.stiffness;
  }
  const Turn& turn = turns_[p.k - first_turn_];
  Two losses = turn.losses.both(p.t);
  const double share = share_of(turn, p.t);
  if (corrected_from_ > 1.0) return {force, put_in, losses[0], losses[1], share};  // no axis

  double least = 0.0;
  if (latched > corrected_from_) {
    Axis::Effect effect = axis_.effect(x_max, latched);
    if (const double share_end = axis_.share_end() * latched; x_max > share_end) [[unlikely]]
      effect.mean *= slow_work(share_end) / put_in;
    force *= 1.0 + effect.force, put_in *= 1.0 + effect.mean;
    least = least_loss;
    if (latched > yields_from_) {
      const Place at_latched = at(std::min(end_, latched) * per_unit_);
      const Two slow = turns_[at_latched.k - first_turn_].losses.both(at_latched.t);
      // Both vanish at the onset: their ratio is bounded.
      constexpr double most = 9.0, tiny = 1e-300;
      for (int which = 0; which < 2; ++which) {
        const double ratio = effect.losses[which] / std::max(slow[which], tiny);
        losses[which] += std::clamp(ratio, -1.0, most) * std::min(losses[which], std::max(slow[which], 0.0));
      }
    }
  }
  return {force, put_in, std::exp(-std::max(losses[0], least)), std::exp(-std::max(losses[1], 0.0)), share};
}

/// No unloading shape returns this work over this span.
Reversal Curve::reversal_with_other_span(double x_max, const Top& t)
{
  const auto mean_of = [&](double n) { return (5.5 + 0.2 * t.share - n) / 10.5; };
  const double least = mean_of(UnloadingShape::largest_exponent(t.share)),
               most = mean_of(UnloadingShape::least_exponent);
  const double returned = t.kept * t.work / (t.force * x_max);
  const double span = std::min(1.0, returned / std::clamp(returned / t.span, least, most)),
               mean = returned / span;
  double share = t.share;
  if (mean > most)  // not even over all of x: stiffer at small forces
    share = std::min(UnloadingShape::largest_hertz_share,
                     UnloadingShape::hertz_share_of(mean, UnloadingShape::least_exponent));
  const UnloadingShape shape{UnloadingShape::exponent_of(mean, share), share};
  return {x_max, 1.0 / (span * x_max), {t.force * share, t.force * shape.second(), t.force * shape.third()}};
}

double Curve::work(double x, double latched) const
{
  const double slow = slow_work(x);
  if (!(latched > corrected_from_)) return slow;
  double mean = axis_.effect(x, latched).mean;
  if (const double share_end = axis_.share_end() * latched; x > share_end)
    mean *= slow_work(share_end) / slow;
  return slow * (1.0 + mean);
}

double Curve::lost(double x, double latched) const
{
  if (!(x > yields_from_)) return 0.0;
  const Top t = top(x, latched);
  return t.work * (1.0 - t.kept);
}

double Curve::reach(double v) const
{
  if (!axis_table_ || !(v > 0)) return 0.0;
  const AxisTable& a = *axis_table_;
  if (v >= a.speed_end) return a.reach.value.back();
  const double intervals = static_cast<double>(a.reach.size() - 1), h = a.speed_end / intervals;
  const double position = std::max(v, a.speed_begin) / h;
  const auto j = std::min(static_cast<std::size_t>(position), a.reach.size() - 2);
  double c[4];
  hermite(c, a.reach.value[j], a.reach.value[j + 1], h * a.reach.slope[j], h * a.reach.slope[j + 1]);
  return std::clamp(cubic(c, position - static_cast<double>(j)), 0.0, a.reach.value.back());
}

std::vector<double> Curve::examined_levels() const
{
  std::vector<double> overlaps;
  if (!axis_table_) return overlaps;
  const std::vector<double>& level = axis_table_->level;
  if (axis_table_->by == AxisTable::By::inertia) overlaps.push_back(0.5 * level.front());
  for (std::size_t k = 0; k < level.size(); ++k) {
    overlaps.push_back(level[k]);
    if (k + 1 < level.size()) overlaps.push_back(0.5 * (level[k] + level[k + 1]));
  }
  return overlaps;
}

}  // namespace granulaw
