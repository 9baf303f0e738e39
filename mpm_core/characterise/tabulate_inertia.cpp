#include <fmt/format.h>

#include <algorithm>
#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

#include "base/error.hpp"
#include "base/gauss.hpp"
#include "characterise/interpolation.hpp"
#include "characterise/law_shape.hpp"
#include "law/cubic.hpp"

namespace granulaw {

namespace {

constexpr double speed_spacing = 0.02;    // of the nodes of X(v)
constexpr double slice_spacing = 0.0125;  // of X, about, beyond the first
constexpr double slices_an_octave = 3;    // of a rate axis
constexpr std::size_t first_slices = 3;   // within the first spacing
constexpr double first_told = 1.5;       // X of the first slice over the onset's overlap: nearer, keeping the
                                         // law admissible (raise_exponents) takes more than inertia does
constexpr double soft = 2;               // times the onset: less is the first spacing of a soft body
constexpr double share_spacing = 0.05;   // of xi = x/X
constexpr double usual_ratio_end = 1.5;  // xi where the force is the press's again

/// y(x) = 0 by bracketing.
template <class F>
double root_of(const F& y, double low, double high)
{
  std::uintmax_t steps = 200;
  const auto [a, b] =
      boost::math::tools::toms748_solve(y, low, high, boost::math::tools::eps_tolerance<double>(48), steps);
  return 0.5 * (a + b);
}

/// The shape's table over speed: inertia, with the standstill before it, where it changes nothing; a rate,
/// over the logarithm of the speed, and below its first speed as there.
class Speeds
{
 public:
  Speeds(const LawShape& shape, const ContactCurve& slow, double energy_unit, InertiaAxis::Kind kind)
      : slow_(slow), energy_unit_(energy_unit), rate_(kind == InertiaAxis::Kind::rate)
  {
    const auto node = [&](double at, std::size_t source) {
      nodes_.push_back(at), sources_.push_back(source);
    };
    if (!rate_) {
      // Inertia goes as v^2: even in v, so the first speeds stand on the other side of the standstill, too.
      for (std::size_t j = std::min<std::size_t>(2, shape.inertia.size()); j-- > 0;)
        node(-shape.inertia[j].speed, j);
      node(0.0, standstill);
    }
    for (std::size_t j = 0; j < shape.inertia.size(); ++j) {
      const LawShape::Inertia& i = shape.inertia[j];
      node(rate_ ? std::log(i.speed) : i.speed, j);
      log_reach_.push_back(std::log(i.speed * std::exp(i.reach) / slow_reach(i.speed)));
    }
  }

  /// X: the overlap/R that an impact reaches.
  double reach(double v) const
  {
    return v > 0 ? slow_reach(v) * std::exp(mix(v, [&](std::size_t j) { return log_reach_[j]; })) : 0.0;
  }
  /// A quantity of LawShape::Inertia at speed v; inertia: 0 at standstill.
  template <class Of>
  double mix(double v, const Of& of) const
  {
    const std::vector<double> weights = interpolation_weights(nodes_, rate_ ? std::log(v) : v);
    double sum = 0;
    for (std::size_t j = 0; j < weights.size(); ++j)
      if (weights[j] != 0 && sources_[j] != standstill) sum += weights[j] * of(sources_[j]);
    return sum;
  }

 private:
  /// Where the rate-free law's work is the kinetic energy.
  double slow_reach(double v) const
  {
    const double energy = energy_unit_ * v * v;
    return root_of([&](double x) { return slow_.work_loading(x) - energy; }, 0.0, 4.0);
  }

