#include "atlas/finish_curve.hpp"

#include <algorithm>

#include "atlas/law_range.hpp"
#include "atlas/tabulate_curve.hpp"
#include "atlas/tabulate_velocity_axis.hpp"
#include "law/replay.hpp"

namespace granulaw {

namespace {

/// The certificate's errors of F and e without the axis, at its ends. Returns the largest.
double note_axis_cost(BodyLaw& law, const Curve& slow, const AxisTable& axis,
                      const BodyNumbers& body)
{
  const Scales unit{body.radius, law.material.e_star(), law.material.density};
  const auto replay = [&](const Curve& curve, double v) {
    BodyLaw other = law;
    other.curve = curve;
    return replay_on_wall(other, unit.length, body.mass * unit.mass(),
                          v * std::sqrt(body.yield) * unit.velocity());
  };
  double worst = 0;
  // what a rate raises at the fast end inertia may take away again
  for (const double v : {axis.speed_begin, axis.speed_end}) {
    if (v == 0) continue;
    const Replay with = replay(law.curve, v), without = replay(slow, v);
    law.certificate.axis_cost_force = without.force_max / with.force_max - 1;
    law.certificate.axis_cost_restitution = without.restitution / with.restitution - 1;
    worst = std::max(
        {worst, std::abs(law.certificate.axis_cost_force), std::abs(law.certificate.axis_cost_restitution)});
  }
  return worst;
}

}  // namespace

double finish_curve(BodyLaw& law, const LawShape& shape, const BodyNumbers& body, const LawRange& range)
{
  const Curve slow = tabulate(shape, range.depth);
  const double error = table_error(shape, slow);
  if (range.fastest == 0) {
    law.curve = slow;
    return error;
  }
  const bool rate = body.rate_dependent;
  const AxisTable axis =
      rate ? tabulate_rate(shape, slow, 1 / body.yield, body.mass, range.fastest, body.radius)
           : tabulate_inertia(shape, slow, 1 / body.yield, body.mass, range.fastest);
  // It ends where an impact reaches the end of the curve.
  if (const double slow_enough = negligible_damage_number(range.tolerance);
      !rate && axis.speed_end * axis.speed_end <= slow_enough) {
    law.curve = slow;
    law.certificate.damage_number_max = std::min(range.fastest * range.fastest, slow_enough);
    return error;
  }
  law.certificate.damage_number_max = axis.speed_end * axis.speed_end;
  law.curve = fitted_curve(slow.table(), axis);
  // Model only what the scene needs.
  if (note_axis_cost(law, slow, axis, body) <= range.tolerance) law.curve = slow;
  return error;
}

}  // namespace granulaw
