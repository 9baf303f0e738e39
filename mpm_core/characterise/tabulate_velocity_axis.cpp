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
constexpr double level_spacing = 0.0125;  // of X, about, beyond the first
constexpr double levels_an_octave = 3;    // of a rate axis
constexpr std::size_t first_levels = 3;   // within the first spacing
constexpr double first_told = 1.5;       // X of the first level over the onset's overlap: nearer, keeping the
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
  Speeds(const LawShape& shape, const ContactCurve& slow, double energy_unit, VelocityAxis::Kind kind)
      : slow_(slow), energy_unit_(energy_unit), rate_(kind == VelocityAxis::Kind::rate)
  {
    const auto node = [&](double at, std::size_t source) {
      nodes_.push_back(at), sources_.push_back(source);
    };
    if (!rate_) {
      // Inertia goes as v^2: even in v, so the first speeds stand on the other side of the standstill, too.
      for (std::size_t j = std::min<std::size_t>(2, shape.velocity_effects.size()); j-- > 0;)
        node(-shape.velocity_effects[j].speed, j);
      node(0.0, standstill);
    }
    for (std::size_t j = 0; j < shape.velocity_effects.size(); ++j) {
      const LawShape::VelocityEffect& i = shape.velocity_effects[j];
      node(rate_ ? std::log(i.speed) : i.speed, j);
      log_overlap_ratio_.push_back(
          std::log(i.speed * std::exp(i.log_overlap) / slow_impact_overlap(i.speed)));
    }
  }

  /// X: the overlap/R that an impact reaches.
  double impact_overlap(double v) const
  {
    return v > 0 ? slow_impact_overlap(v) *
                       std::exp(mix(v, [&](std::size_t j) { return log_overlap_ratio_[j]; }))
                 : 0.0;
  }
  /// A quantity of LawShape::VelocityEffect at speed v; inertia: 0 at standstill.
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
  double slow_impact_overlap(double v) const
  {
    const double energy = energy_unit_ * v * v;
    return root_of([&](double x) { return slow_.work_loading(x) - energy; }, 0.0, 4.0);
  }

  const ContactCurve& slow_;
  double energy_unit_;  // kinetic energy at v = 1 over 4/3 E* R^3, the unit of ContactCurve's work
  bool rate_;
  static constexpr auto standstill = static_cast<std::size_t>(-1);  // where inertia changes nothing
  std::vector<double> nodes_;              // where speeds are known: v, of a rate ln v
  std::vector<std::size_t> sources_;       // and which of the shape's it is
  std::vector<double> log_overlap_ratio_;  // by the shape's speeds
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