  const ContactCurve& slow_;
  double energy_unit_;  // kinetic energy at v = 1 over 4/3 E* R^3, the unit of ContactCurve's work
  bool rate_;
  static constexpr auto standstill = static_cast<std::size_t>(-1);  // where inertia changes nothing
  std::vector<double> nodes_;         // where speeds are known: v, of a rate ln v
  std::vector<std::size_t> sources_;  // and which of the shape's it is
  std::vector<double> log_reach_;     // by the shape's speeds
};

/// d/dx of values at equal spacings: three-point differences.
std::vector<double> slopes_of(const std::vector<double>& y, double h)
{
  const std::size_t last = y.size() - 1;
  std::vector<double> slope(y.size());
  slope[0] = (-3 * y[0] + 4 * y[1] - y[2]) / (2 * h);
  for (std::size_t k = 1; k < last; ++k) slope[k] = (y[k + 1] - y[k - 1]) / (2 * h);
  slope[last] = (3 * y[last] - 4 * y[last - 1] + y[last - 2]) / (2 * h);
  return slope;
}

/// Corrections of the force at the nodes, raised where it would fall: towards its turn an impact loses speed
/// and with it rate, and a law's loading force rises. At the turn it is the impact's peak: before, no more.
/// Returns the last node raised, 0: none.
std::size_t keep_rising(std::vector<double>& correction, const ContactCurve& slow, double x_reach)
{
  const auto turn = static_cast<std::size_t>(std::lround(1 / share_spacing));
  const double peak = (1 + correction[turn]) * slow.loading(x_reach).force;
  double most = 0;
  std::size_t last = 0;
  for (std::size_t l = 1; l < correction.size(); ++l) {
    const double press = slow.loading(share_spacing * static_cast<double>(l) * x_reach).force;
    constexpr double least_rise = 1e-4;  // a node, of the force
    if (l < turn) correction[l] = std::min(correction[l], peak / press - 1);
    const double force = (1 + correction[l]) * press, least = most * (1 + least_rise);
    if (force < least) correction[l] = least / press - 1, last = l;
    most = std::max(force, least);
  }
  return last;
}

/// Slopes of such corrections: three-point differences, but where the force ceases to rise no more than keeps
/// a cubic from passing above its nodes (Fritsch and Carlson, SIAM J. Numer. Anal. 17, 1980); none at the
/// end.
std::vector<double> rising_slopes(const std::vector<double>& correction, const ContactCurve& slow,
                                  double x_reach)
{
  std::vector<double> slopes = slopes_of(correction, share_spacing);
  const auto press = [&](std::size_t l) {
    return slow.loading(share_spacing * static_cast<double>(l) * x_reach);
  };
  const auto force = [&](std::size_t l) { return (1 + correction[l]) * press(l).force; };
  for (std::size_t l = 1; l + 1 < correction.size(); ++l) {
    const double below = force(l) - force(l - 1), above = force(l + 1) - force(l);
    const double most = 3 * std::max(0.0, std::min(below, above)) / share_spacing;
    const ContactCurve::Loading p = press(l);
    const double of_press = (1 + correction[l]) * p.stiffness * x_reach;  // dF/dxi = P dA/dxi + this
    slopes[l] = std::min(slopes[l], (most - of_press) / p.force);
  }
  slopes.back() = 0;
  return slopes;
}

/// What lies between the nodes, as the table has it.
class BetweenNodes
{
 public:
  BetweenNodes(std::vector<double> nodes, std::vector<double> slopes)
      : nodes_(std::move(nodes)), slopes_(std::move(slopes))
  {
  }
  double operator()(double xi) const
  {
    const double place = xi / share_spacing;
    const auto l = std::min(static_cast<std::size_t>(place), nodes_.size() - 2);
    double c[4];
    hermite(c, nodes_[l], nodes_[l + 1], share_spacing * slopes_[l], share_spacing * slopes_[l + 1]);
    return cubic(c, std::min(1.0, place - static_cast<double>(l)));
  }

