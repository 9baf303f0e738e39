#include "law/pair_curves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/scales.hpp"
#include "contact/thornton.hpp"
#include "law/replay.hpp"

namespace granulaw {

namespace {

constexpr int points = 200, speeds = 40;
constexpr int steps_of_collision = 2000;  // e within 1e-5 of that at ten times as many: no line is as thin

/// A law that is drawn, and how.
struct Drawn
{
  std::string name, role;
  PairLaw law;
};

const BodyLaw& yielding_body(const Law& law, const ChosenPair& pair)
{
  return law.bodies.at(pair.law.yielding->material.name);
}

bool has_own_law(const Law& law, const ChosenPair& pair)
{
  return pair.law.yielding != &yielding_body(law, pair);
}

std::string law_name(const Law& law, const ChosenPair& pair)
{
  if (has_own_law(law, pair))
    return pair.law.yielding->certificate.origin == composed_origin ? "composed law" : "law by runs";
  return pair.has_rigid_wall() || pair.names.first == pair.names.second ? "law of the body" : "pair rule";
}

PairLaw without_waves(PairLaw law)
{
  law.radiation = 0;
  return law;
}

/// The pair's laws for other ratios of radii.
std::vector<Drawn> other_laws(const Law& law, const ChosenPair& pair)
{
  std::vector<Drawn> drawn;
  const std::vector<TwoBodyLaw>* laws =
      pair.has_rigid_wall() ? nullptr : law.find_pair_laws(pair.names.first, pair.names.second);
  if (!laws) return drawn;
  for (const TwoBodyLaw& own : *laws)
    if (&own.law != pair.law.yielding)
      drawn.push_back(
          {"laws for other ratios of radii", "other", {{&own.law.curve, pair.law.mapping}, &own.law}});
  return drawn;
}

/// In the order in which they are drawn, one over the other.
std::vector<Drawn> drawn_laws(const Law& law, const ChosenPair& pair)
{
  std::vector<Drawn> drawn = other_laws(law, pair);
  const BodyLaw& body = yielding_body(law, pair);
  if (has_own_law(law, pair)) drawn.push_back({"pair rule", "rule", {{&body.curve, pair.law.mapping}, &body}});
  drawn.push_back({law_name(law, pair), "law", pair.law});
  return drawn;
}

/// m/s, at which Thornton's pair begins to yield: m* V_y^2/2 = 2/5 F_y d_y.
double yield_velocity(const ChosenPair& pair)
{
  const Thornton thornton(pair.law.mapping.e_star_pair(), customary_yield_pressure * pair.law.yielding->material.yield_stress);
  const double overlap = thornton.yield_overlap() * pair.r_eff;
  return std::sqrt(0.8 * thornton.loading(pair.r_eff, overlap, 0.0) * overlap / pair.m_eff);
}

/// m/s, at which a contact that the law's loading curve stops comes to the end of its table, or where its
/// velocity axis ends.
double speed_at_the_end(const ChosenPair& pair)
{
  double work = 0;
  const double step = pair.limit() / points;
  for (int k = 0; k < points; ++k) {
    const double overlap = (k + 0.5) * step;
    work += pair.law.evaluate(pair.r_eff, overlap, overlap).force * step;
  }
  return std::min(std::sqrt(2 * work / pair.m_eff), pair.law.max_speed(pair.r_eff, pair.m_eff));
}

/// m/s, slowest and fastest impact of the picture.
struct Speeds
{
  double least, largest;