/// Corrections of the force at the nodes, raised where it would fall: towards its reversal an impact loses
/// speed and with it rate, and a law's loading force rises. At the reversal it is the impact's peak: before,
/// no more. Returns the last node raised, 0: none.
std::size_t keep_rising(std::vector<double>& correction, const ContactCurve& slow, double impact_overlap)
{
  const auto reversal = static_cast<std::size_t>(std::lround(1 / share_spacing));
  const double peak = (1 + correction[reversal]) * slow.loading(impact_overlap).force;
  double most = 0;
  std::size_t last = 0;
  for (std::size_t l = 1; l < correction.size(); ++l) {
    const double press = slow.loading(share_spacing * static_cast<double>(l) * impact_overlap).force;
    constexpr double least_rise = 1e-4;  // a node, of the force
    if (l < reversal) correction[l] = std::min(correction[l], peak / press - 1);
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
                                  double impact_overlap)
{
  std::vector<double> slopes = slopes_of(correction, share_spacing);
  const auto press = [&](std::size_t l) {
    return slow.loading(share_spacing * static_cast<double>(l) * impact_overlap);
  };
  const auto force = [&](std::size_t l) { return (1 + correction[l]) * press(l).force; };
  for (std::size_t l = 1; l + 1 < correction.size(); ++l) {
    const double below = force(l) - force(l - 1), above = force(l + 1) - force(l);
    const double most = 3 * std::max(0.0, std::min(below, above)) / share_spacing;
    const ContactCurve::Loading p = press(l);
    const double of_press = (1 + correction[l]) * p.stiffness * impact_overlap;  // dF/dxi = P dA/dxi + this
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

/// One impact level: the corrections of a contact that latched X.
struct ImpactLevel
{
  std::vector<double> force, force_slope, residual, exponent;
  std::size_t last_raised = 0;  // node up to which a rate's force was kept rising
};

/// What a slow press to overlap x loses.
struct PressLosses
{
  double dissipation;  ///< -ln(W_u/W_L)
  double residual;     ///< -ln(1 - delta_r/delta_m)

  PressLosses(const ContactCurve& slow, double x)
      : dissipation(std::max(0.0, -std::log(slow.work_unloading(x) / slow.work_loading(x)))),
        residual(-std::log1p(-slow.reversal(x).residual / x))
  {
  }
};

/// A loss at overlap x of a contact that latched X: the press's at x, and `more`, what the impact adds at X,
/// in the share that the press has at x of its loss at X; all of it beyond. No contact gains.
double with_impact(double press, double press_at_reversal, double more)
{
  const double share = press < press_at_reversal ? press / press_at_reversal : 1.0;
  return std::max(0.0, press + share * more);
}

ImpactLevel level_at(const Speeds& speeds, const LawShape& shape, const ContactCurve& slow,
                     double impact_overlap, double slowest, double fastest, double ratio_end, bool rate)
{
  const double v = root_of([&](double speed) { return speeds.impact_overlap(speed) - impact_overlap; },
                           0.999 * slowest, 1.001 * fastest);
  std::vector<double> log_force;
  for (std::size_t n = 0; n < LawShape::VelocityEffect::shares; ++n)
    log_force.push_back(speeds.mix(v, [&](std::size_t j) { return shape.velocity_effects[j].force[n]; }));
  const PressLosses at_reversal(slow, std::min(impact_overlap, slow.x_end()));
  const double more_dissipation =
      speeds.mix(v, [&](std::size_t j) { return shape.velocity_effects[j].dissipation; });
  const double more_residual =
      speeds.mix(v, [&](std::size_t j) { return shape.velocity_effects[j].residual; });

  const boost::math::interpolators::cardinal_cubic_b_spline<double> within(
      log_force.begin(), log_force.end(), 0.0, 1.0 / (LawShape::VelocityEffect::shares - 1));
  // From the impact's own overlap on: the cubic with its value and slope there, and none where it ends. Of a
  // rate the slope is that of the fall before the reversal, which the law does not follow; and it ends as
  // soon as that of inertia, so that its peak, kept from falling, lasts no longer than until the press's
  // force is as large.
  const double told_end = rate ? usual_ratio_end : ratio_end;
  const double end = within(1.0), end_slope = rate ? 0.0 : within.prime(1.0) * (told_end - 1);
  const auto fitted = [&](double xi) {
    if (xi >= told_end) return 0.0;
    if (xi <= 1) return std::expm1(within(xi));
    const double t = (xi - 1) / (told_end - 1);
    return std::expm1((1 - t) * (1 - t) * (end * (1 + 2 * t) + end_slope * t));
  };

  ImpactLevel level;
  const auto count = static_cast<int>(std::lround(ratio_end / share_spacing));
  for (int l = 0; l <= count; ++l) level.force.push_back(fitted(share_spacing * l));
  if (rate) {
    level.last_raised = keep_rising(level.force, slow, impact_overlap);
    level.force_slope = rising_slopes(level.force, slow, impact_overlap);
  } else {
    level.force_slope = slopes_of(level.force, share_spacing);
    level.force_slope.back() = 0;
  }
  const BetweenNodes raised(level.force, level.force_slope);
  const auto correction = [&](double xi) { return rate ? raised(xi) : fitted(xi); };
  double work = 0;  // of loading from 0 to the node
  for (int l = 0; l <= count; ++l) {
    const double xi = share_spacing * l;
    if (l > 0) {
      const auto work_per_share = [&](double at) {
        return impact_overlap * slow.loading(at * impact_overlap).force * (1 + correction(at));
      };
      // in two halves: F goes as xi^1.5 near 0
      const double middle = xi - 0.5 * share_spacing;
      work += gauss<4>(xi - share_spacing, middle, work_per_share) + gauss<4>(middle, xi, work_per_share);
    }
    if (l == 0) {
      level.residual.push_back(0), level.exponent.push_back(0);
      continue;
    }
    const double x = std::min(xi * impact_overlap, slow.x_end());
    const ContactCurve::Reversal top = slow.reversal(x);
    const PressLosses press(slow, x);
    double kept = std::exp(-with_impact(press.residual, at_reversal.residual, more_residual));
    const double returned =
        std::exp(-with_impact(press.dissipation, at_reversal.dissipation, more_dissipation));
    const double share = 1 + correction(xi),
                 share_slope = (correction(xi + 1e-4) - correction(xi - 1e-4)) / 2e-4;
    const double hertz_share = top.shape.hertz_share, most = UnloadingShape::largest_exponent(hertz_share);
    const double area = work * returned / (top.force * share * kept * x);  // under the unloading's shape
    double n = UnloadingShape::exponent_of(area, hertz_share);
    if (n > most) {  // no unloading that takes so long returns so little: what it returns goes first
      kept *= area / UnloadingShape{most, hertz_share}.work();
      n = most;
    }
    level.residual.push_back((1 - kept) - top.residual / x);
    // as in tabulate(): unloading at least as stiff as loading
    const double stiff = kept * (x * top.stiffness / top.force + xi * share_slope / share);
    level.exponent.push_back(std::min(std::max({n, stiff, UnloadingShape::least_exponent}), most) -
                             top.shape.exponent);
  }
  level.exponent[0] = level.exponent[1];
  return level;
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

/// Where a contact reverses at a small share of its X the table's nodes in xi are too far apart to follow
/// the onset of yield. Raises the exponents there until no closed cycle gains energy in any level or half-way
/// between two: that only takes more energy from contacts reversed so early.
void raise_exponents(VelocityAxis::Table& axis, const ContactCurve& slow)
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
  const std::vector<double> impact_overlaps = before.axis()->examined_overlaps();
  std::sort(overlaps.begin(), overlaps.end());
  std::vector<std::vector<double>> works;  // of loading, by reach and overlap: no exponent changes them
  for (const double impact_overlap : impact_overlaps)
    works.push_back(before.work_loading(overlaps, impact_overlap));
  for (int round = 0; round < most_rounds; ++round) {
    const ContactCurve curve(slow.table(), axis, "fitted curve");
    std::vector<double> raise(axis.exponent_correction.size(), 0.0);
    bool lacks = false;
    for (std::size_t k = 0; k < impact_overlaps.size(); ++k) {
      const double impact_overlap = impact_overlaps[k];
      const std::size_t half =
          2 * axis.levels + 1 + k - impact_overlaps.size();  // of a level; the last is at 2 K
      for (std::size_t i = 0; i < overlaps.size(); ++i) {
        const double x = overlaps[i];
        const double lacking = std::max(curve.work_unloading(x, impact_overlap) / works[k][i] - 1,
                                        -curve.margin_at(x, impact_overlap));
        if (lacking <= -spare) continue;
        lacks = lacks || lacking > -0.2 * spare;
        const auto column =
            std::min(static_cast<std::size_t>(x / impact_overlap / share_spacing) + 1, columns - 1);
        const UnloadingShape now = curve.reversal(x, impact_overlap).shape;
        const double more =
            UnloadingShape::exponent_of((1 - 1.2 * (lacking + 1.5 * spare)) * now.work(), now.hertz_share) -
            now.exponent;
        for (const std::size_t row : {(half + 1) / 2, half / 2})
          for (std::size_t l = 0; row > 0 && l < columns; ++l) {
            // fading out slowly: where the exponent falls, more comes back; contacts reversed earlier keep
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
    for (std::size_t row = 0; row < axis.levels; ++row) {
      const std::vector<double> exponents = row_of(axis.exponent_correction, row, columns);
      put_row(axis.exponent_correction_slope, row, slopes_of(exponents, share_spacing));
    }
  }
}

/// keep_rising() between the nodes and half-way between two levels, whose plateaus begin at different shares:
/// lifts the node that follows in both levels until the force rises at every place that ContactCurve
/// examines.
void keep_rising_between(VelocityAxis::Table& table, const ContactCurve& slow)
{
  constexpr int most_rounds = 100, samples = 8;  // an interval
  constexpr double least = 1e-3;                 // d ln F/d ln x
  const std::size_t columns = table.ratio_nodes();
  for (int round = 0; round < most_rounds; ++round) {
    const VelocityAxis axis(table, "fitted curve");
    const std::vector<double> impact_overlaps = axis.examined_overlaps();
    std::vector<double> lift(table.force_correction.size(), 0.0);
    bool falls = false;
    for (std::size_t k = 0; k < impact_overlaps.size(); ++k) {
      const std::size_t half = k + 2;  // of a level: the first stands at row 1
      for (std::size_t i = 1; i < samples * (columns - 1); ++i) {
        const double xi = share_spacing * static_cast<double>(i) / samples, x = xi * impact_overlaps[k];
        const ContactCurve::Loading press = slow.loading(x);
        const VelocityAxis::ForceCorrection c = axis.force(x, impact_overlaps[k]);
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
    for (std::size_t row = 0; row < table.levels; ++row) {
      const double impact_overlap = axis.scale().overlap(static_cast<double>(row + 1));
      put_row(table.force_correction_slope, row,
              rising_slopes(row_of(table.force_correction, row, columns), slow, impact_overlap));
    }
  }
}

/// X(v) at equal steps, and the levels at the X that `scale` says.
VelocityAxis::Table tabulate(const LawShape& shape, const ContactCurve& slow, const Speeds& speeds,
                             VelocityAxis::Table table, int steps)
{
  const double fastest = table.speed_end;
  for (int k = 0; k <= steps; ++k) table.impact_overlap.push_back(speeds.impact_overlap(fastest * k / steps));
  table.impact_overlap_slope = slopes_of(table.impact_overlap, fastest / steps);
  for (double& slope : table.impact_overlap_slope) slope = std::max(0.0, slope);
  const double impact_overlap = table.impact_overlap.back();
  const bool rate = table.kind == VelocityAxis::Kind::rate;
  ImpactLevels scale;
  if (rate) {
    const double first = speeds.impact_overlap(table.speed_begin);
    table.levels = 1 + static_cast<std::size_t>(std::max(
                           1.0, std::round(levels_an_octave * (octaves(impact_overlap) - octaves(first)))));
    scale = ImpactLevels::by_octaves(table.levels, first, impact_overlap);
  } else {
    double spacings = std::round(impact_overlap / level_spacing);
    // A soft body's first level stands just past the onset, and none before: half-way to an elastic level no
    // mixture of the two is admissible, and raising exponents there took 0.01 of e.
    if (impact_overlap / spacings < soft * slow.onset())
      spacings = std::floor(impact_overlap / (first_told * slow.onset()));
    spacings = std::max(2.0, spacings);
    table.first_levels =
        impact_overlap / spacings < first_levels * first_told * slow.onset() ? 1 : first_levels;
    table.levels = static_cast<std::size_t>(spacings) + table.first_levels - 1;
    scale = ImpactLevels::from_standstill(table.levels, table.first_levels, impact_overlap);
  }
  const auto all_levels = [&] {
    std::vector<ImpactLevel> levels;
    for (std::size_t k = 1; k <= table.levels; ++k)
      levels.push_back(level_at(speeds, shape, slow, scale.overlap(static_cast<double>(k)), table.speed_begin,
                                fastest, table.ratio_end, rate));
    return levels;
  };
  std::vector<ImpactLevel> levels = all_levels();
  // further out, where a force kept rising is not yet the press's
  const auto is_raised_at_end = [](const ImpactLevel& s) { return s.last_raised + 3 >= s.force.size(); };
  constexpr double farthest = 12;
  while (std::any_of(levels.begin(), levels.end(), is_raised_at_end)) {
    table.ratio_end = share_spacing * std::ceil(1.2 * table.ratio_end / share_spacing);
    if (table.ratio_end > farthest)
      fail("fit", "a rate raises the force so much that it is the press's again only far beyond the impacts",
           fmt::format("over {:g} of their overlap", farthest));
    levels = all_levels();
  }
  for (const ImpactLevel& level : levels) {
    const auto append = [](const std::vector<double>& values, std::vector<double>& all) {
      all.insert(all.end(), values.begin(), values.end());
    };
    append(level.force, table.force_correction), append(level.force_slope, table.force_correction_slope);
    append(level.residual, table.residual_correction);
    append(slopes_of(level.residual, share_spacing), table.residual_correction_slope);
    append(level.exponent, table.exponent_correction);
    append(slopes_of(level.exponent, share_spacing), table.exponent_correction_slope);
  }
  if (rate) keep_rising_between(table, slow);
  raise_exponents(table, slow);
  return table;
}

/// `fastest`, or less where an impact would reverse beyond the table; throws where none was as fast.
double end_of_axis(const LawShape& shape, const ContactCurve& slow, const Speeds& speeds, double fastest)
{
  const double last = shape.velocity_effects.empty() ? 0 : shape.velocity_effects.back().speed;
  if (!(fastest > 0 && fastest <= last * 1.0001))
    fail("fit", "no impact was as fast", fmt::format("sqrt(I) = {:.4g}", fastest),
         fmt::format("up to {:.4g}", last));
  while (speeds.impact_overlap(fastest) > slow.x_end())
    fastest *= std::min(0.98, std::sqrt(slow.x_end() / speeds.impact_overlap(fastest)));
  return fastest;
}

/// 1/2 m Y v^2 at v = 1 over 4/3 E* R^3.
double energy_unit(double e_star_over_yield, double mass)
{
  return 0.375 * mass / e_star_over_yield;
}

}  // namespace

VelocityAxis::Table tabulate_inertia(const LawShape& shape, const ContactCurve& slow,
                                     double e_star_over_yield, double mass, double fastest)
{
  const Speeds speeds(shape, slow, energy_unit(e_star_over_yield, mass), VelocityAxis::Kind::inertia);
  VelocityAxis::Table table;
  table.speed_end = end_of_axis(shape, slow, speeds, fastest);
  table.ratio_end = usual_ratio_end;
  return tabulate(shape, slow, speeds, table,
                  std::max(3, static_cast<int>(std::ceil(table.speed_end / speed_spacing - 1e-9))));
}

VelocityAxis::Table tabulate_rate(const LawShape& shape, const ContactCurve& slow, double e_star_over_yield,
                                  double mass, double fastest, double reference_radius)
{
  const Speeds speeds(shape, slow, energy_unit(e_star_over_yield, mass), VelocityAxis::Kind::rate);
  VelocityAxis::Table table;
  table.kind = VelocityAxis::Kind::rate;
  table.reference_radius = reference_radius;
  table.speed_end = end_of_axis(shape, slow, speeds, fastest);
  table.speed_begin = shape.velocity_effects.front().speed;
  if (!(table.speed_begin < 0.7 * table.speed_end))
    fail("fit", "the slowest and the fastest impact of a rate-dependent law are too near to each other",
         fmt::format("sqrt(I) = {:.4g} and {:.4g}", table.speed_begin, table.speed_end), "1.5 times or more");
  table.ratio_end = usual_ratio_end;
  // X(v) is as v^0.8 to v: an eighth of the first speed a step, and one table for all
  const double steps = std::clamp(8 * table.speed_end / table.speed_begin, 16.0, 2048.0);
  return tabulate(shape, slow, speeds, table, static_cast<int>(steps));
}

}  // namespace granulaw
