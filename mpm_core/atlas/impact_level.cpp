#include "atlas/impact_level.hpp"

#include <algorithm>
#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>
#include <cmath>
#include <limits>

#include "atlas/node_slopes.hpp"

namespace granulaw {

namespace {

constexpr double spacing = share_spacing;

constexpr double usual_end_of_share = 1.5;  // xi where the force is the press's again

/// ln(F_impact/F_press) of an impact over xi <= 1: the spline through its fractions. At the end it has the
/// slope of four shares before. The last shares scatter: with the slope of the cubic through them F_max of
/// the atlas's checks is .0025 off (rms) in place of .0022.
boost::math::interpolators::cardinal_cubic_b_spline<double> log_force(const LawShape::VelocityEffect& effect)
{
  constexpr int last = LawShape::VelocityEffect::shares - 1;
  constexpr double step = 1.0 / last, estimated = std::numeric_limits<double>::quiet_NaN();
  const double end_slope = (effect.force[last - 3] - effect.force[last - 5]) / (2 * step);
  return {effect.force.begin(), effect.force.end(), 0.0, step, estimated, end_slope};
}

std::size_t nodes_to(double share_end)
{
  return static_cast<std::size_t>(std::lround(share_end / spacing)) + 1;
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

  SlowestRise(const Curve& slow, std::vector<double> overlaps, std::size_t nodes)
  {
    value.assign(nodes, 0.0), slope.assign(nodes, 0.0);
    constexpr double least = 1e-3;  // d ln F/d ln x that cubics between nodes may miss
    for (std::size_t l = 1; l < nodes; ++l) {
      const double xi = spacing * static_cast<double>(l);
      double rise = std::numeric_limits<double>::infinity();
      slope[l] = rise;
      for (const double overlap : overlaps) {
        const Curve::Loading now = slow.loading(xi * overlap);
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

HermiteColumn inertia_force(const LawShape::VelocityEffect& effect, double share_end)
{
  const auto within = log_force(effect);
  const double end = within(1.0), slope = end == 0 ? 0.0 : within.prime(1.0) * (share_end - 1) / end;
  HermiteColumn force;
  for (std::size_t l = 0; l < nodes_to(share_end); ++l) {
    const double xi = spacing * static_cast<double>(l), t = (xi - 1) / (share_end - 1);
    force.value.push_back(std::expm1(xi <= 1 ? within(xi) : end * fading(std::min(t, 1.0), slope)));
  }
  force.slope = difference_slopes(force.value, spacing);
  force.slope.back() = 0;
  return force;
}

HermiteColumn rate_force(const LawShape::VelocityEffect& effect, double latched, const Curve& slow,
                  const std::vector<double>& beside, double share_end)
{
  const auto within = log_force(effect);
  std::vector<double> overlaps = beside;
  overlaps.push_back(latched);
  const SlowestRise rise(slow, overlaps, nodes_to(share_end));
  const auto reversal = static_cast<std::size_t>(std::lround(1 / spacing));
  std::size_t last_raised = 0;
  HermiteColumn force;
  for (std::size_t l = 0; l < nodes_to(share_end); ++l) {
    const double xi = spacing * static_cast<double>(l), t = (xi - 1) / (usual_end_of_share - 1);
    double correction = std::expm1(xi <= 1 ? within(xi) : within(1.0) * fading(std::min(t, 1.0), 0.0));
    if (l > 0 && l < reversal)  // to the impact's peak at its reversal, before no more
      correction = std::min(correction, std::exp(within(1.0) + rise.value[reversal] - rise.value[l]) - 1);
    if (l > 1) {
      const double least = (1 + force.value.back()) * std::exp(rise.value[l - 1] - rise.value[l]) - 1;
      if (correction < least) correction = least, last_raised = l;
    }
    force.value.push_back(correction);
  }
  force.slope = rising_slopes(force.value, rise);
  if (last_raised + 3 >= force.size()) return {};
  return force;
}

}  // namespace granulaw
