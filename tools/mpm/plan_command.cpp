// mpm plan: what a LIGGGHTS deck needs of a contact law.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <set>

#include "adhesion_options.hpp"
#include "atlas/composed_law.hpp"
#include "atlas/law_from_atlas.hpp"
#include "base/error.hpp"
#include "command.hpp"
#include "deck/material_names.hpp"
#include "deck/tangential_need.hpp"
#include "deck_options.hpp"
#include "json_output.hpp"
#include "law/contact_step.hpp"
#include "law/error_bound.hpp"
#include "law/replay.hpp"
#include "own_files.hpp"

namespace granulaw {

namespace of_plan {

struct PlanRequest
{
  std::string deck;
  DeckOptions options;
  Attraction attraction;
  bool json = false;
};

using nlohmann::ordered_json;

std::string verdict(const deck::PairPlan& p)
{
  if (!p.visited) return "not met by the run";
  if (!p.meeting.known_yield) return "yield stress unknown";
  if (!p.needs_table) return p.meeting.yields.yields() ? "elastic below its onset: Hertz suffices" : "elastic: Hertz suffices";
  return "yields: table";
}

/// Material of an atom type: by its name in the materials file, else by the deck; null: no such name.
const LawMaterial* named_material(const PlannedDeck& d, int type)
{
  const auto named = d.options.materials.find(type);
  return named == d.options.materials.end() ? nullptr : &named->second;
}

ordered_json types_json(const PlannedDeck& d)
{
  ordered_json types = ordered_json::array();
  for (const auto& [type, m] : d.scene.materials) {
    ordered_json t{{"type", type}};
    if (m.youngs_modulus) t["youngs_modulus_Pa"] = *m.youngs_modulus;
    if (m.poisson_ratio) t["poisson_ratio"] = *m.poisson_ratio;
    if (const LawMaterial* named = named_material(d, type)) {
      t["material"] = printable(named->name);
      t["yield_stress_Pa"] = json_number(named->yield_stress);
    } else if (m.yield_stress) {
      t["yield_stress_Pa"] = *m.yield_stress;
    }
    types.push_back(t);
  }
  for (const deck::OtherDensity& other : deck::other_densities(d.scene, d.options))
    for (ordered_json& t : types)
      if (t["type"] == other.type) t["density_kg_per_m3"] = {{"deck", other.of_deck}, {"material", other.of_material}, {"reason", other.reason}};
  return types;
}

/// True if the pair's law is composed of two bodies' laws, if the atlas holds both.
bool is_unlike(const deck::PairPlan& p)
{
  const deck::Meeting& m = p.meeting;
  return p.needs_table && p.visited && (m.wall ? m.deformable : m.name_a != m.name_b);
}

/// Error of composing such a law; the errors of the two bodies' laws come on top.
ComposedError law_error(const deck::PairPlan& p) { return composed_error(1 / (p.meeting.mapping.sqrt_lambda - 1)); }

/// Error of e beyond which runs of the two bodies are worth their time.
constexpr double worth_runs = 0.01;

ordered_json pair_json(const deck::PairPlan& p)
{
  const auto known = [&](double value) { return p.meeting.known_yield ? json_number(value) : ordered_json(); };
  ordered_json error;  // null: the law is the body's own
  if (is_unlike(p)) {
    const ComposedError stated = law_error(p);
    error = {{"force", stated.force}, {"restitution", stated.restitution}, {"worth_own_law", stated.restitution > worth_runs && !p.meeting.wall}};
  }
  return {{"types", {p.meeting.a, p.meeting.b}}, {"wall", p.meeting.wall}, {"deformable_wall", p.meeting.deformable},
      {"materials", {printable(p.meeting.name_a), printable(p.meeting.name_b)}}, {"speed_max_m_per_s", json_number(p.speed)}, {"speed_by", p.speed_basis},
      {"onset_speed_m_per_s", known(p.onset)}, {"yield_velocity_m_per_s", known(p.yield_velocity)}, {"damage_number_max", json_number(p.damage_number)},
      {"inertia_number_max", json_number(p.damage_number)}, {"strain_rate_max_per_s", json_number(p.strain_rate)}, {"overlap_over_radius_max", json_number(p.overlap)}, {"overlap_by", p.overlap_basis},
      {"contact_time_min_s", json_number(p.contact_time)}, {"time_step_s", json_number(p.time_step)}, {"needs_table", p.needs_table}, {"law_error", error},
      {"verdict", verdict(p)}};
}

/// Adhesion of the smallest particles of a pair.
struct PairAdhesion
{
  double bond = 0;            ///< pull-off force of an undented contact over the weight; infinity: no gravity
  double sticking_speed = 0;  ///< m/s, below which they stick
  AdhesionNumbers numbers;    ///< of the deepest dent that is planned
  std::string refused;        ///< why `cohesion dent` would refuse them; empty: it does not

