#include "atlas/finish_curve.hpp"

#include <algorithm>
#include <cmath>

#include "atlas/law_range.hpp"
#include "atlas/tabulate_curve.hpp"
#include "atlas/tabulate_velocity_axis.hpp"

namespace granulaw {

namespace {

/// F_max and e of a law without its axis over those with it, by speed.
class AxisCosts
{
 public:
  AxisCosts(const BodyLaw& law, const AxisCollision& collide) : law_(law), without_(law), collide_(collide)
  {
    without_.curve = Curve(law.curve.table());
  }

  AxisCost at(double v) const
  {
    const Replay with = collide_(law_, v), without = collide_(without_, v);
    return {v, without.force_max / with.force_max - 1, without.restitution / with.restitution - 1};
  }
  /// At speeds up to this one; none where one is over `most`.
  std::vector<AxisCost> up_to(double fastest, double most) const
  {
    // Costs go as v to v^2: linear between such speeds within a hundredth. At the first the axis does next to nothing.
    constexpr double step = 1.4, first = impact_speeds[0];
    std::vector<AxisCost> all;
    for (double v = fastest; all.empty() || v > first / step; v /= step) {  // the fastest impact mostly costs most
      all.push_back(at(v));
      if (!(std::max(std::abs(all.back().force), std::abs(all.back().restitution)) <= most)) return {};
    }
    std::reverse(all.begin(), all.end());
    return all;
  }
  const Curve& slow() const { return without_.curve; }

 private:
  const BodyLaw& law_;
  BodyLaw without_;
  const AxisCollision& collide_;
};

}  // namespace

AxisCollision collision_on_wall(const BodyNumbers& body)
{
  return [body](const BodyLaw& law, double v) {
    const Scales unit{body.radius, law.material.e_star(), law.material.density};
    return replay_collision(wall_pair(law), unit.length, body.mass * unit.mass(),
                            v * std::sqrt(body.yield) * unit.velocity(), cheap_replay);
  };
}

double finish_curve(BodyLaw& law, const LawShape& shape, const BodyNumbers& body, const LawRange& range)
{
  const Curve slow = tabulate(shape, range.depth);
  const double error = table_error(shape, slow);
  if (range.fastest == 0) {
    law.curve = slow;
    return error;
  }
  const AxisTable axis =
      body.rate_dependent ? tabulate_rate(shape, slow, 1 / body.yield, body.mass, range.fastest, body.radius)
                          : tabulate_inertia(shape, slow, 1 / body.yield, body.mass, range.fastest);
  law.curve = fitted_curve(slow.table(), axis);
  Certificate& c = law.certificate;
  c.damage_number_max = axis.speed_end * axis.speed_end;
  const AxisCost at_end = AxisCosts(law, collision_on_wall(body)).at(axis.speed_end);
  c.axis_cost_force = at_end.force;
  c.axis_cost_restitution = at_end.restitution;
  return error;
}

void leave_out_axis(BodyLaw& law, const AxisCollision& collide, double tolerance, double fastest)
{
  const AxisTable* axis = law.curve.axis();
  if (!axis || axis->by == AxisTable::By::rate) return;
  const AxisCosts costs(law, collide);
  std::vector<AxisCost> omitted = costs.up_to(axis->speed_end, tolerance);
  if (omitted.empty()) return;
  if (fastest < axis->speed_end) omitted = costs.up_to(fastest, tolerance);
  law.bound.omitted_axis = std::move(omitted);
  law.curve = costs.slow();
}

}  // namespace granulaw