 private:
  std::vector<double> nodes_, slopes_;
};

/// One slice: the corrections of a contact that latched X.
struct Slice
{
  std::vector<double> force, force_slope, residual, exponent;
  std::size_t last_raised = 0;  // node up to which a rate's force was kept rising
};

Slice slice_at(const Speeds& speeds, const LawShape& shape, const ContactCurve& slow, double x_reach,
               double slowest, double fastest, double ratio_end, bool rate)
{
  const double v =
      root_of([&](double speed) { return speeds.reach(speed) - x_reach; }, 0.999 * slowest, 1.001 * fastest);
  std::vector<double> log_force;
  for (std::size_t n = 0; n < LawShape::Inertia::shares; ++n)
    log_force.push_back(speeds.mix(v, [&](std::size_t j) { return shape.inertia[j].force[n]; }));
  // A cubic through few speeds may swing below what no impact can: to lose less than nothing.
  const double more_dissipation =
      1 + std::max(-1.0, speeds.mix(v, [&](std::size_t j) { return shape.inertia[j].dissipation; }));
  const double more_residual =
      1 + std::max(-1.0, speeds.mix(v, [&](std::size_t j) { return shape.inertia[j].residual; }));

  const boost::math::interpolators::cardinal_cubic_b_spline<double> within(
      log_force.begin(), log_force.end(), 0.0, 1.0 / (LawShape::Inertia::shares - 1));
  // From the impact's own overlap on: the cubic with its value and slope there, and none where it ends. Of a
  // rate the slope is that of the fall before the turn, which the law does not follow; and it ends as soon as
  // that of inertia, so that its peak, kept from falling, lasts no longer than until the press's force is as
  // large.
  const double told_end = rate ? usual_ratio_end : ratio_end;
  const double end = within(1.0), end_slope = rate ? 0.0 : within.prime(1.0) * (told_end - 1);
  const auto fitted = [&](double xi) {
    if (xi >= told_end) return 0.0;
    if (xi <= 1) return std::expm1(within(xi));
    const double t = (xi - 1) / (told_end - 1);
    return std::expm1((1 - t) * (1 - t) * (end * (1 + 2 * t) + end_slope * t));
  };

  Slice slice;
  const auto count = static_cast<int>(std::lround(ratio_end / share_spacing));
  for (int l = 0; l <= count; ++l) slice.force.push_back(fitted(share_spacing * l));
  if (rate) {
    slice.last_raised = keep_rising(slice.force, slow, x_reach);
    slice.force_slope = rising_slopes(slice.force, slow, x_reach);
  } else {
    slice.force_slope = slopes_of(slice.force, share_spacing);
    slice.force_slope.back() = 0;
  }
  const BetweenNodes raised(slice.force, slice.force_slope);
  const auto correction = [&](double xi) { return rate ? raised(xi) : fitted(xi); };
  double work = 0;  // of loading from 0 to the node
  for (int l = 0; l <= count; ++l) {
    const double xi = share_spacing * l;
    if (l > 0) {
      const auto work_per_share = [&](double at) {
        return x_reach * slow.loading(at * x_reach).force * (1 + correction(at));
      };
      // in two halves: F goes as xi^1.5 near 0
      const double middle = xi - 0.5 * share_spacing;
      work += gauss<4>(xi - share_spacing, middle, work_per_share) + gauss<4>(middle, xi, work_per_share);
    }
    if (l == 0) {
      slice.residual.push_back(0), slice.exponent.push_back(0);
      continue;
    }
    const double x = std::min(xi * x_reach, slow.x_end());
    const ContactCurve::Turning top = slow.turning(x);
    double kept = std::pow(1 - top.residual / x, more_residual);
    const double returned =
        std::pow(std::min(1.0, slow.work_unloading(x) / slow.work_loading(x)), more_dissipation);
    const double share = 1 + correction(xi),
                 share_slope = (correction(xi + 1e-4) - correction(xi - 1e-4)) / 2e-4;
    const double foot = top.shape.foot, most = UnloadingShape::largest_exponent(foot);
    const double area = work * returned / (top.force * share * kept * x);  // under the unloading's shape
    double n = UnloadingShape::exponent_of(area, foot);
    if (n > most) {  // no unloading that takes so long returns so little: what it returns goes first
      kept *= area / UnloadingShape{most, foot}.work();
      n = most;
    }
    slice.residual.push_back((1 - kept) - top.residual / x);
    // as in tabulate(): unloading at least as stiff as loading
    const double stiff = kept * (x * top.stiffness / top.force + xi * share_slope / share);
    slice.exponent.push_back(std::min(std::max({n, stiff, UnloadingShape::least_exponent}), most) -
                             top.shape.exponent);
  }
  slice.exponent[0] = slice.exponent[1];
  return slice;
}

/// One slice's nodes among those of all.
std::vector<double> row_of(const std::vector<double>& all, std::size_t row, std::size_t columns)
{
  const auto first = all.begin() + static_cast<std::ptrdiff_t>(row * columns);
  return {first, first + static_cast<std::ptrdiff_t>(columns)};
}
void put_row(std::vector<double>& all, std::size_t row, const std::vector<double>& values)
{
  std::copy(values.begin(), values.end(), all.begin() + static_cast<std::ptrdiff_t>(row * values.size()));
}

/// Where a contact is turned at a small share of its X the table's nodes in xi are too far apart to follow
/// the onset of yield. Raises the exponents there until no closed cycle gains energy in any slice or half-way
/// between two: that only takes more energy from contacts turned so early.
void raise_exponents(InertiaAxis::Table& axis, const ContactCurve& slow)
{
  const std::size_t columns = axis.ratio_nodes();
  constexpr int most_rounds = 40;
  constexpr double fading_nodes = 8;
  constexpr double spare = 2e-4;                            // of the work: what may hide between the samples
  std::vector<double> overlaps{slow.onset() * (1 + 1e-9)};  // densely past the onset, then evenly in s
  for (int k = 1; k <= 60; ++k) overlaps.push_back(slow.onset() * (1 + 3e-4 * std::pow(1.13, k)));
  const ContactCurve before(slow.table(), axis, "fitted curve");
  const std::vector<double> evenly = before.margin_overlaps(axis.impact_overlap.back());
  overlaps.insert(overlaps.end(), evenly.begin(), evenly.end());
  // at the onset itself nothing is lost yet
  std::erase_if(overlaps, [&](double x) { return x <= slow.onset() || x > slow.x_end(); });
  const std::vector<double> reaches = before.axis()->examined_overlaps();
  std::sort(overlaps.begin(), overlaps.end());
  std::vector<std::vector<double>> works;  // of loading, by reach and overlap: no exponent changes them
  for (const double reach : reaches) works.push_back(before.work_loading(overlaps, reach));
  for (int round = 0; round < most_rounds; ++round) {
    const ContactCurve curve(slow.table(), axis, "fitted curve");
    std::vector<double> raise(axis.exponent_correction.size(), 0.0);
    bool lacks = false;
    for (std::size_t k = 0; k < reaches.size(); ++k) {
      const double reach = reaches[k];
      const std::size_t half = 2 * axis.slices + 1 + k - reaches.size();  // of a slice; the last is at 2 K
      for (std::size_t i = 0; i < overlaps.size(); ++i) {
        const double x = overlaps[i];
        const double lacking =
            std::max(curve.work_unloading(x, reach) / works[k][i] - 1, -curve.margin_at(x, reach));
        if (lacking <= -spare) continue;
        lacks = lacks || lacking > -0.2 * spare;
        const auto column = std::min(static_cast<std::size_t>(x / reach / share_spacing) + 1, columns - 1);
        const UnloadingShape now = curve.turning(x, reach).shape;
        const double more =
            UnloadingShape::exponent_of((1 - 1.2 * (lacking + 1.5 * spare)) * now.work(), now.foot) -
            now.exponent;
        for (const std::size_t row : {(half + 1) / 2, half / 2})
          for (std::size_t l = 0; row > 0 && l < columns; ++l) {
            // fading out slowly: where the exponent falls, more comes back; contacts turned earlier keep
            // theirs
            const double away = static_cast<double>(l) - static_cast<double>(column);
            const double share = away > 0 ? 1 - away / fading_nodes : std::min(1.0, 2 + away / 2);
            double& there = raise[(row - 1) * columns + l];
            there = std::max(there, more * share);
          }
      }
    }
    if (!lacks) return;
    for (std::size_t k = 0; k < raise.size(); ++k) axis.exponent_correction[k] += raise[k];
    for (std::size_t row = 0; row < axis.slices; ++row) {
      const std::vector<double> exponents = row_of(axis.exponent_correction, row, columns);
      put_row(axis.exponent_correction_slope, row, slopes_of(exponents, share_spacing));
    }
  }
}

/// keep_rising() between the nodes and half-way between two slices, whose plateaus begin at different shares:
/// lifts the node that follows in both slices until the force rises at every place that ContactCurve
/// examines.
void keep_rising_between(InertiaAxis::Table& table, const ContactCurve& slow)
{
  constexpr int most_rounds = 100, samples = 8;  // an interval
  constexpr double least = 1e-3;                 // d ln F/d ln x
  const std::size_t columns = table.ratio_nodes();
  for (int round = 0; round < most_rounds; ++round) {
    const InertiaAxis axis(table, "fitted curve");
    const std::vector<double> reaches = axis.examined_overlaps();
    std::vector<double> lift(table.force_correction.size(), 0.0);
    bool falls = false;
    for (std::size_t k = 0; k < reaches.size(); ++k) {
      const std::size_t half = k + 2;  // of a slice: the first stands at row 1
      for (std::size_t i = 1; i < samples * (columns - 1); ++i) {
        const double xi = share_spacing * static_cast<double>(i) / samples, x = xi * reaches[k];
        const ContactCurve::Loading press = slow.loading(x);
        const InertiaAxis::ForceCorrection c = axis.force(x, reaches[k]);
        const double force = press.force * (1 + c.value),
                     stiffness = press.stiffness * (1 + c.value) + press.force * c.slope;
        const double lacking = (least - stiffness * x / force) * share_spacing / xi;
        const std::size_t next = i / samples + 1;
        if (lacking <= 0 || next + 1 >= columns) continue;
        falls = true;
        for (const std::size_t row : {half / 2, (half + 1) / 2}) {
          double& there = lift[(row - 1) * columns + next];
          there = std::max(there, 0.5 * lacking + 1e-5);
        }
      }
    }
    if (!falls) return;
    for (std::size_t j = 0; j < lift.size(); ++j)
      table.force_correction[j] += lift[j] * (1 + table.force_correction[j]);
    for (std::size_t row = 0; row < table.slices; ++row) {
      const double reach = axis.scale().overlap(static_cast<double>(row + 1));
      put_row(table.force_correction_slope, row,
              rising_slopes(row_of(table.force_correction, row, columns), slow, reach));
    }
  }
}

/// X(v) at equal steps, and the slices at the X that `scale` says.
InertiaAxis::Table tabulate(const LawShape& shape, const ContactCurve& slow, const Speeds& speeds,
                            InertiaAxis::Table table, int steps)
{
  const double fastest = table.speed_end;
  for (int k = 0; k <= steps; ++k) table.impact_overlap.push_back(speeds.reach(fastest * k / steps));
  table.impact_overlap_slope = slopes_of(table.impact_overlap, fastest / steps);
  for (double& slope : table.impact_overlap_slope) slope = std::max(0.0, slope);
  const double reach = table.impact_overlap.back();
  const bool rate = table.kind == InertiaAxis::Kind::rate;
  SliceScale scale;
  if (rate) {
    const double first = speeds.reach(table.speed_begin);
    table.slices = 1 + static_cast<std::size_t>(
                           std::max(1.0, std::round(slices_an_octave * (octaves(reach) - octaves(first)))));
    scale = SliceScale::by_octaves(table.slices, first, reach);
  } else {
    double spacings = std::round(reach / slice_spacing);
    // A soft body's first slice stands just past the onset, and none before: half-way to an elastic slice no
    // mixture of the two is admissible, and raising exponents there took 0.01 of e.
    if (reach / spacings < soft * slow.onset()) spacings = std::floor(reach / (first_told * slow.onset()));
    spacings = std::max(2.0, spacings);
    table.first_slices = reach / spacings < first_slices * first_told * slow.onset() ? 1 : first_slices;
    table.slices = static_cast<std::size_t>(spacings) + table.first_slices - 1;
    scale = SliceScale::from_standstill(table.slices, table.first_slices, reach);
  }
  const auto all_slices = [&] {
    std::vector<Slice> slices;
    for (std::size_t k = 1; k <= table.slices; ++k)
      slices.push_back(slice_at(speeds, shape, slow, scale.overlap(static_cast<double>(k)), table.speed_begin,
                                fastest, table.ratio_end, rate));
    return slices;
  };
  std::vector<Slice> slices = all_slices();
  // further out, where a force kept rising is not yet the press's
  const auto is_raised_at_end = [](const Slice& s) { return s.last_raised + 3 >= s.force.size(); };
  constexpr double farthest = 12;
  while (std::any_of(slices.begin(), slices.end(), is_raised_at_end)) {
    table.ratio_end = share_spacing * std::ceil(1.2 * table.ratio_end / share_spacing);
    if (table.ratio_end > farthest)
      fail("fit", "a rate raises the force so much that it is the press's again only far beyond the impacts",
           fmt::format("over {:g} of their overlap", farthest));
    slices = all_slices();
  }
  for (const Slice& slice : slices) {
    const auto append = [](const std::vector<double>& values, std::vector<double>& all) {
      all.insert(all.end(), values.begin(), values.end());
    };
    append(slice.force, table.force_correction), append(slice.force_slope, table.force_correction_slope);
    append(slice.residual, table.residual_correction);
    append(slopes_of(slice.residual, share_spacing), table.residual_correction_slope);
    append(slice.exponent, table.exponent_correction);
    append(slopes_of(slice.exponent, share_spacing), table.exponent_correction_slope);
  }
  if (rate) keep_rising_between(table, slow);
  raise_exponents(table, slow);
  return table;
}

/// `fastest`, or less where an impact would turn beyond the table; throws where none was as fast.
double end_of_axis(const LawShape& shape, const ContactCurve& slow, const Speeds& speeds, double fastest)
{
  const double last = shape.inertia.empty() ? 0 : shape.inertia.back().speed;
  if (!(fastest > 0 && fastest <= last * 1.0001))
    fail("fit", "no impact was as fast", fmt::format("sqrt(I) = {:.4g}", fastest),
         fmt::format("up to {:.4g}", last));
  while (speeds.reach(fastest) > slow.x_end())
    fastest *= std::min(0.98, std::sqrt(slow.x_end() / speeds.reach(fastest)));
  return fastest;
}

/// 1/2 m Y v^2 at v = 1 over 4/3 E* R^3.
double energy_unit(double e_star_over_yield, double mass)
{
  return 0.375 * mass / e_star_over_yield;
}

}  // namespace

InertiaAxis::Table tabulate_inertia(const LawShape& shape, const ContactCurve& slow, double e_star_over_yield,
                                    double mass, double fastest)
{
  const Speeds speeds(shape, slow, energy_unit(e_star_over_yield, mass), InertiaAxis::Kind::inertia);
  InertiaAxis::Table table;
  table.speed_end = end_of_axis(shape, slow, speeds, fastest);
  table.ratio_end = usual_ratio_end;
  return tabulate(shape, slow, speeds, table,
                  std::max(3, static_cast<int>(std::ceil(table.speed_end / speed_spacing - 1e-9))));
}

InertiaAxis::Table tabulate_rate(const LawShape& shape, const ContactCurve& slow, double e_star_over_yield,
                                 double mass, double fastest, double reference_radius)
{
  const Speeds speeds(shape, slow, energy_unit(e_star_over_yield, mass), InertiaAxis::Kind::rate);
  InertiaAxis::Table table;
  table.kind = InertiaAxis::Kind::rate;
  table.reference_radius = reference_radius;
  table.speed_end = end_of_axis(shape, slow, speeds, fastest);
  table.speed_begin = shape.inertia.front().speed;
  if (!(table.speed_begin < 0.7 * table.speed_end))
    fail("fit", "the slowest and the fastest impact of a rate-dependent law are too near to each other",
         fmt::format("sqrt(I) = {:.4g} and {:.4g}", table.speed_begin, table.speed_end), "1.5 times or more");
  table.ratio_end = usual_ratio_end;
  // X(v) is as v^0.8 to v: an eighth of the first speed a step, and one table for all
  const double steps = std::clamp(8 * table.speed_end / table.speed_begin, 16.0, 2048.0);
  return tabulate(shape, slow, speeds, table, static_cast<int>(steps));
}

}  // namespace granulaw