  /// k from 0 to `speeds`, in equal ratios.
  double at(int k) const { return least * std::pow(largest / least, static_cast<double>(k) / speeds); }
};

Speeds speeds_of(const ChosenPair& pair, std::optional<double> asked)
{
  const double end = speed_at_the_end(pair);
  if (!pair.law.yielding->material.yields()) {
    const double largest = std::min(asked.value_or(end), end);
    return {1e-3 * largest, largest};
  }
  const double v_y = yield_velocity(pair), largest = std::min(asked.value_or(100 * v_y), end);
  return {std::min(0.5 * v_y, 0.1 * largest), largest};
}

Replay collision(const PairLaw& law, const ChosenPair& pair, double velocity)
{
  return replay_collision(law, pair.r_eff, pair.m_eff, velocity, steps_of_collision);
}

/// Force over overlaps from 0 to `end`, of what has been pressed to `reached`; no part without force but the
/// first point.
DrawnLine branch(const auto& force, double end, double reached)
{
  DrawnLine line;
  for (int k = 0; k <= points; ++k) {
    const double overlap = end * k / points, f = overlap > 0 ? force(overlap, reached) : 0.0;
    if (f <= 0 && k < points && !(reached == 0 && k == 0)) continue;
    line.x.push_back(overlap);
    line.y.push_back(f);
  }
  return line;
}

DrawnLine named(DrawnLine line, const std::string& name, const std::string& role)
{
  line.name = name, line.role = role;
  return line;
}

ForceLine force_line(const Drawn& drawn, double r_eff, double end)
{
  const auto force = [&](double overlap, double reached) {
    return drawn.law.evaluate(r_eff, overlap, reached).force;
  };
  ForceLine line{named(branch(force, end, 0), drawn.name, drawn.role), {}};
  if (drawn.role != "other")
    for (const double part : {0.25, 0.5, 0.75, 1.0})
      line.unloading.push_back(named(branch(force, part * end, part * end), drawn.name, drawn.role));
  return line;
}

ForceLine hertz_line(const ChosenPair& pair, double end)
{
  const double stiffness = 4.0 / 3.0 * pair.law.mapping.e_star_pair() * std::sqrt(pair.r_eff);
  const auto force = [&](double overlap, double) { return stiffness * overlap * std::sqrt(overlap); };
  return {named(branch(force, end, 0), "Hertz", "formula"), {}};
}

/// `restitution`: of a speed, m/s.
DrawnLine restitution_line(const std::string& name, const std::string& role, const Speeds& range,
                           const auto& restitution)
{
  DrawnLine line{name, role, {}, {}};
  for (int k = 0; k <= speeds; ++k) {
    line.x.push_back(range.at(k));
    line.y.push_back(restitution(line.x.back()));
  }
  return line;
}

DrawnLine restitution_line(const std::string& name, const std::string& role, const Speeds& range,
                           const PairLaw& law, const ChosenPair& pair)
{
  return restitution_line(name, role, range,
                          [&](double velocity) { return collision(law, pair, velocity).restitution; });
}

/// `yield`: m/s, where it begins.
DrawnLine thornton_line(const Speeds& range, double yield)
{
  return restitution_line("Thornton 1997", "formula", range,
                          [&](double velocity) { return thornton_restitution(velocity / yield); });
}

std::vector<DrawnLine> restitutions(const std::vector<Drawn>& laws, const ChosenPair& pair, const Speeds& range)
{
  std::vector<DrawnLine> lines;
  for (const Drawn& drawn : laws)
    lines.push_back(restitution_line(drawn.name, drawn.role, range, drawn.law, pair));
  if (pair.law.radiation > 0)
    lines.push_back(
        restitution_line(laws.back().name + " without waves", "still", range, without_waves(pair.law), pair));
  if (pair.law.yielding->material.yields()) lines.push_back(thornton_line(range, yield_velocity(pair)));
  return lines;
}

void scale(DrawnLine& line, double x, double y)
{
  for (double& value : line.x) value /= x;
  for (double& value : line.y) value /= y;
}

/// A body on the rigid wall: of 1 m radius of curvature, or of the only one that its law allows.
ChosenPair on_rigid_wall(const std::string& name, const BodyLaw& body)
{
  const PairLaw law{{&body.curve, PairMapping::rigid_partner(body.material.e_star())}, &body};
  const double radius = law.only_radius() > 0 ? law.only_radius() : 1;
  return {{name, wall_name}, radius, radius, law, radius, body.mass(radius)};
}

std::string title(const ChosenPair& pair)
{
  const auto body = [](const std::string& name, double radius) {
    return std::isinf(radius) ? fmt::format("a deformable wall of {}", name)
                              : fmt::format("{} (R = {:.3g} mm)", name, 1e3 * radius);
  };
  return fmt::format(
      "{} against {}", body(pair.names.first, pair.radius),
      pair.has_rigid_wall() ? std::string("the rigid wall") : body(pair.names.second, pair.radius2));
}

}  // namespace

LawCurves pair_curves(const Law& law, const ChosenPair& pair, std::optional<double> largest_speed)
{
  const std::vector<Drawn> laws = drawn_laws(law, pair);
  const Speeds range = speeds_of(pair, largest_speed);
  const double deepest = collision(pair.law, pair, range.largest).delta_max;
  LawCurves curves{title(pair), {}, restitutions(laws, pair, range)};
  for (const Drawn& drawn : laws) curves.force.push_back(force_line(drawn, pair.r_eff, deepest));
  curves.force.push_back(hertz_line(pair, deepest));
  return curves;
}

LawCurves body_curves(const Law& law)
{
  LawCurves curves;
  double fastest = 100;
  for (const auto& [name, body] : law.bodies) {
    const ChosenPair pair = on_rigid_wall(name, body);
    const LawMaterial& m = body.material;
    const double unit = m.yields() ? m.yield_stress : m.e_star();
    const std::string label =
        name + (m.yields() ? fmt::format(", E*/Y = {:.0f}", m.e_star() / m.yield_stress) : ", elastic");
    ForceLine& force = curves.force.emplace_back(force_line({label, "body", pair.law}, pair.radius, pair.limit()));
    const double unit_force = unit * pair.radius * pair.radius;
    scale(force, pair.radius, unit_force);
    for (DrawnLine& branch : force.unloading) scale(branch, pair.radius, unit_force);
    if (!m.yields()) {
      force.unloading.clear();  // the same line
      continue;
    }
    const double v_y = yield_velocity(pair), end = speed_at_the_end(pair);
    DrawnLine& e = curves.restitution.emplace_back(
        restitution_line(label, "body", {std::min(0.5 * v_y, 0.1 * end), end}, pair.law, pair));
    scale(e, v_y, 1);
    fastest = std::max(fastest, e.x.back());
  }
  curves.restitution.push_back(thornton_line({0.5, fastest}, 1));
  return curves;
}

}  // namespace granulaw
