#include "contact/plastic_body.hpp"

#include <algorithm>
#include <cmath>

#include "contact/confined_modes.hpp"

namespace granulaw {

namespace {

/// Radius of the ball that one plane at the height d cuts to the volume of the unit ball.
double grown(double d, double guess)
{
  double radius = guess;
  for (int k = 0; k < 50; ++k) {
    const double miss = (2 * radius * radius * radius + 3 * radius * radius * d - d * d * d - 4.0) / (6 * radius * (radius + d));
    radius -= miss;
    if (std::abs(miss) < 1e-14) break;
  }
  return radius;
}

}  // namespace

PlasticBody::PlasticBody(const Curve& curve, double youngs_modulus, double poisson_ratio, const FlowStress& flow)
    : curve_(&curve),
      unit_(4.0 / 3.0 * youngs_modulus / (1.0 - poisson_ratio * poisson_ratio) / flow.yield),
      modulus_(youngs_modulus / flow.yield),
      poisson_(poisson_ratio),
      flow_(flow)
{
  constexpr std::size_t points = 4000;
  constexpr double deepest = 0.999, widest = 2.0, most_of_modes = 0.95;
  struct Point
  {
    double radius, cap, spring;
  };
  std::vector<Point> of(points + 1);
  double ball = 1;
  for (std::size_t k = 1; k <= points; ++k) {
    const double part = static_cast<double>(k) / points, overlap = deepest * part * part;  // fine where it is small
    const PairAnswer now = pair(overlap, overlap);
    const double height = 1.0 - overlap, strain = now.force * height / (confined_volume * modulus_);
    const double elastic = 2.0 * now.stored / now.force + (1.0 - own_part) * height * strain, d = height + elastic;
    ball = grown(d, ball);
    const double area = M_PI * (ball * ball - d * d), filter = ConfinedModes::filter(d, ball, area);
    const double modes = std::min(std::sqrt(ConfinedModes::coupling(1.0, filter * filter)) * now.force * d / confined_volume, most_of_modes);
    of[k] = {std::sqrt(area / M_PI), now.force / std::cbrt(1.0 - modes * modes * modes), now.force * now.force / (2.0 * now.stored)};
  }
  std::size_t k = 0;
  for (double radius = 0; radius <= widest; radius += step) {
    while (k + 2 < of.size() && of[k + 1].radius < radius) ++k;
    const double t = (radius - of[k].radius) / (of[k + 1].radius - of[k].radius);
    caps_.push_back(of[k].cap + t * (of[k + 1].cap - of[k].cap));
    springs_.push_back(of[k].spring + t * (of[k + 1].spring - of[k].spring));
  }
}

PlasticBody::PairAnswer PlasticBody::pair(double overlap, double deepest) const
{
  if (!(overlap > 0)) return {};
  const Answer now = answer(*curve_, PairUnits{1.0, unit_, 1.0}, overlap, deepest);
  const double largest = std::max(overlap, deepest), area = M_PI * now.contact_radius * now.contact_radius;
  if (!(largest > curve_->onset())) return {now.force, now.stiffness, unit_ * curve_->work(overlap), 0.0, 0.0, area};
  const Reversal back = curve_->reversal(largest);
  return {now.force, now.stiffness, unit_ * back.work(overlap), lost(largest), back.residual(), area};
}

double PlasticBody::at(const std::vector<double>& table, double x)
{
  const double place = std::max(x, 0.0) / step;
  const auto k = static_cast<std::size_t>(std::min(place, static_cast<double>(table.size() - 2)));
  return table[k] + (place - static_cast<double>(k)) * (table[k + 1] - table[k]);
}

}  // namespace granulaw
