#include "law/error_bound.hpp"

#include <fmt/format.h>

#include <map>

namespace granulaw {

namespace {

constexpr double even_share = 0.5;

/// The pair's law among those of its own; null: a body's.
const TwoBodyLaw* pair_law(const Law& law, const PairLaw& pair, const std::string& a, const std::string& b)
{
  if (const std::vector<TwoBodyLaw>* laws = law.find_pair_laws(a, b))
    for (const TwoBodyLaw& one : *laws)
      if (&one.law == pair.yielding) return &one;
  return nullptr;
}

LawKind kind_of(const TwoBodyLaw* of_pair, const std::string& a, const std::string& b)
{
  if (!of_pair) return a == b || a == wall_name || b == wall_name ? LawKind::single : LawKind::reduced;
  const Certificate& c = of_pair->law.certificate;
  if (c.origin != composed_origin) return LawKind::two_body;
  return c.verification_impacts > 0 ? LawKind::corrected : LawKind::composed;
}

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

}  // namespace

ErrorBound ErrorBound::at(double v) const
{
  const AxisCost cost = cost_at(omitted_axis, v);
  return {std::abs(cost.force) + (1 + std::abs(cost.force)) * force, restitution, relative_restitution, {},
          axis_restitution + std::abs(cost.restitution)};
}

ErrorBound ErrorBound::with(const ErrorBound& other) const
{
  return {std::hypot(force, other.force), std::hypot(restitution, other.restitution),
          std::hypot(relative_restitution, other.relative_restitution),
          larger_costs(omitted_axis, other.omitted_axis), std::max(axis_restitution, other.axis_restitution)};
}

ErrorBound ErrorBound::worst(const ErrorBound& other) const
{
  if (!stated() || !other.stated()) return {};
  return {std::max(force, other.force), std::max(restitution, other.restitution),
          std::max(relative_restitution, other.relative_restitution), larger_costs(omitted_axis, other.omitted_axis),
          std::max(axis_restitution, other.axis_restitution)};
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
  const ErrorBound atlas{c.atlas_error_force, c.atlas_error_restitution, 0};
  const bool composed = c.origin == composed_origin && c.verification_impacts == 0;
  const bool checked = (c.origin == "atlas" && !elastic) || composed;  // by impacts: in what they found
  ErrorBound law = atlas;
  if (!checked && c.verification_impacts > 0)
    law = {c.verification_error_force, 0, c.verification_error_restitution};
  else if (!checked)
    law = atlas.with({c.interpolation_error, 0, c.held_out_error});
  law = law.with({c.solver_error_force, 0, c.solver_error_restitution});
  law.omitted_axis = c.omitted_axis;
  return law;
}

ErrorBound bound_of(const BodyLaw& body)
{
  if (!body.shape) return bound_of(body.certificate);
  return {body.shape->force().largest, body.shape->restitution().largest, 0, body.certificate.omitted_axis};
}

ErrorBound size_error(double off)
{
  constexpr double force = 0.004 / size_share_step, restitution = 0.002 / size_share_step;
  if (off <= size_share_step * (1 + 1e-9)) return {};
  return {force * off, restitution * off, 0};
}

const char* name_of(LawKind kind)
{
  switch (kind) {
    case LawKind::single:
      return "single";
    case LawKind::two_body:
      return "two-body";
    case LawKind::composed:
      return "composed";
    case LawKind::corrected:
      return "corrected";
    case LawKind::reduced:
      return "reduced";
  }
  return "";
}

PairStatement PairStatement::at_distance(double off) const
{
  PairStatement at = *this;
  at.size_off = off;
  if (at.covers_size()) return at;
  const bool measured = kind != LawKind::two_body && bound.stated();
  at.bound = measured ? bound.with(size_error(off)) : ErrorBound{};
  if (kind == LawKind::single) at.kind = LawKind::reduced;
  return at;
}

PairStatement statement_of(const Law& law, const PairLaw& pair, const std::string& a, const std::string& b)
{
  PairStatement s;
  const BodyLaw& body = *pair.yielding;
  s.kind = kind_of(pair_law(law, pair, a, b), a, b);
  if (s.kind != LawKind::reduced) s.bound = bound_of(body);
  s.damage_number_max = body.certificate.damage_number_max;
  if (body.shape) s.covered = body.shape->covered();
  return s;
}

double distance_in_size(const Law& law, const PairLaw& pair, const std::string& a, const std::string& b,
                        double radius_a, double radius_b)
{
  if (a == wall_name || b == wall_name) return 0;
  if (a == b && radius_a > radius_b) std::swap(radius_a, radius_b);
  const bool a_yields = a == b || yields_first(law.bodies.at(a).material, law.bodies.at(b).material);
  const double ratio = a_yields ? radius_b / radius_a : radius_a / radius_b;
  const TwoBodyLaw* own = pair_law(law, pair, a, b);
  return std::abs(1 / (1 + ratio) - (own ? own->size_share() : even_share));
}

}  // namespace granulaw
