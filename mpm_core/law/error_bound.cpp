#include "law/error_bound.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "law/law.hpp"

namespace granulaw {

namespace {

/// Linear between the speeds, from none at standstill; beyond the last that of the last.
AxisCost cost_at(const std::vector<AxisCost>& costs, double v)
{
  AxisCost below;
  for (const AxisCost& above : costs) {
    if (v < above.speed) {
      const double place = (v - below.speed) / (above.speed - below.speed);
      return {v, below.force + place * (above.force - below.force),
              below.restitution + place * (above.restitution - below.restitution)};
    }
    below = above;
  }
  return below;
}

/// The larger cost of two laws, at the speeds of both.
std::vector<AxisCost> larger_costs(const std::vector<AxisCost>& a, const std::vector<AxisCost>& b)
{
  std::map<double, AxisCost> larger;
  for (const std::vector<AxisCost>* costs : {&a, &b})
    for (const AxisCost& cost : *costs) {
      const double v = cost.speed;
      const AxisCost of_a = cost_at(a, v), of_b = cost_at(b, v);
      larger[v] = {v, std::max(std::abs(of_a.force), std::abs(of_b.force)),
                   std::max(std::abs(of_a.restitution), std::abs(of_b.restitution))};
    }
  std::vector<AxisCost> costs;
  for (const auto& entry : larger) costs.push_back(entry.second);
  return costs;
}

/// Parts that are joined alike by with() and worst().
ErrorBound joined(const ErrorBound& a, const ErrorBound& b, double (*join)(double, double))
{
  ErrorBound both{join(a.force, b.force), join(a.restitution, b.restitution),
                  join(a.relative_restitution, b.relative_restitution),
                  larger_costs(a.omitted_axis, b.omitted_axis)};
  for (const auto part :
       {&ErrorBound::axis_restitution, &ErrorBound::swing_force, &ErrorBound::swing_restitution,
        &ErrorBound::size_force, &ErrorBound::size_restitution, &ErrorBound::confined_force})
    both.*part = std::max(a.*part, b.*part);
  return both;
}

}  // namespace

ErrorBound ErrorBound::at(double v) const
{
  const AxisCost cost = cost_at(omitted_axis, v);
  ErrorBound bound = *this;
  bound.force = std::abs(cost.force) + (1 + std::abs(cost.force)) * force;
  bound.axis_restitution += std::abs(cost.restitution);
  bound.omitted_axis.clear();
  return bound;
}

ErrorBound ErrorBound::at_size(double off) const
{
  if (off <= size_share_step * (1 + 1e-9)) return *this;
  if (!stated() || std::isinf(size_force)) return {};
  return with({size_force * off, size_restitution * off});
}

ErrorBound ErrorBound::with(const ErrorBound& other) const
{
  return joined(*this, other, [](double a, double b) { return std::hypot(a, b); });
}

ErrorBound ErrorBound::worst(const ErrorBound& other) const
{
  if (!stated() || !other.stated()) return {};
  return joined(*this, other, [](double a, double b) { return std::max(a, b); });
}

std::string ErrorBound::text() const
{
  if (!stated()) return "not stated";
  const double relative = relative_restitution + axis_restitution;
  std::string e = fmt::format("{:.2g}", restitution);
  if (relative > 0) e = (restitution > 0 ? e + " and " : "") + fmt::format("{:.2g} %", 100 * relative);
  const std::string slow = fmt::format("F_max {:.2g} %, e {}", 100 * force, e);
  if (omitted_axis.empty()) return slow;
  ErrorBound largest = at(omitted_axis.back().speed);
  for (const AxisCost& cost : omitted_axis) largest = largest.worst(at(cost.speed));
  return slow + ", rising with speed to " + largest.text();
}

ErrorBound bound_of(const Certificate& c)
{
  const bool elastic = std::isinf(c.damage_number_max);
  const ErrorBound atlas{c.atlas_error_force, c.atlas_error_restitution};
  const bool composed = c.origin == composed_origin && c.verification_impacts == 0;
  const bool checked = (c.origin == "atlas" && !elastic) || composed;  // by impacts: in what they found
  ErrorBound bound = atlas;
  if (!checked && c.verification_impacts > 0)
    bound = {c.verification_error_force, 0, c.verification_error_restitution};
  else if (!checked)
    bound = atlas.with({c.interpolation_error, 0, c.held_out_error});
  bound = bound.with({c.solver_error_force, 0, c.solver_error_restitution});
  if (elastic) {  // the largest of 21 impacts (docs/evidence/atlas.md)
    bound.swing_force = 2.7;
    bound.swing_restitution = 0.35;
  }
  return bound;
}

namespace {

/// Of the forces on a sphere between planes, to a density of 0.9: 95 % of fresh arrangements (docs/evidence/confined.md). Infinity:
/// no such material was tried.
double confined_error(const LawMaterial& m)
{
  const double stiffness = m.e_star() / m.yield_stress, nu = m.poisson_ratio, hardening = m.hardening_modulus / m.youngs_modulus;
  const bool tried = stiffness >= 30 && stiffness <= 1000 && nu >= 0.1 && nu <= 0.45 && hardening <= 0.1 && m.flow.strain.empty();
  return tried ? 0.17 : std::numeric_limits<double>::infinity();
}

}  // namespace

void BodyLaw::state()
{
  std::vector<AxisCost> costs = std::move(bound.omitted_axis);
  bound = bound_of(certificate);
  bound.omitted_axis = std::move(costs);
  if (is_sphere()) bound.confined_force = confined_error(material);
}

ErrorBound bound_of(const BodyLaw& body)
{
  if (!body.shape) return body.bound;
  return {body.shape->force().largest, body.shape->restitution().largest, 0, body.bound.omitted_axis};
}

}  // namespace granulaw
