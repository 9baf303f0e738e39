// mpm law: one collision by the law alone, as a particle code would compute it.
#include <fmt/format.h>

#include <ctime>
#include <memory>

#include "adhesion_options.hpp"
#include "command.hpp"
#include "impact_body_options.hpp"
#include "law/law_file.hpp"
#include "law_report.hpp"

namespace granulaw {

namespace of_law {

struct LawRequest : PairAsked
{
  double velocity = 0;
  ImpactBody body;
  Attraction attraction;
  bool json = false;
};

std::string bound_text(const StatedCollision& found)
{
  const ErrorBound bound = found.bound();
  if (!bound.stated()) return "not stated";
  return fmt::format("F_max {}, e {:.2g}", percent(bound.force), bound.restitution_at(found.replay.restitution));
}

void print(const ChosenPair& c, double velocity, const StatedCollision& found)
{
  fmt::print("{}:{} at {:.4g} m/s, R* = {:.4g} m, I = rho V^2/Y = {:.3g}, {} law\n", c.names.first, c.names.second, velocity, c.r_eff, found.damage_number,
      name_of(found.statement.kind));
  print_collision(found.replay, fmt::format("{:.3g} R*, {:.3g} of the law's range", found.replay.delta_max / c.r_eff, found.replay.delta_max / c.limit()));
  fmt::print("error bound (95 %)             {}\n", bound_text(found));
}

void replay(const LawRequest& r)
{
  const Law law = read_law(r.law);
  const ChosenPair pair = choose_pair(law, r);
  const std::clock_t start = std::clock();
  const StatedCollision found = collide(law, pair, r.velocity, r.law, r.body, r.attraction);
  const double cpu_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;

  for (const std::string& warning : warnings_of(pair, r.velocity, found)) fmt::print(stderr, "mpm: {}\n", warning);
  if (r.json)
    print_json(with_adhesion(law_json(found, cpu_s), found.replay, r.attraction));
  else
    print(pair, r.velocity, found), print_adhesion(found.replay, r.attraction);
}

void define(Options& command)
{
  const auto r = std::make_shared<LawRequest>();
  command.add_option("LAW", r->law, "law file of mpm table").required();
  define_pair_options(command, *r);
  command.add_option("--velocity", r->velocity, "approach speed, m/s").required();
  define_adhesion(command, r->attraction);
  define_impact_body(command, r->body, "the first body of the pair");
  command.add_flag("--json", r->json,
      "print one JSON object instead of the summary, with the keys of mpm impact. Also the error bound: error_force (relative) and error_restitution (absolute), null beyond damage_number_max and outside the velocity axis. The larger, both relative, is error_estimate. The law_kind is single, two-body, composed, corrected or reduced");
  command.callback([r] { replay(*r); });
}

}  // namespace of_law

extern const Command law_command{"law",
    "One head-on collision by the law, as a particle code computes it; no solver.\n"
    "Example: mpm law law.h5 --pair powder:wall --radius 2e-3 --velocity 0.5 --json",
    of_law::define};

}  // namespace granulaw
