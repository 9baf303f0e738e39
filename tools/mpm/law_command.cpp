// mpm law: one collision by the law alone, as a particle code would compute it.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <memory>

#include "base/error.hpp"
#include "collision_report.hpp"
#include "command.hpp"
#include "json_output.hpp"
#include "law/damage_number.hpp"
#include "law/error_bound.hpp"
#include "law/law_file.hpp"
#include "law/replay.hpp"
#include "option_checks.hpp"
#include "pair_choice.hpp"
#include "percent.hpp"

namespace granulaw {

namespace {

struct LawRequest : PairOptions
{
  double velocity = 0;
  bool json = false;
};

/// Past the table's last overlap the force goes on with its last stiffness: good enough for this fraction of
/// it.
constexpr double overlap_margin = 0.05;

/// Two bodies about to collide: SI.
struct Collision : ChosenPair
{
  double velocity;
};

Collision collision_of(const Law& law, const LawRequest& r)
{
  const ChosenPair pair = choose_pair(law, r);
  require_within("--velocity", r.velocity, "m/s", 1e-12, 1e6);  // as of the radii (pair_choice.cpp)
  return {pair, r.velocity};
}

/// Throws where the collision goes deeper than the law is good for.
void check_depth(const LawRequest& r, const Collision& c, const Replay& result)
{
  const double allowed = (1 + overlap_margin) * c.limit();
  if (result.delta_max > allowed)
    fail(r.law, "the collision leaves the law's range of overlaps by more than 5 %",
         fmt::format("{:.4g} m", result.delta_max), fmt::format("up to {:.4g} m", allowed));
}

/// The collision's speed, and the statement of the law file about it.
struct Assessment
{
  double damage_number;     ///< of damage_number.hpp
  PairStatement statement;  ///< for these sizes
  bool beyond_bound;        ///< the damage number is above that up to which the error bound holds
  bool needs_axis;          ///< ... and the law has no velocity axis

  /// Not stated beyond the damage number of the law.
  ErrorBound bound() const { return beyond_bound ? ErrorBound{} : statement.bound; }
};

Assessment assess(const Law& law, const Collision& c)
{
  const auto& [a, b] = c.names;
  const double damage_number = granulaw::damage_number(c.law, c.velocity);
  const PairStatement statement =
      statement_of(law, c.law, a, b).at_distance(distance_in_size(law, c.law, a, b, c.radius, c.radius2));
  constexpr double rounding = 1e-9;
  const bool beyond = damage_number > statement.damage_number_max * (1 + rounding);
  return {damage_number, statement, beyond, beyond && !c.law.curve->axis()};
}

void print_warnings(const Collision& c, const Assessment& found, const Replay& result)
{
  if (found.needs_axis)
    fmt::print(stderr,
               "mpm: I = rho V^2/Y = {:.3g} is above {:.3g}: there the law would need a velocity axis, which "
               "this file does not have; e and force are too high\n",
               found.damage_number, found.statement.damage_number_max);
  else if (found.beyond_bound)
    fmt::print(
        stderr,
        "mpm: I = rho V^2/Y = {:.3g} is above {:.3g}, up to which the error bound of this {} law holds: no "
        "bound is stated for this collision\n",
        found.damage_number, found.statement.damage_number_max, name_of(found.statement.kind));
  if (!found.statement.covers_size())
    fmt::print(
        stderr,
        "mpm: R_s/(R_s + R_h) of these radii is {:.3g} off the nearest law of the pair: the error bound is "
        "larger by that; mpm table --radius-ratio makes laws for more ratios\n",
        found.statement.size_off);
  if (result.left_speeds)
    fmt::print(
        stderr,
        "mpm: {:.4g} m/s is beyond {:.4g} m/s, where the law's velocity axis ends: the corrections of that "
        "speed are used\n",
        c.velocity, c.law.max_speed(c.r_eff, c.m_eff));
  if (result.held_speed)
    fmt::print(
        stderr,
        "mpm: {:.4g} m/s is below {:.4g} m/s, the lowest speed of this rate-dependent law: the law of that "
        "speed is used\n",
        c.velocity, c.law.min_speed(c.r_eff, c.m_eff));
}

void print_as_json(const Assessment& found, const Replay& result, double cpu_s)
{
  const ErrorBound bound = found.bound();
  const double restitution = bound.restitution_at(result.restitution);
  nlohmann::ordered_json out = collision_json(result);
  put_effort(out, 0, static_cast<long>(result.samples.size()), cpu_s, 0,  // no solver: no points
             std::max(bound.force, restitution / result.restitution));
  const auto unless_beyond = [&](double error) {
    return found.beyond_bound ? nlohmann::ordered_json() : nlohmann::ordered_json(error);
  };
  out["error_force"] = unless_beyond(bound.force);
  out["error_restitution"] = unless_beyond(restitution);
  out["damage_number"] = out["inertia"] = found.damage_number;
  out["damage_number_max"] = json_number(found.statement.damage_number_max);
  out["needs_velocity_axis"] = found.needs_axis;
  out["beyond_velocity_axis"] = result.left_speeds;
  out["below_velocity_axis"] = result.held_speed;
  out["law_kind"] = name_of(found.statement.kind);
  out["size_distance"] = found.statement.size_off;
  print_json(out, 2);
}

std::string bound_text(const Assessment& found, double restitution)
{
  const ErrorBound bound = found.bound();
  if (!bound.stated()) return "not stated";
  return fmt::format("F_max {}, e {:.2g}", percent(bound.force), bound.restitution_at(restitution));
}

void print(const Collision& c, const Assessment& found, const Replay& result)
{
  fmt::print("{}:{} at {:.4g} m/s, R* = {:.4g} m, I = rho V^2/Y = {:.3g}, {} law\n", c.names.first,
             c.names.second, c.velocity, c.r_eff, found.damage_number, name_of(found.statement.kind));
  print_collision(result, fmt::format("{:.3g} of the law's range", result.delta_max / c.limit()));
  fmt::print("error bound (95 %)             {}\n", bound_text(found, result.restitution));
}

void replay(const LawRequest& r)
{
  const Law law = read_law(r.law);
  const Collision c = collision_of(law, r);
  const std::clock_t start = std::clock();
  const Replay result = replay_collision(c.law, c.r_eff, c.m_eff, c.velocity);
  const double cpu_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  check_depth(r, c, result);

  const Assessment found = assess(law, c);
  print_warnings(c, found, result);
  if (r.json)
    print_as_json(found, result, cpu_s);
  else
    print(c, found, result);
}

void define(Options& command)
{
  const auto r = std::make_shared<LawRequest>();
  command.add_option("LAW", r->law, "law file of mpm table")->required();
  define_pair_options(command, *r);
  command.add_option("--velocity", r->velocity, "approach speed, m/s")->required();
  command.add_flag(
      "--json", r->json,
      "print one JSON object instead of the summary: the keys of mpm impact; error_force, error_restitution: "
      "error bound that 95 % of impacts lie within, relative of F_max and absolute of e, null beyond "
      "damage_number_max; error_estimate: the larger, both relative; law_kind: single, two-body, composed, "
      "corrected or reduced");
  command.callback([r] { replay(*r); });
}

}  // namespace

extern const Command law_command{
    "law",
    "One head-on collision by the law, as a particle code computes it; no solver.\n"
    "Example: mpm law law.h5 --pair powder:wall --radius 2e-3 --velocity 0.5 --json",
    define};

}  // namespace granulaw