  bool matters(double speed) const { return bond > 1 || sticking_speed > 0.1 * speed; }
};

/// None: the yield stress, the size or the law is not known.
std::optional<PairAdhesion> adhesion_of(const PlannedDeck& d, const deck::PairPlan& p, const Attraction& attraction)
{
  static const std::optional<Atlas> atlas = own_atlas();
  if (!(attraction.work > 0) || !p.visited || !p.meeting.known_yield || !(d.plan.radius_min > 0) || !(d.plan.mass_min > 0) || !atlas) return {};
  const double share = p.meeting.wall ? 1.0 : 0.5, r_eff = share * d.plan.radius_min, m_eff = share * d.plan.mass_min, g = deck::norm(d.scene.gravity);
  try {
    const BodyLaw body = law_from(*atlas, p.meeting.yields, {.depth = std::max(0.1, std::min(0.5, 1.05 * p.depth))});
    const PairLaw pair{{&body.curve, p.meeting.mapping}, &body};
    const Tabulated law(pair, pair.measure(), {});
    const DentAdhesion piece(law, attraction.work, attraction.range);
    PairAdhesion found;
    found.bond = piece.smooth_pull_off(law, r_eff) / (d.plan.mass_min * g);
    found.numbers = piece.numbers(law, r_eff, p.overlap * r_eff);
    found.refused = piece.fault(law, r_eff);
    // of elastic spheres, Johnson, Kendall and Roberts; a dent sticks at higher speeds
    const double w = attraction.work, e_star = p.meeting.mapping.e_star_pair();
    double low = std::sqrt(2 * 7.09 * std::cbrt(std::pow(w, 5) * std::pow(r_eff, 4) / (e_star * e_star)) / m_eff), high = 100 * low;
    for (int k = 0; k < 16; ++k) {
      const double middle = std::sqrt(low * high);
      (replay_collision(pair, r_eff, m_eff, middle, 2000, {}, attraction).sticks ? low : high) = middle;
    }
    found.sticking_speed = low;
    return found;
  } catch (const Error&) {
    return {};  // beyond the atlas
  }
}

ordered_json adhesion_json(const PlannedDeck& d, const deck::PairPlan& p, const Attraction& attraction)
{
  const std::optional<PairAdhesion> found = adhesion_of(d, p, attraction);
  if (!found) return {};
  return {{"bond_number", json_number(found->bond)}, {"sticking_speed_m_per_s", found->sticking_speed}, {"W", found->numbers.W}, {"chi", found->numbers.chi}, {"S", found->numbers.S},
      {"tabor_number", found->numbers.tabor}, {"matters", found->matters(p.speed)}, {"refused", found->refused.empty() ? ordered_json() : ordered_json(found->refused)}};
}

void print_adhesion(const PlannedDeck& d, const Attraction& attraction)
{
  if (!(attraction.work > 0)) return;
  fmt::print("adhesion, w {:.3g} J/m2 over {:.3g} m, of the smallest particles; surfaces are taken as smooth: measured pull-off forces are often far lower\n", attraction.work,
      attraction.range);
  for (const deck::PairPlan& p : d.plan.pairs) {
    const std::optional<PairAdhesion> found = adhesion_of(d, p, attraction);
    if (!found) continue;
    const AdhesionNumbers& n = found->numbers;
    fmt::print("  {:<9} Bond number {:.3g}, sticks below {:.3g} m/s, W {:.2g}, chi {:.2g}, S {:.2g}, Tabor {:.2g}: {}\n", types_text(p.meeting), found->bond, found->sticking_speed, n.W,
        n.chi, n.S, n.tabor, !found->refused.empty() ? "refused: " + found->refused : found->matters(p.speed) ? "cohesion dent" : "does not matter");
  }
}

ordered_json cost_json(const PlannedDeck& d)
{
  return {{"particles", json_number(d.options.particles.value_or(d.scene.count()))}, {"particle_steps", json_number(d.plan.particle_steps)},
      {"rate_per_s", d.options.rate}, {"hours", json_number(d.plan.hours)},
      {"unknown_loop", d.plan.unknown_cost.empty() ? ordered_json() : ordered_json(printable(d.plan.unknown_cost))}};
}

ordered_json to_json(const PlannedDeck& d, const std::string& command, const Attraction& attraction)
{
  const deck::Plan& plan = d.plan;
  ordered_json pairs = ordered_json::array(), questions = ordered_json::array();
  for (const deck::PairPlan& p : plan.pairs) {
    pairs.push_back(pair_json(p));
    if (attraction.work > 0) pairs.back()["adhesion"] = adhesion_json(d, p, attraction);
  }
  for (const deck::Question& q : plan.questions) questions.push_back({{"what", printable(q.what)}, {"option", q.option}});
  ordered_json root;
  root["deck"] = printable(d.scene.deck);
  root["complete"] = plan.complete();
  root["radius_m"] = {json_number(plan.radius_min), json_number(plan.radius_max)};
  root["mass_kg"] = {json_number(plan.mass_min), json_number(plan.mass_max)};
  root["fall_m"] = json_number(plan.fall);
  root["types"] = types_json(d);
  root["pairs"] = pairs;
  root["velocity_axis_matters"] = plan.axis_matters;
  const deck::TangentialNeed need = deck::tangential_need(d.scene, plan);
  root["tangential"] = {{"law", need.pair ? "plastic" : "history"}, {"reason", need.reason}};
  root["time_step_s"] = {{"deck", json_number(d.scene.time_step)}, {"advised", json_number(plan.time_step)}};
  root["cost"] = cost_json(d);
  root["law_pairs"] = plan.law_pairs;
  root["pressing"] = plan.pressing.solid_volume > 0 ? ordered_json{{"solid_volume", plan.pressing.solid_volume}, {"overlap_over_radius", plan.pressing.overlap},
      {"pressure_over_yield_stress", plan.pressing.pressure}, {"time_step_s", plan.pressing.time_step}, {"needs_confinement", plan.pressing.needs_confinement()}, {"confinement", d.scene.confinement.empty() ? "off" : d.scene.confinement}} : ordered_json();
  root["beyond_laws"] = deck::beyond_laws(plan);
  root["not_bounded"] = plan.not_bounded;
  root["table_command"] = command.empty() ? ordered_json(nullptr) : ordered_json(printable(command));
  root["asks_for"] = questions;
  root["not_followed"] = d.scene.notes;
  return root;
}

bool differ(double a, double b)
{
  return std::abs(a / b - 1) > 1e-3;  // decks round to four figures
}

void print_type(const PlannedDeck& d, int type, const deck::TypeMaterial& m, const LawMaterial* named)
{
  const double stress = named ? named->yield_stress : m.yield_stress.value_or(-1);
  std::string yield = "yield stress not known";
  if (stress > 0) yield = std::isfinite(stress) ? fmt::format("Y {:.4g} Pa", stress) : "elastic";
  fmt::print("  type {}{}: E {:.4g} Pa, nu {:.3g}, {}\n", type, named ? " (" + printable(named->name) + ")" : "", *m.youngs_modulus, m.poisson_ratio.value_or(0), yield);
  if (!named) return;
  if (differ(named->youngs_modulus, *m.youngs_modulus)) fmt::print("    the materials file says E {:.4g} Pa: that is used\n", named->youngs_modulus);
  for (const deck::OtherDensity& other : deck::other_densities(d.scene, d.options))
    if (other.type == type) fmt::print("    {}\n", other.sentence());
}

void print_scene(const PlannedDeck& d)
{
  std::set<int> types;
  for (const deck::PairPlan& p : d.plan.pairs) types.insert(p.meeting.a);
  fmt::print("{}: {} particle types meet {} walls\n", printable(d.scene.deck), types.size(), d.scene.walls.size());
  if (d.plan.radius_max > 0)
    fmt::print("  radii {:.4g} to {:.4g} m, masses {:.4g} to {:.4g} kg; fall up to {:.4g} m under {:.4g} m/s^2\n", d.plan.radius_min, d.plan.radius_max, d.plan.mass_min,
        d.plan.mass_max, d.plan.fall, deck::norm(d.scene.gravity));
  for (const auto& [type, m] : d.scene.materials)
    if (m.has_moduli()) print_type(d, type, m, named_material(d, type));
}

constexpr const char* pair_row = "  {:<9} {:<18} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8}  {}\n";

void print_pair(const deck::PairPlan& p)
{
  const auto known = [&](double x) { return p.meeting.known_yield && std::isfinite(x) ? fmt::format("{:.3g}", x) : std::string("-"); };
  fmt::print(fmt::runtime(pair_row), types_text(p.meeting), printable(p.meeting.name_a + ":" + p.meeting.name_b), fmt::format("0..{:.3g}", p.speed), known(p.onset),
      known(p.speed / p.onset), known(p.speed / p.yield_velocity), known(p.damage_number), fmt::format("{:.3g}", p.overlap),
      p.overlap_basis.empty() ? "-" : p.overlap_basis, verdict(p));
}

/// Errors of the laws of unlike pairs.
void print_law_errors(const std::vector<deck::PairPlan>& pairs)
{
  for (const deck::PairPlan& p : pairs) {
    if (!is_unlike(p)) continue;
    const ComposedError stated = law_error(p);
    fmt::print("  {}:{}{}: composing the law adds an error of {} (95 % of collisions){}\n", printable(p.meeting.name_a), printable(p.meeting.name_b),
        p.meeting.wall ? " (deformable wall)" : "", ErrorBound{stated.force, stated.restitution}.text(),
        stated.restitution > worth_runs && !p.meeting.wall ? "; mpm table --correct-pairs corrects it by impacts" : "");
  }
}

void print_pairs(const PlannedDeck& d)
{
  if (!d.plan.pairs.empty()) {
    fmt::print("pairs that can meet (V: relative normal speed; yield begins at V_on; material 'wall': rigid)\n");
    fmt::print(fmt::runtime(pair_row), "types", "materials", "V m/s", "V_on m/s", "V/V_on", "V/V_y", "I", "d/R*", "by", "verdict");
  }
  for (const deck::PairPlan& p : d.plan.pairs) print_pair(p);
  print_law_errors(d.plan.pairs);
}

/// One line: which tangential law, and why.
void print_tangential(const PlannedDeck& d)
{
  const deck::TangentialNeed need = deck::tangential_need(d.scene, d.plan);
  fmt::print("tangential law: {} ({})\n", need.pair ? "plastic" : "history serves", need.reason);
}

/// One line: the strain rate of the impacts beside that of the test which the yield stress may be from.
void print_strain_rate(const deck::Plan& plan)
{
  double rate = 0;
  for (const deck::PairPlan& p : plan.pairs) rate = std::max(rate, p.strain_rate);
  constexpr double slow = 1e-3;  // 1/s, of a press or a hardness test
  if (!(rate > slow)) return;
  // Johnson and Cook's coefficients of 4340 and 1020 steel (docs/evidence/leeb.md); e follows Y by half or so
  const double least = 100 * 0.014 * std::log(rate / slow), most = 100 * 0.022 * std::log(rate / slow);
  fmt::print("strain rate: up to {:.2g} 1/s in impacts. A yield stress of a slow press or a hardness is too low for them, "
             "of steels by {:.0f} to {:.0f} %, e by half. Polymers and organics depend on the rate more\n",
      rate, least, most);
}

/// Requirements on the law and on the simulation.
void print_needs(const PlannedDeck& d)
{
  const deck::Plan& plan = d.plan;
  if (plan.damage_number > 0)
    fmt::print("axes of the law: overlap; velocity {}\n",
        plan.axis_matters ? fmt::format("(I up to {:.2g})", plan.damage_number) : fmt::format("not needed (I stays below {:g})", deck::negligible_damage_number));
  print_strain_rate(plan);
  if (plan.complete() && !plan.pairs.empty()) print_tangential(d);
  if (const deck::PairPlan* pair = plan.stiffest())
    fmt::print("time step: up to {} s (1/{:g} of the period of types {} at d/R* {:.3g}); the deck has {:.3g} s\n", step_text(plan.time_step), 1 / step_fraction,
        types_text(pair->meeting), pair->overlap, d.scene.time_step);
  if (d.scene.stretch > 1) fmt::print("stretch {:g}: in it; the deck's overlaps are {:g} times the d/R* above\n", d.scene.stretch, d.scene.stretch);
  if (!plan.unknown_cost.empty()) fmt::print("cost: not known (the loop of {})\n", printable(plan.unknown_cost));
  if (plan.particle_steps > 0) fmt::print("cost: {:.3g} particle-steps, {:.3g} hours at {:.3g} a second\n", plan.particle_steps, plan.hours, d.options.rate);
}

/// Deck lines that the plan could not follow, its questions, and the command that makes the law.
void print_next(const PlannedDeck& d, const std::string& command)
{
  if (const std::string pressed = deck::pressing_text(d.plan.pressing, d.scene.confinement); !pressed.empty()) fmt::print("pressed: {}\n", pressed);
  for (const std::string& sentence : deck::beyond_laws(d.plan)) fmt::print("beyond all laws: {}\n", printable(sentence));
  for (const std::string& what : d.plan.not_bounded) fmt::print("not bounded: {}\n", printable(what));
  for (const std::string& note : d.scene.notes) fmt::print("not followed: {}\n", note);
  if (!d.plan.complete()) fmt::print("not in the deck:\n{}", questions_text(d.plan));
  if (!command.empty())
    fmt::print("{}\n", printable(command));
  else if (d.plan.complete() && !d.plan.pairs.empty())
    fmt::print("no table is needed\n");
}

void plan(const PlanRequest& r)
{
  const PlannedDeck d = plan_deck(r.deck, r.options);
  const std::string command = deck::table_command(d.plan, r.options.materials_file);
  if (r.json) return print_json(to_json(d, command, r.attraction));
  print_scene(d);
  print_pairs(d);
  print_needs(d);
  print_adhesion(d, r.attraction);
  print_next(d, command);
}

void define(Options& command)
{
  const auto r = std::make_shared<PlanRequest>();
  command.add_option("DECK", r->deck, "LIGGGHTS input script").required();
  r->options.add_to(command, true);
  define_adhesion(command, r->attraction);
  command.add_flag("--json", r->json, "the plan as JSON");
  command.callback([r] { plan(*r); });
}

}  // namespace of_plan

extern const Command plan_command{"plan",
    "Requirements of a LIGGGHTS deck on a contact law: pairs, speeds, overlaps, time step, cost, and the mpm table\n"
    "command. LIGGGHTS reads the deck (liggghts-mpm). Numbers that the deck lacks are given as options\n"
    "(docs/guide/plan.md). Limits of the laws: docs/guide/limits.md.\n"
    "Example: mpm plan in.hopper --var model mpm --var scene out/scene --materials-file materials.toml",
    of_plan::define};

}  // namespace granulaw
