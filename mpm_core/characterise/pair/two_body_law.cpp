#include "characterise/pair/two_body_law.hpp"

#include "characterise/run/request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "characterise/pair/two_body_runs.hpp"

namespace granulaw {

BuiltLaw build_two_body_law(const UnlikePair& pair, const BuildOptions& options)
{
  const LawMaterial& s = pair.yielding;
  if (!s.yields()) fail("a pair's own law", "needs a body that yields: both are elastic");
  if (!(pair.radius_ratio >= 0.1 && pair.radius_ratio <= 10))
    fail("a pair's own law", "radius ratio cannot be used", fmt::format("{:g}", pair.radius_ratio),
         "0.1 to 10");
  ThreadFarm alone(1);
  PairFarm farm(options.farm ? *options.farm : alone, pair);
  BuildOptions own = options;
  own.farm = &farm;
  own.atlas = nullptr;  // whose guide is of one body
  own.depth = std::min(options.depth, deepest_of_two_bodies(pair));
  const double speed_ratio = pair.axis_speed_ratio();
  own.fastest = options.fastest * speed_ratio;
  BuiltLaw built = build_law(s, yielding_body(pair), own, two_body_runs(pair));
  built.law.certificate.damage_number_max /= speed_ratio * speed_ratio;  // so far v^2 of the axis
  built.law.bound.size_force = built.law.bound.size_restitution = std::numeric_limits<double>::infinity();
  return built;
}

}  // namespace granulaw
