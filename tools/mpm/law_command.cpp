// mpm law: one collision by the law alone, as a particle code would compute it.
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <memory>

#include "base/error.hpp"
#include "claim.hpp"
#include "collision_report.hpp"
#include "command.hpp"
#include "json_output.hpp"
#include "law/law_file.hpp"
#include "law/replay.hpp"
#include "option_checks.hpp"
#include "pair_choice.hpp"

namespace granulaw {

namespace {

struct LawRequest : PairOptions
{
  double velocity = 0;
  bool json = false;
};

/// Past the table's last overlap the force goes on with its last stiffness: good enough for this share of it.
constexpr double overlap_margin = 0.05;

/// What the file states for this collision: the certificate's claim and what the pair rule costs. 0: nothing.
Claim stated_error(const Law& law, const PairLaw& pair, const PairNames& names, double e)
{
  const Claim claim = claim_of(pair.yielding->certificate, e);
  const LawPair* entry = law.find_pair(names.first, names.second);
  return entry ? claim.with(entry->reduction_error_force, entry->reduction_error_restitution) : claim;
}

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

/// How fast the collision is for the law.
struct Speed
{
  double damage_number;  ///< I = rho V^2/Y; 0: elastic
  double allowed;        ///< up to which the law holds
  bool needs_axis;       ///< beyond it, and the law has no velocity axis
};

Speed speed_of(const Collision& c)
{
  const bool yields = c.law.yielding->material.yields();
  const double speed = yields ? c.law.axis_speed(c.r_eff, c.m_eff, c.velocity) : 0.0;
  const double damage_number = speed * speed, allowed = c.law.yielding->certificate.damage_number_max;
  return {damage_number, allowed, damage_number > allowed && !c.law.curve->axis()};
}

void print_warnings(const Collision& c, const Speed& speed, const Replay& result)
{
  if (speed.needs_axis)
    fmt::print(stderr,
               "mpm: I = rho V^2/Y = {:.3g} is above {:.3g}: there the law would need a velocity axis, which "
               "this file does not have; e and force are too high\n",
               speed.damage_number, speed.allowed);
  if (result.left_speeds)
    fmt::print(
        stderr,
        "mpm: {:.4g} m/s is beyond {:.4g} m/s, where the law's velocity axis ends: it answers with the "
        "corrections of that speed\n",
        c.velocity, c.law.max_speed(c.r_eff, c.m_eff));
  if (result.held_speed)
    fmt::print(
        stderr,
        "mpm: {:.4g} m/s is below {:.4g} m/s, the slowest impact that this rate-dependent law knows: it "
        "answers as at that rate\n",
        c.velocity, c.law.min_speed(c.r_eff, c.m_eff));
}

void print_as_json(const Speed& speed, const Replay& result, double cpu_s, const Claim& error)
{
  nlohmann::ordered_json out = collision_json(result);
  put_effort(out, 0, static_cast<long>(result.samples.size()), cpu_s, 0,  // no solver: no points
             std::max(error.force, error.restitution));
  out["error_force"] = error.force;
  out["error_restitution"] = error.restitution * result.restitution;
  out["damage_number"] = out["inertia"] = speed.damage_number;
  out["needs_velocity_axis"] = speed.needs_axis;
  out["beyond_velocity_axis"] = result.left_speeds;
  out["below_velocity_axis"] = result.held_speed;
  print_json(out, 2);
}

void print(const Collision& c, const Speed& speed, const Replay& result, const Claim& error)
{
  fmt::print("{}:{} at {:.4g} m/s, R* = {:.4g} m, I = rho V^2/Y = {:.3g}\n", c.names.first, c.names.second,
             c.velocity, c.r_eff, speed.damage_number);
  print_collision(result, fmt::format("{:.3g} of the law's range", result.delta_max / c.limit()));
  if (error.force > 0 || error.restitution > 0)
    fmt::print("stated error (95 %)            F_max {}, e {:.2g}\n", percent(error.force),
               error.restitution * result.restitution);
}

void replay(const LawRequest& r)
{
  const Law law = read_law(r.law);
  const Collision c = collision_of(law, r);
  const std::clock_t start = std::clock();
  const Replay result = replay_collision(c.law, c.r_eff, c.m_eff, c.velocity);
  const double cpu_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  check_depth(r, c, result);

  const Speed speed = speed_of(c);
  const Claim error = stated_error(law, c.law, c.names, result.restitution);
  print_warnings(c, speed, result);
  if (r.json)
    print_as_json(speed, result, cpu_s, error);
  else
    print(c, speed, result, error);
}

void define(CLI::App& command)
{
  const auto r = std::make_shared<LawRequest>();
  command.add_option("LAW", r->law, "law file of mpm table")->required();
  define_pair_options(command, *r);
  command.add_option("--velocity", r->velocity, "approach speed, m/s")->required();
  command.add_flag(
      "--json", r->json,
      "print one JSON object instead of the summary: the keys of mpm impact; error_force, "
      "error_restitution: what 95 % of impacts lie within, by the certificate and by what the pair "
      "rule costs, relative of F_max and absolute of e; error_estimate: the larger, both relative");
  command.callback([r] { replay(*r); });
}

}  // namespace

extern const Command law_command{
    "law",
    "One head-on collision by the law, as a particle code computes it; no solver.\n"
    "Example: mpm law law.h5 --pair powder:wall --radius 2e-3 --velocity 0.5 --json",
    define};

}  // namespace granulaw
