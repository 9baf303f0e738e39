#include "characterise/impact_level.hpp"

#include <algorithm>
#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>
#include <cmath>
#include <limits>

#include "characterise/node_slopes.hpp"
#include "contact/cubic.hpp"

namespace granulaw {

namespace {

constexpr double spacing = ImpactLevel::share_spacing;

constexpr double usual_ratio_end = 1.5;  // xi where the force is the press's again

/// ln(F_impact/F_press) of an impact over xi <= 1: the spline through its shares.
boost::math::interpolators::cardinal_cubic_b_spline<double> log_force(const LawShape::VelocityEffect& effect)
{
  return {effect.force.begin(), effect.force.end(), 0.0, 1.0 / (LawShape::VelocityEffect::shares - 1)};
}

std::size_t nodes_to(double ratio_end)
{
  return static_cast<std::size_t>(std::lround(ratio_end / spacing)) + 1;
}

/// From 1 at t = 0 to 0 at t = 1 without slope there; d/dt = `slope` at 0.
double fading(double t, double slope)
{
  return (1 - t) * (1 - t) * (1 + (2 + slope) * t);
}

/// ln of a force to which all that may stand for the press's at a level is proportional or rises faster: over
/// each interval it rises as the slowest at any of these overlaps. Slopes by xi.
struct SlowestRise
{
  std::vector<double> value, slope;

  SlowestRise(const ContactCurve& slow, std::vector<double> overlaps, std::size_t nodes)
  {
    value.assign(nodes, 0.0), slope.assign(nodes, 0.0);
    constexpr double least = 1e-3;  // d ln F/d ln x that cubics between nodes may miss
    for (std::size_t l = 1; l < nodes; ++l) {
      const double xi = spacing * static_cast<double>(l);
      double rise = std::numeric_limits<double>::infinity();
      slope[l] = rise;
      for (const double overlap : overlaps) {
        const ContactCurve::Loading now = slow.loading(xi * overlap);
        slope[l] = std::min(slope[l], now.stiffness * overlap / now.force - least / xi);
        if (l > 1)
          rise = std::min(rise, std::log(now.force / slow.loading((xi - spacing) * overlap).force) -
                                    least * spacing / xi);
      }
      if (l > 1) value[l] = value[l - 1] + rise;
    }
  }
};

/// Slopes by xi of 1 + A where (1 + A) exp(rise) does not fall: differences within Fritsch and Carlson's
/// limits, 0 at the end.
std::vector<double> rising_slopes(const std::vector<double>& correction, const SlowestRise& rise)
{
  std::vector<double> slopes = difference_slopes(correction, spacing);
  const auto scaled = [&](std::size_t l, std::size_t at) {
    return (1 + correction[l]) * std::exp(rise.value[l] - rise.value[at]);
  };
  for (std::size_t l = 1; l + 1 < correction.size(); ++l) {
    const double below = l > 1 ? scaled(l, l) - scaled(l - 1, l) : scaled(l, l);
    const double most = 3 / spacing * std::max(0.0, std::min(below, scaled(l + 1, l) - scaled(l, l)));
    const double still = -(1 + correction[l]) * rise.slope[l];
    slopes[l] = std::clamp(slopes[l], still, still + most);
  }
  slopes.back() = 0;
  return slopes;
}

}  // namespace

ImpactLevel::ForceCorrection ImpactLevel::force_at(double xi) const
{
  const double place = xi / share_spacing;
  const auto l = std::min(static_cast<std::size_t>(place), force.size() - 2);
  double c[4];
  hermite(c, force[l], force[l + 1], share_spacing * force_slope[l], share_spacing * force_slope[l + 1]);
  const double t = std::min(1.0, place - static_cast<double>(l));
  return {cubic(c, t), cubic_slope(c, t) / share_spacing};
}

void tabulate_inertia_force(ImpactLevel& level, const LawShape::VelocityEffect& effect, double ratio_end)
{
  const auto within = log_force(effect);
  const double end = within(1.0), slope = end == 0 ? 0.0 : within.prime(1.0) * (ratio_end - 1) / end;
  for (std::size_t l = 0; l < nodes_to(ratio_end); ++l) {
    const double xi = spacing * static_cast<double>(l), t = (xi - 1) / (ratio_end - 1);
    level.force.push_back(std::expm1(xi <= 1 ? within(xi) : end * fading(std::min(t, 1.0), slope)));
  }
  level.force_slope = difference_slopes(level.force, spacing);
  level.force_slope.back() = 0;
}

bool tabulate_rate_force(ImpactLevel& level, const LawShape::VelocityEffect& effect, const ContactCurve& slow,
                         const std::vector<double>& beside, double ratio_end)
{
  const auto within = log_force(effect);
  std::vector<double> overlaps = beside;
  overlaps.push_back(level.impact_overlap);
  const SlowestRise rise(slow, overlaps, nodes_to(ratio_end));
  const auto reversal = static_cast<std::size_t>(std::lround(1 / spacing));
  std::size_t last_raised = 0;
  for (std::size_t l = 0; l < nodes_to(ratio_end); ++l) {
    const double xi = spacing * static_cast<double>(l), t = (xi - 1) / (usual_ratio_end - 1);
    double correction = std::expm1(xi <= 1 ? within(xi) : within(1.0) * fading(std::min(t, 1.0), 0.0));
    if (l > 0 && l < reversal)  // to the impact's peak at its reversal, before no more
      correction = std::min(correction, std::exp(within(1.0) + rise.value[reversal] - rise.value[l]) - 1);
    if (l > 1) {
      const double least = (1 + level.force.back()) * std::exp(rise.value[l - 1] - rise.value[l]) - 1;
      if (correction < least) correction = least, last_raised = l;
    }
    level.force.push_back(correction);
  }
  level.force_slope = rising_slopes(level.force, rise);
  return last_raised + 3 < level.force.size();
}

}  // namespace granulaw
