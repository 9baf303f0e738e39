#include "deck/soften.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/scales.hpp"
#include "contact/thornton.hpp"
#include "deck/digits.hpp"
#include "deck/hertz.hpp"

namespace granulaw::deck {

namespace {

/// R*, m, and m*, kg, of a sphere and its like, or a plane.
struct EffectiveBody
{
  double radius, mass;
};

EffectiveBody smallest(const Plan& plan, const Meeting& m)
{
  return m.wall ? EffectiveBody{plan.radius_min, plan.mass_min} : EffectiveBody{0.5 * plan.radius_min, 0.5 * plan.mass_min};
}

EffectiveBody largest(const Plan& plan, const Meeting& m)
{
  return m.wall ? EffectiveBody{plan.radius_max, plan.mass_max} : EffectiveBody{0.5 * plan.radius_max, 0.5 * plan.mass_max};
}

std::string name_of(const Meeting& m) { return m.name_a + ":" + m.name_b; }

/// Volume of all particles, m^3.
double solid_volume(const Scene& scene, const Plan& plan, const PlanOptions& options)
{
  double volume = 0;
  for (const Source& s : scene.sources) volume += s.count * ball_volume(0.5 * (s.radius_min + s.radius_max));
  return volume > 0 ? volume : options.particles.value_or(0) * ball_volume(plan.radius_max);
}

/// Area, seen along gravity, of the box that walls and domain enclose, m^2; 0: it has none.
double ground_area(const Scene& scene)
{
  Box ground;
  for (const Wall& w : scene.walls) ground.include(w.box);
  if (!scene.domain.empty()) ground = ground.empty() ? scene.domain : ground.within(scene.domain);
  const double g = norm(scene.gravity);
  if (ground.empty() || g == 0) return 0;
  const Vec3 size = ground.size(), n = 1 / g * scene.gravity;
  return std::abs(n[0]) * size[1] * size[2] + std::abs(n[1]) * size[0] * size[2] + std::abs(n[2]) * size[0] * size[1];
}

/// Height of the bed if all particles lie on the ground, m.
double bed_height(const Scene& scene, const Plan& plan, const PlanOptions& options, double solid_fraction)
{
  const double area = ground_area(scene);
  if (!(area > 0) || !std::isfinite(area)) return 0;
  return solid_volume(scene, plan, options) / solid_fraction / area;
}

/// The flow's own time, s: the fall through one radius, or the walls' time over a diameter; infinity:
/// neither.
double flow_time(const Scene& scene, double diameter)
{
  const double g = norm(scene.gravity);
  double wall_speed = 0;
  for (const Wall& w : scene.walls) wall_speed = std::max({wall_speed, w.speed, w.drag_speed});
  double time = g > 0 ? std::sqrt(diameter / g) : Box::infinity;
  if (wall_speed > 0) time = std::min(time, diameter / wall_speed);
  return time;
}

/// F_y, N: Hertz's force at the overlap where yield begins; infinity: elastic.
double yield_load(const Meeting& m, double r_eff)
{
  if (!m.yields.yields()) return Box::infinity;
  const double x = onset_overlap(m.mapping.e_star, m.yields.yield_stress, m.yields.poisson_ratio);
  return m.mapping.force(r_eff) * x * std::sqrt(x);
}

/// Stretch of one pair within the limits.
PairStretch stretch_of(const PairPlan& p, const Plan& plan, const Softening& scene, double g, const SoftenLimits& limits)
{
  const Meeting& m = p.meeting;
  const double diameter = 2 * plan.radius_min, density = plan.mass_min / ball_volume(plan.radius_min);
  PairStretch q;
  q.pair = &p;
  q.slow_speed = g > 0 ? std::min(p.speed, std::sqrt(2 * g * diameter)) : p.speed;
  const EffectiveBody large = largest(plan, m);
  q.contact_time = hertz_time(m.mapping.e_star_pair(), large.radius, large.mass, q.slow_speed);
  q.static_load = limits.solid_fraction * density * g * scene.fill_height * diameter * diameter;
  q.yield_load = yield_load(m, smallest(plan, m).radius);
  const double time = std::isfinite(scene.flow_time) ? scene.flow_time : diameter / p.speed;
  q.by_overlap = p.overlap > 0 ? limits.overlap / p.overlap : Box::infinity;
  q.by_time = limits.time_fraction * time / q.contact_time;
  q.by_static = q.static_load > 0 ? limits.static_load * q.yield_load / q.static_load : Box::infinity;
  return q;
}

/// The smallest of all bounds, and which one it is.
void set_stretch(Softening& result)
{
  double bound = 1000;  // what the plug-in takes
  result.bound = "the plug-in's largest stretch";
  const auto include = [&](double s, const char* limit, const PairStretch& q) {
    if (!(s < bound)) return;
    bound = s;
    result.bound = fmt::format("{} {}", limit, name_of(q.pair->meeting));
  };
  for (const PairStretch& q : result.pairs) {
    include(q.by_overlap, "overlap of", q);
    include(q.by_time, "contact duration of", q);
    include(q.by_static, "static load on", q);
  }
  result.stretch = std::max(1.0, rounded_down(bound));
}

/// Largest overlap, and load and plastic set at the bed's bottom, under the stretch.
void include_loads(Softening& result, const PairStretch& q, double r_eff)
{
  const double s = result.stretch, load = s * q.static_load;
  result.overlap = std::max(result.overlap, s * q.pair->overlap);
  result.static_ratio = std::max(result.static_ratio, load / q.yield_load);
  if (load > q.yield_load) {
    const double yield_pressure = customary_yield_pressure * q.pair->meeting.yields.yield_stress;
    result.extra_set = std::max(result.extra_set, s * (load - q.yield_load) / (M_PI * yield_pressure * r_eff * r_eff));
  }
}

/// e by the law at hand, else by Thornton's closed form.
double restitution(const PlanOptions& options, const Meeting& m, const EffectiveBody& size, double speed, std::string& basis)
{
  if (options.collide)
    if (const auto collision = options.collide(m, size.radius, size.mass, speed)) {
      basis = collision->basis;
      return collision->restitution;
    }
  basis = "Thornton";
  if (!m.yields.yields()) return 1;
  const double density = m.one_body_density(size.radius, size.mass);
  return thornton_restitution(speed / yield_velocity(m.mapping.e_star, m.yields.yield_stress, density));
}

/// The pair with Young's modulus lowered to the same time step.
Softening::Naive lowered_modulus(const PairPlan& p, const EffectiveBody& size, double modulus_factor, const PlanOptions& options)
{
  Softening::Naive n;
  n.pair = name_of(p.meeting);
  n.speed = p.speed;
  n.basis = "law";
  n.e = restitution(options, p.meeting, size, p.speed, n.basis);
  Meeting soft = p.meeting;
  soft.yields.youngs_modulus *= modulus_factor;
  soft.mapping.e_star *= modulus_factor;
  n.e_naive = restitution(options, soft, size, p.speed, n.basis);
  return n;
}

}  // namespace

Softening soften(const Scene& scene, const Plan& plan, const PlanOptions& options, const SoftenLimits& limits)
{
  Softening result;
  result.fill_height = limits.fill_height > 0 ? limits.fill_height : bed_height(scene, plan, options, limits.solid_fraction);
  result.flow_time = flow_time(scene, 2 * plan.radius_min);
  for (const PairPlan& p : plan.pairs)
    if (p.visited && p.speed > 0) result.pairs.push_back(stretch_of(p, plan, result, norm(scene.gravity), limits));
  set_stretch(result);
  // the deck's own stretch is in both; its step may be shorter for other reasons than contacts
  const double step = scene.time_step > 0 ? std::min(plan.time_step, scene.time_step) : plan.time_step;
  result.time_step = result.stretch / scene.stretch * step;
  result.modulus_factor = std::pow(result.stretch, -2.5);  // Hertz: t ~ E^-0.4
  for (const PairStretch& q : result.pairs) {
    const Meeting& m = q.pair->meeting;
    const EffectiveBody small = smallest(plan, m);
    include_loads(result, q, small.radius);
    if (m.known_yield && m.yields.yields()) result.naive.push_back(lowered_modulus(*q.pair, small, result.modulus_factor, options));
  }
  return result;
}

}  // namespace granulaw::deck
