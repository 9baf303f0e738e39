// mpm plan: what a LIGGGHTS deck needs of a contact law.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <set>

#include "base/error.hpp"
#include "commands.hpp"
#include "deck_options.hpp"

namespace granulaw {

namespace {

struct PlanRequest
{
  std::string deck;
  DeckOptions options;
  bool json = false;
};

using nlohmann::ordered_json;

std::string verdict(const deck::PairPlan& p)
{
  if (!p.visited) return "not met by the run";
  if (!p.meeting.known_yield) return "yield stress unknown";
  if (!p.needs_table)
    return p.meeting.yields.yields() ? "elastic below its onset: Hertz suffices" : "elastic: Hertz suffices";
  return "yields: table";
}

ordered_json to_json(const PlannedDeck& d, const std::string& command)
{
  const deck::Plan& plan = d.plan;
  ordered_json root;
  root["deck"] = printable(d.scene.deck);
  root["complete"] = plan.complete();
  root["radius_m"] = {json_number(plan.radius_min), json_number(plan.radius_max)};
  root["mass_kg"] = {json_number(plan.mass_min), json_number(plan.mass_max)};
  root["fall_m"] = json_number(plan.fall);
  ordered_json types = ordered_json::array();
  for (const auto& [type, m] : d.scene.materials) {
    ordered_json t{{"type", type}};
    if (m.youngs_modulus) t["youngs_modulus_Pa"] = *m.youngs_modulus;
    if (m.poisson_ratio) t["poisson_ratio"] = *m.poisson_ratio;
    if (const auto named = d.options.materials.find(type); named != d.options.materials.end()) {
      t["material"] = printable(named->second.name);
      t["yield_stress_Pa"] = json_number(named->second.yield_stress);
    } else if (m.yield_stress) {
      t["yield_stress_Pa"] = *m.yield_stress;
    }
    types.push_back(t);
  }
  root["types"] = types;
  ordered_json pairs = ordered_json::array();
  for (const deck::PairPlan& p : plan.pairs) {
    pairs.push_back(
        {{"types", {p.meeting.a, p.meeting.b}},
         {"wall", p.meeting.wall},
         {"deformable_wall", p.meeting.deformable},
         {"materials", {printable(p.meeting.name_a), printable(p.meeting.name_b)}},
         {"speed_max_m_per_s", json_number(p.speed)},
         {"speed_by", p.speed_basis},
         {"onset_speed_m_per_s", p.meeting.known_yield ? json_number(p.onset) : ordered_json(nullptr)},
         {"yield_velocity_m_per_s",
          p.meeting.known_yield ? json_number(p.yield_velocity) : ordered_json(nullptr)},
         {"damage_number_max", json_number(p.damage_number)},
         {"inertia_number_max", json_number(p.damage_number)},
         {"overlap_over_radius_max", json_number(p.overlap)},
         {"overlap_by", p.overlap_basis},
         {"contact_time_min_s", json_number(p.contact_time)},
         {"needs_table", p.needs_table},
         {"verdict", verdict(p)}});
  }
  root["pairs"] = pairs;
  root["velocity_axis_matters"] = plan.axis_matters;
  root["time_step_s"] = {{"deck", json_number(d.scene.time_step)}, {"advised", json_number(plan.time_step)}};
  root["cost"] = {{"particles", json_number(d.options.particles.value_or(d.scene.count()))},
                  {"particle_steps", json_number(plan.particle_steps)},
                  {"rate_per_s", d.options.rate},
                  {"hours", json_number(plan.hours)}};
  root["table_command"] = command.empty() ? ordered_json(nullptr) : ordered_json(printable(command));
  ordered_json questions = ordered_json::array();
  for (const deck::Question& q : plan.questions)
    questions.push_back({{"what", printable(q.what)}, {"option", q.option}});
  root["asks_for"] = questions;
  root["not_followed"] = d.scene.notes;
  return root;
}

void print_types(const PlannedDeck& d)
{
  for (const auto& [type, m] : d.scene.materials) {
    if (!m.youngs_modulus) continue;
    std::string yield = "yield stress not known";
    const auto named = d.options.materials.find(type);
    const double stress =
        named != d.options.materials.end() ? named->second.yield_stress : m.yield_stress.value_or(-1);
    if (stress > 0) yield = std::isfinite(stress) ? fmt::format("Y {:.4g} Pa", stress) : "elastic";
    fmt::print("  type {}{}: E {:.4g} Pa, nu {:.3g}, {}\n", type,
               named != d.options.materials.end() ? " (" + printable(named->second.name) + ")" : "",
               *m.youngs_modulus, m.poisson_ratio.value_or(0), yield);
    if (named != d.options.materials.end() &&
        std::abs(named->second.youngs_modulus / *m.youngs_modulus - 1) > 1e-3)
      fmt::print("    the materials file says E {:.4g} Pa: that is used\n", named->second.youngs_modulus);
  }
}

void plan(const PlanRequest& r)
{
  const PlannedDeck d = plan_deck(r.deck, r.options);
  const deck::Plan& plan = d.plan;
  const std::string command = deck::table_command(plan, r.options.materials_file);
  if (r.json) {
    fmt::print("{}\n", to_json(d, command).dump(1));
    return;
  }
  fmt::print(
      "{}: {} particle types meet {} walls\n", printable(r.deck),
      [&] {
        std::set<int> types;
        for (const auto& p : plan.pairs) types.insert(p.meeting.a);
        return types.size();
      }(),
      d.scene.walls.size());
  if (plan.radius_max > 0)
    fmt::print(
        "  radii {:.4g} to {:.4g} m, masses {:.4g} to {:.4g} kg; fall up to {:.4g} m under {:.4g} m/s^2\n",
        plan.radius_min, plan.radius_max, plan.mass_min, plan.mass_max, plan.fall,
        deck::norm(d.scene.gravity));
  print_types(d);
  if (!plan.pairs.empty()) {
    fmt::print(
        "pairs that can meet (V: relative normal speed; yield begins at V_on; material 'wall': rigid)\n");
    fmt::print("  {:<9} {:<18} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>8}  {}\n", "types", "materials",
               "V m/s", "V_on m/s", "V/V_on", "V/V_y", "I", "d/R*", "by", "verdict");
  }
  for (const deck::PairPlan& p : plan.pairs) {
    const auto known = [&](double x) {
      return p.meeting.known_yield && std::isfinite(x) ? fmt::format("{:.3g}", x) : std::string("-");
    };
    fmt::print("  {:<9} {:<18} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9.3g} {:>8}  {}\n",
               fmt::format("{}:{}{}", p.meeting.a, p.meeting.wall ? "wall " : "", p.meeting.b),
               printable(p.meeting.name_a + ":" + p.meeting.name_b), fmt::format("0..{:.3g}", p.speed),
               known(p.onset), known(p.speed / p.onset), known(p.speed / p.yield_velocity),
               known(p.damage_number), p.overlap, p.overlap_basis.empty() ? "-" : p.overlap_basis,
               verdict(p));
  }
  for (const deck::PairPlan& p : plan.pairs)
    if (p.speed_basis == "shielded fall")
      fmt::print("  {}:wall {}: the lowest particles shield the floor from a fall of {:.3g} m/s\n",
                 p.meeting.a, p.meeting.b, std::sqrt(2 * deck::norm(d.scene.gravity) * plan.fall));
  if (plan.damage_number > 0)
    fmt::print("axes of the law: overlap; velocity {}\n",
               plan.axis_matters
                   ? fmt::format("(I up to {:.2g})", plan.damage_number)
                   : fmt::format("not needed (I stays below {:g})", deck::negligible_damage_number));
  if (plan.time_step > 0)
    fmt::print("time step: {:.3g} s ({:g} in the shortest contact); the deck has {:.3g} s\n", plan.time_step,
               deck::steps_per_contact, d.scene.time_step);
  if (d.scene.stretch > 1)
    fmt::print("stretch {:g}: in it; the deck's overlaps are {:g} times the d/R* above\n", d.scene.stretch,
               d.scene.stretch);
  if (plan.particle_steps > 0)
    fmt::print("cost: {:.3g} particle-steps, {:.3g} hours at {:.3g} a second\n", plan.particle_steps,
               plan.hours, d.options.rate);
  for (const std::string& note : d.scene.notes) fmt::print("not followed: {}\n", note);
  if (!plan.complete()) fmt::print("not in the deck:\n{}", questions_text(plan));
  if (!command.empty())
    fmt::print("{}\n", printable(command));
  else if (plan.complete() && !plan.pairs.empty())
    fmt::print("no table is needed\n");
}

}  // namespace

void add_plan(CLI::App& app)
{
  const auto r = std::make_shared<PlanRequest>();
  CLI::App* command = app.add_subcommand(
      "plan",
      "What a LIGGGHTS deck needs of a contact law: pairs, speeds, overlaps, time step, cost, and the mpm "
      "table\n"
      "command. What it cannot follow it names, and asks for as an option (docs/plan.md).\n"
      "Example: mpm plan in.hopper --var model mpm --var scene out/scene --materials-file materials.toml");
  command->add_option("DECK", r->deck, "LIGGGHTS input script")->required();
  r->options.add_to(*command, true);
  command->add_flag("--json", r->json, "the plan as JSON");
  command->callback([r] { plan(*r); });
}

}  // namespace granulaw
