#include "deck/pair_plan.hpp"

#include <algorithm>

#include "base/scales.hpp"
#include "deck/geometry.hpp"
#include "deck/hertz.hpp"
#include "deck/plan_options.hpp"
#include "law/contact_step.hpp"
#include "law/damage_number.hpp"

namespace granulaw::deck {

namespace {

/// Radii, R*, m, and m*, kg, of two particles; of a wall the radius is infinite.
struct Effective
{
  double radius_a, radius_b, radius, mass;
};

/// Mass by the deck's own density: the materials file may have another one.
double mass_of(const AtomType& t, double radius)
{
  return t.density * ball_volume(radius);
}

/// At the extremes of both sizes.
std::vector<Effective> sizes(const Encounter& e)
{
  std::vector<Effective> result;
  for (const double ra : {e.a->radius_min, e.a->radius_max}) {
    const double ma = mass_of(*e.a, ra);
    if (!e.b) {
      result.push_back({ra, Box::infinity, ra, ma});
      continue;
    }
    for (const double rb : {e.b->radius_min, e.b->radius_max})
      result.push_back({ra, rb, effective_radius(ra, rb), effective_mass(ma, mass_of(*e.b, rb))});
  }
  return result;
}

void set_speed(PairPlan& p, const Encounter& e, const PlanOptions& options,
               const std::optional<Visited::Range>& visited)
{
  p.speed = e.approach.speed;
  p.speed_basis = e.approach.shielded ? "shielded fall" : "fall";
  if (options.speed) {
    p.speed = *options.speed;
    p.speed_basis = "given";
  }
  if (visited) {
    p.visited = visited->met;
    p.speed = visited_margin * visited->speed;
    p.speed_basis = "visited";
  }
}

/// Onset and V_y of the sphere that stands for the pair, and the damage numbers.
void include_yield(PairPlan& p, const Effective& size)
{
  const Meeting& m = p.meeting;
  if (!m.yields.yields()) return;
  const double density = m.one_body_density(size.radius, size.mass), e_star = m.mapping.e_star,
               yield = m.yields.yield_stress;
  p.onset = std::min(p.onset, onset_velocity(e_star, yield, density, m.yields.poisson_ratio));
  p.yield_velocity = std::min(p.yield_velocity, granulaw::yield_velocity(e_star, yield, density));
  p.damage_number = granulaw::damage_number(m.yields, m.mapping, p.speed);
  p.axis_number = std::max(p.axis_number, density * p.speed * p.speed / yield);
}

/// Contact time and overlap of the fastest collision: by the law where there is one, else by Hertz.
void include_collision(PairPlan& p, const Effective& size, const PlanOptions& options)
{
  if (p.speed <= 0) return;
  const Meeting& m = p.meeting;
  const double e_star = m.mapping.e_star_pair(), length = m.mapping.length(size.radius);
  p.contact_time = std::min(p.contact_time, hertz_time(e_star, size.radius, size.mass, p.speed));
  std::optional<Collision> collision;
  if (options.collide && m.known_yield) collision = options.collide(m, size.radius, size.mass, p.speed);
  const double depth =
      collision ? collision->depth : hertz_overlap(e_star, size.radius, size.mass, p.speed) / length;
  p.overlap_basis = collision ? collision->basis : "Hertz";
  p.depth = std::max(p.depth, depth);
  p.overlap = std::max(p.overlap, depth * length / size.radius);
}

/// A run may press a contact deeper than any impact goes.
void include_visited_overlap(PairPlan& p, double overlap)
{
  if (!(overlap > p.overlap)) return;
  const PairMapping& mapping = p.meeting.mapping;
  p.overlap = overlap;
  p.depth = overlap / (mapping.sqrt_lambda * mapping.sqrt_lambda);
  p.overlap_basis = "visited";
}

/// The step that the planned overlap allows, by the law where there is one, else by Hertz.
void include_time_step(PairPlan& p, const Effective& size, const PlanOptions& options)
{
  if (!(p.overlap > 0)) return;
  const Meeting& m = p.meeting;
  const auto stiffness = [&](double overlap) {
    std::optional<double> by_law;
    if (options.stiffness && m.known_yield)
      by_law = options.stiffness(m, size.radius_a, size.radius_b, size.radius, overlap);
    return by_law.value_or(hertz_stiffness(m.mapping.e_star_pair(), size.radius, overlap));
  };
  p.time_step = std::min(p.time_step, largest_step_to(p.overlap * size.radius, size.mass, stiffness));
}

}  // namespace

PairPlan plan_pair(const Encounter& e, const PlanOptions& options, double stretch, const Visited* visited)
{
  std::optional<Visited::Range> range;
  if (visited) range = visited->range(e.meeting.a, e.meeting.b, e.meeting.wall);
  PairPlan p;
  p.meeting = e.meeting;
  set_speed(p, e, options, range);
  p.onset = p.yield_velocity = p.contact_time = p.time_step = Box::infinity;
  for (const Effective& size : sizes(e)) {
    include_yield(p, size);
    include_collision(p, size, options);
  }
  p.needs_table = p.meeting.known_yield && p.speed > p.onset;
  if (range) include_visited_overlap(p, visited_margin * range->overlap / stretch);
  for (const Effective& size : sizes(e)) include_time_step(p, size, options);
  return p;
}

}  // namespace granulaw::deck
