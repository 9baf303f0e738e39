#include "deck/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "law/law.hpp"
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

bool has_single_particle(const Scene& scene)
{
  return scene.sources.size() == 1 && scene.sources[0].count == 1 && scene.unknown_particles.empty();
}

/// Particles of each two types.
void add_particle_pairs(std::vector<Encounter>& encounters, const Scene& scene, const AtomTypes& types,
                        const SpeedBound& speeds)
{
  for (auto a = types.begin(); a != types.end(); ++a)
    for (auto b = a; b != types.end(); ++b) {
      if (a == b && has_single_particle(scene)) continue;
      encounters.push_back({meeting_of(a->second, b->second),
                            &a->second,
                            &b->second,
                            {speeds.between(a->first, b->first), false}});
    }
}

/// Walls of one type, either all rigid or all deformable: a particle meets them as one body.
struct WallKind
{
  int type;
  bool deformable;
  auto operator<=>(const WallKind&) const = default;
};

/// The fastest approach of a particle of this type to each kind of wall.
std::map<WallKind, SpeedBound::Approach> approaches(const SpeedBound& speeds, int type)
{
  std::map<WallKind, SpeedBound::Approach> fastest;
  for (const Wall* w : speeds.walls()) {
    const SpeedBound::Approach approach = speeds.to(*w, type);
    const auto [found, is_new] = fastest.try_emplace({w->type, w->deformable}, approach);
    if (!is_new && approach.speed > found->second.speed) found->second = approach;
  }
  return fastest;
}

/// The types of the walls whose material gives way, as far as they are known. Asks for their moduli.
AtomTypes deformable_walls(const Scene& scene, const SpeedBound& speeds, const PlanOptions& options,
                           std::vector<Question>& questions)
{
  AtomTypes walls;
  for (const Wall* w : speeds.walls())
    if (w->deformable)
      if (const auto wall = wall_type(scene, w->type, options, questions)) walls.emplace(w->type, *wall);
  return walls;
}

/// Particles of each type with each kind of wall.
void add_wall_pairs(std::vector<Encounter>& encounters, const AtomTypes& types, const AtomTypes& walls,
                    const SpeedBound& speeds)
{
  for (const auto& [type, t] : types)
    for (const auto& [kind, approach] : approaches(speeds, type)) {
      if (!kind.deformable)
        encounters.push_back({meeting_with_rigid_wall(t, kind.type), &t, nullptr, approach});
      else if (const auto wall = walls.find(kind.type); wall != walls.end())
        encounters.push_back({meeting_with_wall(t, wall->second), &t, nullptr, approach});
    }
}

void ask_for_yield_stresses(const AtomTypes& types, const AtomTypes& walls, std::vector<Question>& questions)
{
  std::set<int> unknown;
  for (const AtomTypes* bodies : {&types, &walls})
    for (const auto& [type, t] : *bodies)
      if (!t.known_yield) unknown.insert(type);
  for (const int type : unknown)
    ask(questions, fmt::format("the yield stress of type {}", type),
        "--materials-file FILE --materials NAME...");
}

/// To two digits.
double rounded_up(double x)
{
  if (x <= 0) return 0.0;
  const double unit = std::pow(10.0, std::floor(std::log10(x)) - 1);
  return std::ceil(x / unit) * unit;
}

/// The axes of the table: a fifth more than foreseen, as far as a table goes.
void set_axes(Plan& plan)
{
  constexpr double margin = 1.2;
  double depth = 0, damage_number = 0;
  for (const PairPlan& p : plan.pairs) {
    if (!p.needs_table || !p.visited) continue;
    depth = std::max(depth, p.depth);
    damage_number =
        std::max({damage_number, p.damage_number, p.axis_number});  // the pair rule's axis is the latter
  }
  plan.axis_matters = damage_number > negligible_damage_number;
  plan.depth = std::min(deepest_law, rounded_up(margin * depth));
  plan.damage_number = std::min(fastest_law, rounded_up(margin * damage_number));
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
  if (steps > 0 && plan.particle_steps == 0)
    ask(plan.questions, "how many particles there are", "--particles N");
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

  std::vector<Encounter> encounters;
  add_particle_pairs(encounters, scene, types, speeds);
  add_wall_pairs(encounters, types, walls, speeds);
  for (const Encounter& e : encounters) plan.pairs.push_back(plan_pair(e, options, scene.stretch, visited));
  plan.law_pairs = pairs_of_law(types, walls);
  set_axes(plan);
  set_time_step(plan, scene.stretch);
  set_cost(plan, scene, options);
  return plan;
}

const PairPlan* Plan::stiffest() const
{
  const auto found =
      std::min_element(pairs.begin(), pairs.end(),
                       [](const PairPlan& a, const PairPlan& b) { return a.time_step < b.time_step; });
  return found != pairs.end() && std::isfinite(found->time_step) ? &*found : nullptr;
}

std::vector<std::string> beyond_laws(const Plan& plan)
{
  std::vector<std::string> sentences;
  for (const PairPlan& p : plan.pairs) {
    if (!p.visited || !p.meeting.known_yield || !p.meeting.yields.yields()) continue;
    if (!(p.depth > deepest_law || p.damage_number > fastest_law)) continue;
    sentences.push_back(fmt::format(
        "{}:{} reaches delta/R {:.3g} and I {:.3g} in the deck, and laws end at {:g} and {:g}: the material is too soft for "
        "these speeds; where its youngs_modulus is lowered for the time step, give the real one (docs/guide/plan.md#soften)",
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
    if (!p.meeting.wall)
      sizes.radius_ratio = std::min(largest_radius_ratio, plan.radius_max / plan.radius_min);
  }
  return sizes;
}

std::string table_command(const Plan& plan, const std::string& materials_file)
{
  if (plan.depth <= 0) return {};
  std::string pairs;
  for (const std::string& pair : plan.law_pairs) pairs += " --pair " + pair;
  const PairSizes sizes = pair_sizes(plan);
  return fmt::format("mpm table {}{} --depth {:.3g} --damage-number {:.3g}{}{} -o law.h5",
                     materials_file.empty() ? "MATERIALS.toml" : materials_file, pairs, plan.depth,
                     plan.damage_number,
                     sizes.radius_ratio > 1 ? fmt::format(" --radius-ratio {:.4g}", sizes.radius_ratio) : "",
                     sizes.thick_walls ? "" : " --no-thick-walls");
}

}  // namespace granulaw::deck
