#include <algorithm>
#include <cmath>

#include "base/gauss.hpp"
#include "characterise/impact_level.hpp"
#include "characterise/reversal_point.hpp"
#include "contact/cubic.hpp"

namespace granulaw {

namespace {

constexpr double spacing = ImpactLevel::share_spacing;

/// What a slow press to overlap x does; slopes by ln x.
struct Press
{
  double force_exponent, force, work;
  double exponent, exponent_slope, hertz_share, hertz_share_slope;
  double residual = 0, residual_slope = 0;  ///< -ln(1 - delta_r/delta_m)
  double loss = 0, loss_slope = 0;          ///< -ln(W_u/W_L)

  Press(const ContactCurve& slow, double x)
  {
    const ContactCurve::Loading top = slow.loading(x);
    force = top.force, work = slow.work_loading(x);
    force_exponent = x * top.stiffness / force;
    const ContactCurve::Table& t = slow.table();
    const std::size_t last = t.exponent.size() - 1;
    const double s = std::pow(x, 0.25), h = t.s_end / static_cast<double>(last);
    const auto k = std::min(static_cast<std::size_t>(s / h), last - 1);
    const auto at = [&](const std::vector<double>& v, const std::vector<double>& slope) {
      double c[4];
      hermite(c, v[k], v[k + 1], h * slope[k], h * slope[k + 1]);
      const double place = s / h - static_cast<double>(k);
      return ImpactLevel::ForceCorrection{cubic(c, place), cubic_slope(c, place) / h * 0.25 * s};
    };
    const auto n = at(t.exponent, t.exponent_slope), a = at(t.hertz_share, t.hertz_share_slope);
    exponent = n.value, exponent_slope = n.slope, hertz_share = a.value, hertz_share_slope = a.slope;
    if (x <= slow.onset()) return;
    const auto ratio = at(t.residual_ratio, t.residual_ratio_slope);
    residual = -std::log1p(-ratio.value), residual_slope = ratio.slope / (1 - ratio.value);
    const double w = UnloadingShape{exponent, hertz_share}.work();
    const double w_slope = (-2 * exponent_slope + 0.2 * hertz_share_slope) / 21;
    loss = -std::log(force * x * std::exp(-residual) * w / work);
    loss_slope = force * x / work - force_exponent - 1 + residual_slope - w_slope / w;
  }
};

/// Work of loading between two xi within one interval between nodes; over sqrt(xi), in which F is a
/// polynomial near 0.
double loading_work(const ImpactLevel& level, const ContactCurve& slow, double from, double to)
{
  const double impact_overlap = level.impact_overlap;
  return gauss<7>(std::sqrt(from), std::sqrt(to), [&](double root) {
    const double xi = root * root;
    return 2 * root * impact_overlap * slow.loading(xi * impact_overlap).force *
           (1 + level.force_at(xi).value);
  });
}

/// Of loading from 0 to every node.
std::vector<double> loading_works(const ImpactLevel& level, const ContactCurve& slow)
{
  std::vector<double> works{0.0};
  for (std::size_t l = 1; l < level.force.size(); ++l) {
    const double end = spacing * static_cast<double>(l);
    works.push_back(works.back() + loading_work(level, slow, end - spacing, end));
  }
  return works;
}

/// A loss of the press, and its slope, changed by what the impact adds, in the share that the press has of
/// its loss at the reversal; all of it beyond. It takes off no more than the press loses at `least`, at the
/// same xi half-way to the level below: their mean, too, must lose something from the onset on.
void add_impact(double& loss, double& slope, double at_reversal, double more, double least,
                double least_slope)
{
  double change = more, change_slope = 0;
  if (loss < at_reversal) change = more * loss / at_reversal, change_slope = more * slope / at_reversal;
  if (change < -least) change = -least, change_slope = -least_slope;
  loss += change, slope += change_slope;
}

/// B and N at one xi.
struct Corrections
{
  double residual, residual_slope, exponent, exponent_slope;
};

/// Up to the onset all work is returned, with another mean force than the press's: N makes up for that.
Corrections while_elastic(const ReversalPoint& p, const Press& press, double x, double xi)
{
  const double press_mean = press.work / (press.force * x);
  const double press_mean_slope = press_mean * (1 / press_mean - press.force_exponent - 1) / xi;
  const double n = -10.5 * (p.mean_force - press_mean),
               least = UnloadingShape::least_exponent - press.exponent;
  return n > least ? Corrections{0, 0, n, -10.5 * (p.work_slope() - press_mean_slope)}
                   : Corrections{0, 0, least, 0};
}

/// `work`: of loading to x = xi X, at most the press's end.
Corrections corrections_at(const ImpactLevel& level, double xi, double work, const Press& at_reversal,
                           const LawShape::VelocityEffect& effect, const ContactCurve& slow)
{
  const double x = std::min(xi * level.impact_overlap, slow.x_end());
  const Press press(slow, x);
  const ImpactLevel::ForceCorrection force = level.force_at(xi);
  ReversalPoint p{};
  p.log_slope = 1 / xi;
  p.force_exponent = press.force_exponent + xi * force.slope / (1 + force.value);
  p.mean_force = work / (press.force * (1 + force.value) * x);
  p.residual = press.residual, p.residual_slope = press.residual_slope / xi;
  p.loss = press.loss, p.loss_slope = press.loss_slope / xi;
  if (x <= slow.onset() * (1 + 1e-12)) return while_elastic(p, press, x, xi);
  const Press least(slow, xi * level.overlap_below);
  add_impact(p.residual, p.residual_slope, at_reversal.residual, effect.residual, least.residual,
             least.residual_slope / xi);
  add_impact(p.loss, p.loss_slope, at_reversal.loss, effect.dissipation, least.loss, least.loss_slope / xi);
  p.fit_length(press.hertz_share);
  const double kept = std::exp(-p.residual), press_kept = std::exp(-press.residual);
  const double n = UnloadingShape::exponent_of(p.work(), press.hertz_share),
               most = UnloadingShape::largest_exponent(press.hertz_share);
  const bool free = n > UnloadingShape::least_exponent && n < most;
  return {
      press_kept - kept, kept * p.residual_slope - press_kept * press.residual_slope / xi,
      std::clamp(n, UnloadingShape::least_exponent, most) - press.exponent,
      (free ? -10.5 * p.work_slope() + 0.2 * press.hertz_share_slope / xi : 0.0) - press.exponent_slope / xi};
}

/// First touch: F = x^1.5 (1 + A + A' xi) is elastic; so W_L/(F x) has this slope.
Corrections at_first_touch(const ImpactLevel& level)
{
  return {0, 0, 0, -10.5 * level.force_slope[0] / (1 + level.force[0]) * (1 / 3.5 - 1 / 2.5)};
}

/// At xi = 0, of the cubic with this value and slope at `xi` and those of `next` at the first node.
void continue_to_0(double& value, double& slope, double xi, double next, double next_slope)
{
  const double length = spacing - xi, t = -xi / length;
  double c[4];
  hermite(c, value, next, length * slope, length * next_slope);
  value = cubic(c, t), slope = cubic_slope(c, t) / length;
}

/// Where the onset lies within the first interval, its cubic starts there: no contact reverses before.
/// Elsewhere the node before is one of levels beside, too. Below a fiftieth of the interval the onset is not
/// told from first touch, and from four fifths on the cubic would go back too far.
bool starts_at_onset(double onset)
{
  return onset > 0.02 * spacing && onset < 0.8 * spacing;
}

}  // namespace

void tabulate_losses(ImpactLevel& level, const LawShape::VelocityEffect& effect, const ContactCurve& slow)
{
  const Press at_reversal(slow, std::min(level.impact_overlap, slow.x_end()));
  const std::vector<double> works = loading_works(level, slow);
  std::vector<Corrections> all{at_first_touch(level)};
  for (std::size_t l = 1; l < level.force.size(); ++l)
    all.push_back(
        corrections_at(level, spacing * static_cast<double>(l), works[l], at_reversal, effect, slow));
  if (const double onset = slow.onset() / level.impact_overlap; starts_at_onset(onset)) {
    Corrections& c = all[0];
    c = corrections_at(level, onset, loading_work(level, slow, 0, onset), at_reversal, effect, slow);
    continue_to_0(c.residual, c.residual_slope, onset, all[1].residual, all[1].residual_slope);
    continue_to_0(c.exponent, c.exponent_slope, onset, all[1].exponent, all[1].exponent_slope);
  }
  for (const Corrections& c : all) {
    level.residual.push_back(c.residual), level.residual_slope.push_back(c.residual_slope);
    level.exponent.push_back(c.exponent), level.exponent_slope.push_back(c.exponent_slope);
  }
}

}  // namespace granulaw
