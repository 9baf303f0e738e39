#include "deck/soften.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/scales.hpp"
#include "law/thornton.hpp"

namespace granulaw::deck {

namespace {

/// Height of the bed if all particles lie on the ground that walls and domain enclose.
double bed_height(const Scene& scene, const Plan& plan, const PlanOptions& options, double solid_fraction)
{
  double volume = 0;
  for (const Source& s : scene.sources)
    volume += s.count * 4.0 / 3.0 * M_PI * std::pow(0.5 * (s.radius_min + s.radius_max), 3);
  if (volume == 0) volume = options.particles.value_or(0) * 4.0 / 3.0 * M_PI * std::pow(plan.radius_max, 3);
  Box ground;
  for (const Wall& w : scene.walls) ground.include(w.box);
  if (!scene.domain.empty()) ground = ground.empty() ? scene.domain : ground.within(scene.domain);
  const double g = norm(scene.gravity);
  if (ground.empty() || g == 0) return 0;
  // the area under the box, seen along gravity
  const Vec3 size = ground.size(), n = 1 / g * scene.gravity;
  const double area = std::abs(n[0]) * size[1] * size[2] + std::abs(n[1]) * size[0] * size[2] +
                      std::abs(n[2]) * size[0] * size[1];
  return area > 0 && std::isfinite(area) ? volume / solid_fraction / area : 0;
}

double two_digits_down(double x)
{
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
  return std::floor(x / unit * (1 + 1e-12)) * unit;
}

/// e by the law at hand, else by Thornton's closed form.
double restitution(const PlanOptions& options, const Meeting& m, double r_eff, double m_eff, double speed,
                   std::string& basis)
{
  if (options.collide)
    if (const auto collision = options.collide(m, r_eff, m_eff, speed)) return collision->restitution;
  basis = "Thornton";
  if (!m.yields.yields()) return 1;
  return thornton_restitution(
      speed / yield_velocity(m.mapping.e_star, m.yields.yield_stress, m.one_body_density(r_eff, m_eff)));
}

}  // namespace

Softening soften(const Scene& scene, const Plan& plan, const PlanOptions& options, const SoftenLimits& limits)
{
  Softening result;
  const double g = norm(scene.gravity), diameter = 2 * plan.radius_min;
  result.fill_height =
      limits.fill_height > 0 ? limits.fill_height : bed_height(scene, plan, options, limits.solid_fraction);
  double wall_speed = 0;
  for (const Wall& w : scene.walls) wall_speed = std::max({wall_speed, w.speed, w.drag_speed});
  result.flow_time = g > 0 ? std::sqrt(diameter / g) : Box::infinity;  // a fall through one radius
  if (wall_speed > 0) result.flow_time = std::min(result.flow_time, diameter / wall_speed);

  double largest = 1000;  // what the plug-in takes
  result.bound = "the plug-in's largest stretch";
  const auto bind = [&](double s, const std::string& why) {
    if (s < largest) largest = s, result.bound = why;
  };
  for (const PairPlan& p : plan.pairs) {
    if (!p.visited || p.speed <= 0) continue;
    const Meeting& m = p.meeting;
    PairStretch q;
    q.pair = &p;
    const double density = plan.mass_min / (4.0 / 3.0 * M_PI * std::pow(plan.radius_min, 3));
    const double r_eff = m.wall ? plan.radius_min : 0.5 * plan.radius_min;
    const double r_big = m.wall ? plan.radius_max : 0.5 * plan.radius_max,
                 m_big = m.wall ? plan.mass_max : 0.5 * plan.mass_max;
    q.slow_speed = g > 0 ? std::min(p.speed, std::sqrt(2 * g * diameter)) : p.speed;
    q.contact_time = hertz_time(m.mapping.e_star_pair(), r_big, m_big, q.slow_speed);
    q.by_overlap = p.overlap > 0 ? limits.overlap / p.overlap : Box::infinity;
    const double flow_time = std::isfinite(result.flow_time) ? result.flow_time : diameter / p.speed;
    q.by_time = limits.time_fraction * flow_time / q.contact_time;
    q.static_load = limits.solid_fraction * density * g * result.fill_height * diameter * diameter;
    const double x = m.yields.yields()
                         ? onset_overlap(m.mapping.e_star, m.yields.yield_stress, m.yields.poisson_ratio)
                         : Box::infinity;
    q.yield_load = m.mapping.force(r_eff) * x * std::sqrt(x);
    q.by_static = q.static_load > 0 ? limits.static_load * q.yield_load / q.static_load : Box::infinity;
    const std::string name = m.name_a + ":" + m.name_b;
    bind(q.by_overlap, fmt::format("overlap of {}", name));
    bind(q.by_time, fmt::format("contact duration of {}", name));
    bind(q.by_static, fmt::format("static load on {}", name));
    result.pairs.push_back(q);
  }
  result.stretch = std::max(1.0, two_digits_down(largest));
  const double s = result.stretch;
  // the deck's own stretch is in both; the new one takes its place
  result.time_step = s / scene.stretch * (scene.time_step > 0 ? scene.time_step : plan.time_step);
  result.modulus_factor = std::pow(s, -2.5);  // Hertz: t ~ E^-0.4
  for (const PairStretch& q : result.pairs) {
    const PairPlan& p = *q.pair;
    const Meeting& m = p.meeting;
    const double r_eff = m.wall ? plan.radius_min : 0.5 * plan.radius_min,
                 m_eff = m.wall ? plan.mass_min : 0.5 * plan.mass_min;
    result.overlap = std::max(result.overlap, s * p.overlap);
    result.static_ratio = std::max(result.static_ratio, s * q.static_load / q.yield_load);
    if (s * q.static_load > q.yield_load)
      result.extra_set = std::max(result.extra_set, s * (s * q.static_load - q.yield_load) /
                                                        (M_PI * 1.6 * m.yields.yield_stress * r_eff * r_eff));
    if (!m.known_yield || !m.yields.yields()) continue;
    Softening::Naive n;
    n.pair = m.name_a + ":" + m.name_b;
    n.speed = p.speed;
    n.basis = "law";
    n.e = restitution(options, m, r_eff, m_eff, p.speed, n.basis);
    Meeting soft = m;
    soft.yields.youngs_modulus *= result.modulus_factor;
    soft.mapping.e_star *= result.modulus_factor;
    n.e_naive = restitution(options, soft, r_eff, m_eff, p.speed, n.basis);
    result.naive.push_back(n);
  }
  return result;
}

}  // namespace granulaw::deck
