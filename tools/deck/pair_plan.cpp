#include "deck/pair_plan.hpp"

#include <algorithm>

#include "base/larger.hpp"
#include "base/scales.hpp"
#include "deck/hertz.hpp"
#include "deck/plan_options.hpp"
#include "law/contact_step.hpp"
#include "law/damage_number.hpp"

namespace granulaw::deck {

namespace {

void set_speed(PairPlan& p, const Encounter& e, const std::optional<Visited::Range>& visited)
{
  for (const SizedEncounter& size : e.sizes)
    if (p.speed_basis.empty() || size.approach.speed > p.speed) p.speed = size.approach.speed, p.speed_basis = size.approach.basis;
  if (visited) {
    p.visited = visited->met;
    p.speed = visited_margin * visited->speed;
    p.speed_basis = "visited";
  }
}

/// Onset and V_y of the sphere that stands for the pair, and the damage numbers.
void include_yield(PairPlan& p, const SizedEncounter& size)
{
  const Meeting& m = p.meeting;
  if (!m.yields.yields()) return;
  const double density = m.one_body_density(size.radius, size.mass), e_star = m.mapping.e_star, yield = m.yields.yield_stress;
  p.onset = std::min(p.onset, onset_velocity(e_star, yield, density, m.yields.poisson_ratio));
  p.yield_velocity = std::min(p.yield_velocity, granulaw::yield_velocity(e_star, yield, density));
  p.damage_number = granulaw::damage_number(m.yields, m.mapping, p.speed);
  p.axis_number = std::max(p.axis_number, density * p.speed * p.speed / yield);
}

void include_overlap(PairPlan& p, const SizedEncounter& size, double overlap, const std::string& basis)
{
  if (p.overlap_basis.empty() || overlap / size.radius > p.overlap) p.overlap_basis = basis;
  p.overlap = std::max(p.overlap, overlap / size.radius);
  p.depth = std::max(p.depth, overlap / p.meeting.mapping.length(size.radius));
}

/// Contact time and overlap of the fastest collision, and of the load: by the law where there is one, else by Hertz.
void include_collision(PairPlan& p, const SizedEncounter& size, const PlanOptions& options)
{
  const Meeting& m = p.meeting;
  if (p.speed > 0) {
    const double speed = p.speed_basis == "visited" ? p.speed : size.approach.speed;
    p.contact_time = std::min(p.contact_time, hertz_time(m.mapping.e_star_pair(), size.radius, size.mass, speed));
    const Overlap impact = overlap_of(options, m, size.radius, size.mass, speed);
    include_overlap(p, size, impact.value, impact.basis);
    if (m.known_yield && p.speed > p.onset) p.strain_rate = larger(p.strain_rate, dent_rate(speed, size.radius, impact.value));
  }
  if (p.speed_basis == "visited" || !(size.load.energy() > 0)) return;
  const Overlap pressed = overlap_of(options, m, size.radius, size.load.mass, size.load.speed);
  if (pressed.value / size.radius > p.overlap) include_overlap(p, size, pressed.value, "pressed");
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
void include_time_step(PairPlan& p, const SizedEncounter& size, const PlanOptions& options)
{
  if (!(p.overlap > 0)) return;
  const Meeting& m = p.meeting;
  const auto stiffness = [&](double overlap) {
    std::optional<double> by_law;
    if (options.stiffness && m.known_yield) by_law = options.stiffness(m, size.radius_a, size.radius_b, size.radius, overlap);
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
  set_speed(p, e, range);
  p.onset = p.yield_velocity = p.contact_time = p.time_step = Box::infinity;
  for (const SizedEncounter& size : e.sizes) {
    include_yield(p, size);
    include_collision(p, size, options);
  }
  const LawMaterial& yields = p.meeting.yields;
  const bool is_pressed_to_yield =
      p.overlap_basis == "pressed" && yields.yields() && p.depth > onset_overlap(p.meeting.mapping.e_star, yields.yield_stress, yields.poisson_ratio);
  p.needs_table = p.meeting.known_yield && (p.speed > p.onset || is_pressed_to_yield);
  if (range) include_visited_overlap(p, visited_margin * range->overlap / stretch);
  for (const SizedEncounter& size : e.sizes) include_time_step(p, size, options);
  return p;
}

}  // namespace granulaw::deck
