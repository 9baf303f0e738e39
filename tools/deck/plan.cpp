#include "deck/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "deck/digits.hpp"
#include "law/law.hpp"
#include "law/plan_notes.hpp"
#include "law/range.hpp"

namespace granulaw::deck {

namespace {

using AtomTypes = std::map<int, AtomType>;

/// Radii and masses of all particles.
void set_sizes(Plan& plan, const AtomTypes& types)
{
  const auto mass = [](const AtomType& t, double radius) { return t.density * ball_volume(radius); };
  plan.radius_min = plan.mass_min = types.empty() ? 0 : Box::infinity;
  for (const auto& [type, t] : types) {
    plan.radius_min = std::min(plan.radius_min, t.radius_min);
    plan.radius_max = std::max(plan.radius_max, t.radius_max);
    plan.mass_min = std::min(plan.mass_min, mass(t, t.radius_min));
    plan.mass_max = std::max(plan.mass_max, mass(t, t.radius_max));
  }
}

bool has_single_particle(const Scene& scene) { return scene.sources.size() == 1 && scene.sources[0].count == 1 && scene.unknown_particles.empty(); }

/// Particles of each two types.
void add_particle_pairs(std::vector<Encounter>& encounters, const Scene& scene, const AtomTypes& types, const Strikes& strikes)
{
  for (auto a = types.begin(); a != types.end(); ++a)
    for (auto b = a; b != types.end(); ++b) {
      if (a == b && has_single_particle(scene)) continue;
      Encounter& e = encounters.emplace_back(Encounter{meeting_of(a->second, b->second), {}});
      for (const Body* i : strikes.bodies(a->first))
        for (const Body* j : strikes.bodies(b->first))
          e.sizes.push_back(
              {i->radius, j->radius, effective_radius(i->radius, j->radius), effective_mass(i->mass, j->mass), strikes.between(*i, *j), strikes.load_between(*i, *j)});
    }
}

/// Walls of one type, either all rigid or all deformable: a particle meets them as one body.
struct WallKind
{
  int type;
  bool deformable;
  auto operator<=>(const WallKind&) const = default;
};

std::map<WallKind, std::vector<const Wall*>> kinds_of_walls(const SpeedBound& speeds)
{
  std::map<WallKind, std::vector<const Wall*>> kinds;
  for (const Wall* w : speeds.walls()) kinds[{w->type, w->deformable}].push_back(w);
  return kinds;
}

/// The types of the walls whose material gives way, as far as they are known. Asks for their moduli.
AtomTypes deformable_walls(const Scene& scene, const SpeedBound& speeds, const PlanOptions& options, std::vector<Question>& questions)
{
  AtomTypes walls;
  for (const Wall* w : speeds.walls())
    if (w->deformable)
      if (const auto wall = wall_type(scene, w->type, options, questions)) walls.emplace(w->type, *wall);
  return walls;
}

/// Particles of each type with each kind of wall.
void add_wall_pairs(std::vector<Encounter>& encounters, const AtomTypes& types, const AtomTypes& walls, const SpeedBound& speeds, const Strikes& strikes)
{
  const auto add = [&](const Meeting& meeting, const std::vector<const Wall*>& of_kind) {
    Encounter& e = encounters.emplace_back(Encounter{meeting, {}});
    for (const Body* body : strikes.bodies(meeting.a))
      e.sizes.push_back({body->radius, Box::infinity, body->radius, body->mass, strikes.to(of_kind, *body), strikes.load_at(of_kind, *body)});
  };
  for (const auto& [type, t] : types)
    for (const auto& [kind, of_kind] : kinds_of_walls(speeds)) {
      if (!kind.deformable)
        add(meeting_with_rigid_wall(t, kind.type), of_kind);
      else if (const auto wall = walls.find(kind.type); wall != walls.end())
        add(meeting_with_wall(t, wall->second), of_kind);
    }
}

void ask_for_yield_stresses(const AtomTypes& types, const AtomTypes& walls, std::vector<Question>& questions)
{
  std::set<int> unknown;
  for (const AtomTypes* bodies : {&types, &walls})
    for (const auto& [type, t] : *bodies)
      if (!t.known_yield) unknown.insert(type);
  for (const int type : unknown) ask(questions, fmt::format("the yield stress of type {}", type), "--materials-file FILE --materials NAME...");
}

/// The axes of the table: a fifth more than foreseen, as far as a table goes.
void set_axes(Plan& plan)
{
  constexpr double margin = 1.2;
  double depth = 0, damage_number = 0;
  for (const PairPlan& p : plan.pairs) {
    if (!p.needs_table || !p.visited) continue;
    depth = std::max(depth, p.depth);
    damage_number = std::max({damage_number, p.damage_number, p.axis_number});  // the pair rule's axis is the latter
  }
  plan.axis_matters = damage_number > negligible_damage_number;
  if (depth > 0) plan.depth = std::clamp(rounded_up(margin * depth), shallowest_table, deepest_law);
  if (damage_number > 0) plan.damage_number = std::min(fastest_law, rounded_up(margin * damage_number));
}

/// A wall in motion does any work, and gravity along a periodic direction as well.
void note_unbounded(Plan& plan, const Scene& scene, const AtomTypes& types, const SpeedBound& speeds, const Strikes& strikes)
{
  for (const auto& [type, t] : types) {
    double slip = 0;
    for (const Body* body : strikes.bodies(type)) slip = std::max(slip, strikes.slip_speed(*body));
    const bool is_fastest = std::any_of(
        plan.pairs.begin(), plan.pairs.end(), [touching = type](const PairPlan& p) { return p.meeting.wall && p.meeting.a == touching && p.speed_basis == "slip"; });
    if (is_fastest)
      plan.not_bounded.push_back(
          fmt::format("speeds between particles where one of type {} slips out from under a heavier one; it leaves with up to {:.3g} m/s", type, slip));
  }
  std::vector<std::string> moving;
  for (const Wall* w : speeds.walls())
    if (w->push_speed > 0) moving.push_back(fmt::format("'{}' ({})", w->id, w->where));
  if (!moving.empty() && !plan.pressing.needs_confinement())
    plan.not_bounded.push_back(fmt::format("overlaps where {} {} particles against others or a wall", fmt::join(moving, ", "), moving.size() == 1 ? "presses" : "press"));
  for (std::size_t k = 0; k < 3; ++k)
    if (scene.periodic[k] && std::abs(speeds.upward()[k]) > 1e-3)
      plan.not_bounded.push_back(fmt::format("speeds along {}, a periodic direction with gravity: those of one length of the box stand above", "xyz"[k]));
}

void set_time_step(Plan& plan, double stretch)
{
  if (const PairPlan* pair = plan.stiffest()) plan.time_step = stretch * pair->time_step;
}

void set_cost(Plan& plan, const Scene& scene, const PlanOptions& options)
{
  double steps = 0;
  for (const Run& r : scene.runs) {
    plan.particle_steps += r.steps * options.particles.value_or(r.particles);
    steps += r.steps;
  }
  if (steps > 0 && plan.particle_steps == 0) ask(plan.questions, "how many particles there are", "--particles N");
  plan.unknown_cost = scene.left_loop;
  if (!plan.unknown_cost.empty()) plan.particle_steps = std::nan("");
  plan.hours = plan.particle_steps / options.rate / 3600;
}

/// Each two particle materials, and each with the rigid wall and with the deformable walls.
std::vector<std::string> pairs_of_law(const AtomTypes& types, const AtomTypes& walls)
{
  const auto names_of = [](const AtomTypes& bodies) {
    std::set<std::string> names;
    for (const auto& [type, t] : bodies)
      if (t.material.name != elastic_name) names.insert(t.material.name);
    return names;
  };
  const std::set<std::string> particles = names_of(types);
  std::set<std::string> bodies = names_of(walls);
  bodies.insert(particles.begin(), particles.end());
  std::vector<std::string> pairs;
  for (const std::string& a : particles) {
    for (const std::string& b : bodies)
      if (std::find(pairs.begin(), pairs.end(), b + ":" + a) == pairs.end()) pairs.push_back(a + ":" + b);
    pairs.push_back(a + ":" + wall_name);
  }
  return pairs;
}

/// 0.05 R/c*, which holds at E*/Y of 30 to 100, or the 0.01 of 1000 where it is over 200 (docs/guide/pressing.md).
double confined_step(const AtomTypes& types)
{
  double step = std::numeric_limits<double>::infinity();
  for (const auto& [type, t] : types)
    if (t.material.yields() && t.density > 0)
      step = std::min(step, (t.material.e_star() > 200 * t.material.yield_stress ? 0.01 : 0.05) * t.radius_min * std::sqrt(t.density / t.material.e_star()));
  return std::isfinite(step) ? step : 0;
}

}  // namespace

Plan make_plan(const Scene& scene, const PlanOptions& options, const Visited* visited)
{
  Plan plan;
  const AtomTypes types = particle_types(scene, options, plan.questions);
  set_sizes(plan, types);

  const SpeedBound speeds(scene, types, options);
  if (!options.speed && !visited) speeds.ask_for_missing(plan.questions);
  plan.fall = speeds.fall();

  AtomTypes walls;
  if (!types.empty()) walls = deformable_walls(scene, speeds, options, plan.questions);
  ask_for_yield_stresses(types, walls, plan.questions);

  const Strikes strikes(speeds, scene, types, walls, options);
  std::vector<Encounter> encounters;
  add_particle_pairs(encounters, scene, types, strikes);
  add_wall_pairs(encounters, types, walls, speeds, strikes);
  for (const Encounter& e : encounters) plan.pairs.push_back(plan_pair(e, options, scene.stretch, visited));
  plan.pressing = pressing_to(scene.solid_volume);
  plan.pressing.time_step = confined_step(types);
  if (plan.pressing.needs_confinement() && !visited)  // a press goes to the end of any law
    for (PairPlan& p : plan.pairs)
      if (p.meeting.known_yield && p.meeting.yields.yields()) p.needs_table = true, p.depth = deepest_law;
  plan.law_pairs = pairs_of_law(types, walls);
  set_axes(plan);
  if (!visited) note_unbounded(plan, scene, types, speeds, strikes);
  set_time_step(plan, scene.stretch);
  set_cost(plan, scene, options);
  return plan;
}

Pressing pressing_to(double solid_volume)
{
  // 30 spheres, E*/Y = 100, friction 0.3, resolved (docs/evidence/packings.md): stress over Y
  constexpr std::array<std::array<double, 2>, 9> measured{
      {{0.58, 0}, {0.63, 0.08}, {0.68, 0.18}, {0.73, 0.29}, {0.78, 0.41}, {0.83, 0.55}, {0.88, 0.73}, {0.93, 1.0}, {0.98, 1.46}}};
  Pressing found{.solid_volume = solid_volume, .overlap = std::max(0.0, 1 - std::cbrt(measured[0][0] / std::max(solid_volume, 1e-9))), .pressure = 0};
  std::size_t k = 1;
  while (k + 1 < measured.size() && solid_volume > measured[k][0]) ++k;  // the last piece goes on
  const auto [density, stress] = measured[k];
  const auto [before, less] = measured[k - 1];
  found.pressure = std::max(0.0, less + (stress - less) * (solid_volume - before) / (density - before));
  return found;
}

std::string pressing_text(const Pressing& pressing, const std::string& confinement)
{
  if (!(pressing.solid_volume > 0)) return {};
  if (!pressing.needs_confinement()) return fmt::format("to a solid fraction of {:.2f}: laws of one contact hold up to 0.60", pressing.solid_volume);
  return fmt::format("to a solid fraction of {:.2f} (overlaps of about {:.2f} R, mean pressure of about {:.2g} Y), and laws of one contact end at 0.60: {}{}",
      pressing.solid_volume, pressing.overlap, pressing.pressure,
      confinement.empty() ? "say 'confinement auto', up to 4 times Hertz's loop (docs/guide/pressing.md)" : fmt::format("the deck says 'confinement {}'", confinement),
      pressing.time_step > 0 ? fmt::format(", time step up to {:.2g} s", pressing.time_step) : "");
}

const PairPlan* Plan::stiffest() const
{
  const auto found = std::min_element(pairs.begin(), pairs.end(), [](const PairPlan& a, const PairPlan& b) { return a.time_step < b.time_step; });
  return found != pairs.end() && std::isfinite(found->time_step) ? &*found : nullptr;
}

void note_plan(Law& law, const Plan& plan, const std::string& deck)
{
  law.provenance[deck_note] = deck;
  for (const PairPlan& p : plan.pairs)
    if (p.visited) note_planned(law, p.meeting.name_a, p.meeting.name_b, p.overlap, p.speed);
}

std::vector<std::string> beyond_laws(const Plan& plan)
{
  std::vector<std::string> sentences;
  for (const PairPlan& p : plan.pairs) {
    if (!p.visited || !p.meeting.known_yield || !p.meeting.yields.yields()) continue;
    if (!(p.depth > deepest_law || p.damage_number > fastest_law)) continue;
    sentences.push_back(fmt::format(
        "{}:{} reaches delta/R {:.3g} and I {:.3g} in the deck, and laws end at {:g} and {:g}: the material is too soft for these speeds; where its youngs_modulus is lowered for the time step, give the real one (docs/guide/plan.md#soften)",
        p.meeting.name_a, p.meeting.name_b, p.depth, p.damage_number, deepest_law, fastest_law));
  }
  return sentences;
}

PairSizes pair_sizes(const Plan& plan)
{
  PairSizes sizes;
  for (const PairPlan& p : plan.pairs) {
    if (!p.needs_table || !p.visited) continue;
    sizes.thick_walls = sizes.thick_walls || p.meeting.deformable;
    if (!p.meeting.wall) sizes.radius_ratio = std::min(largest_radius_ratio, plan.radius_max / plan.radius_min);
  }
  return sizes;
}

std::string table_command(const Plan& plan, const std::string& materials_file)
{
  if (plan.depth <= 0) return {};
  std::string pairs;
  for (const std::string& pair : plan.law_pairs) pairs += " --pair " + pair;
  const PairSizes sizes = pair_sizes(plan);
  return fmt::format("mpm table {}{} --depth {:.3g} --damage-number {:.3g}{}{} -o law.h5", materials_file.empty() ? "MATERIALS.toml" : materials_file, pairs, plan.depth,
      plan.damage_number, sizes.radius_ratio > 1 ? fmt::format(" --radius-ratio {:.4g}", sizes.radius_ratio) : "", sizes.thick_walls ? "" : " --no-thick-walls");
}

}  // namespace granulaw::deck
