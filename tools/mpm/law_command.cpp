// mpm law: one collision by the law alone, as a particle code would compute it.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <memory>

#include "collision_report.hpp"
#include "command.hpp"
#include "json_output.hpp"
#include "law/law_file.hpp"
#include "law/stated_collision.hpp"
#include "option_checks.hpp"
#include "pair_options.hpp"
#include "percent.hpp"

namespace granulaw {

namespace {

struct LawRequest : PairAsked
{
  double velocity = 0;
  bool json = false;
};

void print_warnings(const ChosenPair& c, double velocity, const StatedCollision& found)
{
  if (found.needs_axis)
    fmt::print(stderr,
               "mpm: I = rho V^2/Y = {:.3g} is above {:.3g}: the law has no velocity axis, so e and "
               "force are too high\n",
               found.damage_number, found.statement.damage_number_max);
  else if (found.beyond_bound)
    fmt::print(
        stderr,
        "mpm: I = rho V^2/Y = {:.3g} is above {:.3g}, up to which the error bound of this {} law holds\n",
        found.damage_number, found.statement.damage_number_max, name_of(found.statement.kind));
  if (!found.statement.covers_size())
    fmt::print(
        stderr,
        "mpm: R_s/(R_s + R_h) of these radii is {:.3g} off the nearest law of the pair. The error bound is "
        "larger by that (mpm table --radius-ratio makes more laws)\n",
        found.statement.size_off);
  const Replay& result = found.replay;
  if (result.left_speeds)
    fmt::print(
        stderr,
        "mpm: {:.4g} m/s is beyond {:.4g} m/s, where the law's velocity axis ends: the corrections of that "
        "speed are used\n",
        velocity, c.law.max_speed(c.r_eff, c.m_eff));
  if (result.held_speed)
    fmt::print(
        stderr,
        "mpm: {:.4g} m/s is below {:.4g} m/s, the lowest speed of this rate-dependent law: the law of that "
        "speed is used\n",
        velocity, c.law.min_speed(c.r_eff, c.m_eff));
}

void print_as_json(const StatedCollision& found, double cpu_s)
{
  const Replay& result = found.replay;
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
  print_json(out);
}

std::string bound_text(const StatedCollision& found)
{
  const ErrorBound bound = found.bound();
  if (!bound.stated()) return "not stated";
  return fmt::format("F_max {}, e {:.2g}", percent(bound.force),
                     bound.restitution_at(found.replay.restitution));
}

void print(const ChosenPair& c, double velocity, const StatedCollision& found)
{
  fmt::print("{}:{} at {:.4g} m/s, R* = {:.4g} m, I = rho V^2/Y = {:.3g}, {} law\n", c.names.first,
             c.names.second, velocity, c.r_eff, found.damage_number, name_of(found.statement.kind));
  print_collision(found.replay, fmt::format("{:.3g} of the law's range", found.replay.delta_max / c.limit()));
  fmt::print("error bound (95 %)             {}\n", bound_text(found));
}

void replay(const LawRequest& r)
{
  const Law law = read_law(r.law);
  const ChosenPair pair = choose_pair(law, r);
  require_within("--velocity", r.velocity, "m/s", 1e-12, 1e6);  // as of the radii (law/chosen_pair.cpp)
  const std::clock_t start = std::clock();
  const StatedCollision found = collide(law, pair, r.velocity, r.law);
  const double cpu_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;

  print_warnings(pair, r.velocity, found);
  if (r.json)
    print_as_json(found, cpu_s);
  else
    print(pair, r.velocity, found);
}

void define(Options& command)
{
  const auto r = std::make_shared<LawRequest>();
  command.add_option("LAW", r->law, "law file of mpm table")->required();
  define_pair_options(command, *r);
  command.add_option("--velocity", r->velocity, "approach speed, m/s")->required();
  command.add_flag(
      "--json", r->json,
      "print one JSON object instead of the summary, with the keys of mpm impact. Also the error bound: "
      "error_force (relative) and error_restitution (absolute), null beyond damage_number_max. The larger, "
      "both relative, is error_estimate. The law_kind is single, two-body, composed, corrected or reduced");
  command.callback([r] { replay(*r); });
}

}  // namespace

extern const Command law_command{
    "law",
    "One head-on collision by the law, as a particle code computes it; no solver.\n"
    "Example: mpm law law.h5 --pair powder:wall --radius 2e-3 --velocity 0.5 --json",
    define};

}  // namespace granulaw
