// mpm law: one collision by the law alone, as a particle code would compute it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <memory>
#include <optional>

#include "base/error.hpp"
#include "claim.hpp"
#include "collision_report.hpp"
#include "commands.hpp"
#include "law/law_file.hpp"
#include "law/replay.hpp"

namespace granulaw {

namespace {

struct LawRequest
{
  std::string law, pair;
  std::optional<double> radius, radius2;
  double velocity = 0;
  bool json = false;
};

/// Past the table's last overlap the force goes on with its last stiffness: good enough for this share of it.
constexpr double overlap_margin = 0.05;

std::pair<std::string, std::string> choose_pair(const Law& law, const LawRequest& r)
{
  if (r.pair.empty()) {
    if (law.pairs.size() == 1) return {law.pairs.front().a, law.pairs.front().b};
    fail("--pair", "the law holds several pairs: name one", {}, law.pair_list());
  }
  const auto colon = r.pair.find(':');
  if (colon == std::string::npos)
    fail("--pair", "cannot be used", fmt::format("'{}'", r.pair), law.pair_list());
  return {r.pair.substr(0, colon), r.pair.substr(colon + 1)};
}

/// kg, of a body whose radius (of curvature at the pole) is `radius`.
double body_mass(const BodyLaw& body, double radius)
{
  return body.mass_ratio * 4.0 / 3.0 * M_PI * body.material.density * radius * radius * radius;
}

/// What the file states for this collision, relative, the larger of F_max and e: the certificate's claim and
/// what the pair rule costs. 0: it states nothing, the law is exact but for the solver (elastic bodies).
double stated_error(const Law& law, const PairLaw& pair, const std::string& a, const std::string& b, double e)
{
  const Claim claim = claim_of(pair.yielding->certificate, e);
  const LawPair* entry = law.find_pair(a, b);
  return std::max(claim.force + (entry ? entry->reduction_error_force : 0.0),
                  claim.restitution + (entry ? entry->reduction_error_restitution : 0.0));
}

/// Wider than any particle or collision; within, no number of the replay leaves the range of a double.
void require_within(const char* option, double value, const char* unit, double low, double high)
{
  if (!(value >= low && value <= high))
    fail(option, "cannot be used", fmt::format("{:g} {}", value, unit),
         fmt::format("{:g} to {:g} {}", low, high, unit));
}

void replay(const LawRequest& r)
{
  const Law law = read_law(r.law);
  auto [a, b] = choose_pair(law, r);
  if (a == wall_name) std::swap(a, b);
  const PairLaw pair = resolve_pair(law, a, b, r.law);
  const double radius = r.radius.value_or(pair.only_radius() > 0 ? pair.only_radius() : 1e-3);
  const double radius2 = r.radius2.value_or(radius);
  const bool wall = b == wall_name;
  if (wall && r.radius2) fail("--radius2", "a wall has no radius");
  require_within("--radius", radius, "m", 1e-9, 1e3);
  require_within("--radius2", radius2, "m", 1e-9, 1e3);
  require_within("--velocity", r.velocity, "m/s", 1e-12, 1e6);

  const std::string& yielding = pair.yielding->material.name;
  if (a == yielding) check_size(pair, radius, "--radius");
  if (b == yielding) check_size(pair, radius2, "--radius2");

  const double mass = body_mass(law.bodies.at(a), radius);
  const double m_eff = wall ? mass : effective_mass(mass, body_mass(law.bodies.at(b), radius2));
  const double r_eff = wall ? radius : effective_radius(radius, radius2);
  const std::clock_t start = std::clock();
  const Replay result = replay_collision(pair, r_eff, m_eff, r.velocity);
  const double cpu_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;

  const double limit = pair.max_overlap(r_eff);
  if (result.delta_max > (1 + overlap_margin) * limit)
    fail(r.law, "the collision leaves the law's range of overlaps by more than 5 %",
         fmt::format("{:.4g} m", result.delta_max),
         fmt::format("up to {:.4g} m", (1 + overlap_margin) * limit));

  const LawMaterial& m = pair.yielding->material;
  const double speed = m.yields() ? pair.axis_speed(r_eff, m_eff, r.velocity) : 0.0,
               damage_number = speed * speed;
  const double allowed = pair.yielding->certificate.damage_number_max;
  const bool needs_axis = damage_number > allowed && !pair.curve->axis();
  if (needs_axis)
    fmt::print(stderr,
               "mpm: I = rho V^2/Y = {:.3g} is above {:.3g}: there the law would need a velocity axis, which "
               "this file does not have; e and force are too high\n",
               damage_number, allowed);
  if (result.left_speeds)
    fmt::print(
        stderr,
        "mpm: {:.4g} m/s is beyond {:.4g} m/s, where the law's velocity axis ends: it answers with the "
        "corrections of that speed\n",
        r.velocity, pair.max_speed(r_eff, m_eff));
  if (result.held_speed)
    fmt::print(
        stderr,
        "mpm: {:.4g} m/s is below {:.4g} m/s, the slowest impact that this rate-dependent law knows: it "
        "answers as at that rate\n",
        r.velocity, pair.min_speed(r_eff, m_eff));
  const double error = stated_error(law, pair, a, b, result.restitution);
  if (r.json) {
    nlohmann::ordered_json out = collision_json(result);
    put_effort(out, 0, static_cast<long>(result.samples.size()), cpu_s, 0, error);  // no solver: no points
    out["damage_number"] = out["inertia"] = damage_number;
    out["needs_velocity_axis"] = needs_axis;
    out["beyond_velocity_axis"] = result.left_speeds;
    out["below_velocity_axis"] = result.held_speed;
    fmt::print("{}\n", out.dump(2));
    return;
  }
  fmt::print("{}:{} at {:.4g} m/s, R* = {:.4g} m, I = rho V^2/Y = {:.3g}\n", a, b, r.velocity, r_eff,
             damage_number);
  print_collision(result, fmt::format("{:.3g} of the law's range", result.delta_max / limit));
  if (error > 0) fmt::print("stated error of F and e        {:.2g}\n", error);
}

}  // namespace

void add_law(CLI::App& app)
{
  const auto r = std::make_shared<LawRequest>();
  CLI::App* command =
      app.add_subcommand("law",
                         "One head-on collision by the law, as a particle code computes it; no solver.\n"
                         "Example: mpm law law.h5 --pair powder:wall --radius 2e-3 --velocity 0.5 --json");
  command->add_option("LAW", r->law, "law file of mpm table")->required();
  command->add_option("--pair", r->pair, "a:b or a:wall; may be left out if the file holds one");
  command->add_option(
      "--radius", r->radius,
      "radius of the first body, m (default 1e-3, e depends on no radius; of a rate-dependent\n"
      "law the one it was made for, and no other is allowed)");
  command->add_option("--radius2", r->radius2, "radius of the second body, m (default: the first's)");
  command->add_option("--velocity", r->velocity, "approach speed, m/s")->required();
  command->add_flag("--json", r->json,
                    "print one JSON object instead of the summary: the keys of mpm impact; error_estimate: "
                    "the certificate's "
                    "claim and what the pair rule costs, the larger of F_max and e");
  command->callback([r] { replay(*r); });
}

}  // namespace granulaw
