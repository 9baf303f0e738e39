#include "atlas/law_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "base/error.hpp"
#include "law/law_shape.hpp"

namespace granulaw {

void check(const LawRange& o)
{
  if (!(o.depth > 0 && o.depth <= 0.5))
    fail("depth of the law", "cannot be used", fmt::format("{:g} R", o.depth), "over 0, up to 0.5 R");
  const double most = impact_speeds[std::size(impact_speeds) - 1];
  if (!(o.fastest >= 0 && o.fastest <= most))
    fail("fastest impact of the law", "cannot be used",
         fmt::format("I = rho V^2/Y = {:g}", o.fastest * o.fastest), fmt::format("0 to {:g}", most * most));
  if (!(o.slowest >= 0 && (o.slowest == 0 || o.slowest <= 0.7 * o.fastest)))
    fail("slowest impact of the law", "cannot be used",
         fmt::format("{:.3g} of the fastest", o.slowest / o.fastest), "up to 0.7 of it");
}

double negligible_damage_number(double tolerance)
{
  return 0.16 * std::min(tolerance, 0.01);
}

}  // namespace granulaw
