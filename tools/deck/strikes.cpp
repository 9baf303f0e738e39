#include "deck/strikes.hpp"

#include <algorithm>
#include <cmath>

#include "deck/plan_options.hpp"
#include "liggghts_plugin/plan/geometry.hpp"

namespace granulaw::deck {

namespace {

/// True of a wall that only turns bodies by impact: a plane along an axis.
bool is_plane_wall(const Wall& wall)
{
  const Vec3 size = wall.box.size();
  return std::any_of(size.begin(), size.end(), [](double x) { return x == 0; });
}

bool has_one_particle(const Scene& scene, int type)
{
  double count = 0;
  for (const Source& s : scene.sources)
    if (s.type == type) count += s.count > 0 ? s.count : Box::infinity;
  return count == 1 && scene.unknown_particles.empty();
}

/// Part of the energy that the first of two contacts under one force takes. F is about proportional to energy over
/// overlap, whatever the law.
template <class FirstOverlap, class SecondOverlap>
double share_of_first(FirstOverlap&& first, SecondOverlap&& second)
{
  double low = 0, high = 1;
  for (int k = 0; k < 8; ++k) {  // to half a percent of the energy
    const double part = 0.5 * (low + high);
    (part / first(part) < (1 - part) / second(1 - part) ? low : high) = part;
  }
  return 0.5 * (low + high);
}

}  // namespace

Strikes::Strikes(
    const SpeedBound& speeds, const Scene& scene, const std::map<int, AtomType>& types, const std::map<int, AtomType>& deformable, const PlanOptions& options)
    : speeds_(speeds), scene_(scene), deformable_(deformable), options_(options)
{
  for (const auto& [number, type] : types)
    for (const double radius : {type.radius_min, type.radius_max}) {
      bodies_.push_back({&type, radius, type.density * ball_volume(radius), has_one_particle(scene, number)});
      if (type.radius_min == type.radius_max) break;
    }
  std::stable_sort(bodies_.begin(), bodies_.end(), [](const Body& a, const Body& b) { return a.mass > b.mass; });
  const auto& walls = speeds.walls();
  has_slopes_ = std::any_of(walls.begin(), walls.end(), [](const Wall* w) { return !is_plane_wall(*w); });
}

std::vector<const Body*> Strikes::bodies(int type) const
{
  std::vector<const Body*> found;
  for (const Body& b : bodies_)
    if (b.type->type == type) found.push_back(&b);
  return found;
}

std::vector<const Body*> Strikes::heavier_than(const Body& body) const
{
  std::vector<const Body*> found;
  for (const Body& b : bodies_)
    if (b.mass > body.mass) found.push_back(&b);
  return found;
}

Meeting Strikes::at_wall(const Body& body, const Wall& wall) const
{
  const auto known = deformable_.find(wall.type);
  return wall.deformable && known != deformable_.end() ? meeting_with_wall(*body.type, known->second) : meeting_with_rigid_wall(*body.type, wall.type);
}

/// The largest e of the walls; of a deck without walls that of two alike.
double Strikes::rebound(const Body& body, double speed) const
{
  if (!(speed > 0)) return 0;
  if (speeds_.walls().empty()) return restitution_of(options_, meeting_of(*body.type, *body.type), 0.5 * body.radius, 0.5 * body.mass, speed);
  double e = 0;
  std::vector<std::pair<int, bool>> seen;
  for (const Wall* w : speeds_.walls()) {
    const std::pair kind(w->deformable ? w->type : 0, w->deformable);
    if (std::find(seen.begin(), seen.end(), kind) != seen.end()) continue;
    seen.push_back(kind);
    e = std::max(e, restitution_of(options_, at_wall(body, *w), body.radius, body.mass, speed));
  }
  return e;
}

/// Part of its speed that is left where a wall turns it without an impact: it slides through a right angle, and
/// keeps 5/7 when it begins to roll (I = 2/5 m R^2).
double Strikes::kept_in_a_turn(const Body& body) const
{
  double friction = Box::infinity;
  for (const Wall* w : speeds_.walls()) {
    const auto place = static_cast<std::size_t>((body.type->type - 1) * scene_.types + w->type - 1);
    friction = std::min(friction, place < scene_.friction.size() ? scene_.friction[place] : 0.0);
  }
  return std::max(5.0 / 7.0, std::exp(-0.5 * M_PI * friction));
}

double Strikes::turned_by_impact(const Body& body, double speed) const
{
  const double push = speeds_.push(), e = rebound(body, speed + push);
  return e * speed + (1 + e) * push;
}

double Strikes::turned(const Body& body, double speed) const { return std::max(turned_by_impact(body, speed), has_slopes_ ? kept_in_a_turn(body) * speed : 0.0); }

/// After four hits in turn: more give an elastic body any speed, and others stand in between.
double Strikes::shaken(const Body& body) const
{
  const double wall = speeds_.shake();
  double speed = 0;
  for (int hit = 0; hit < 4; ++hit) {
    const double e = rebound(body, speed + wall);
    speed = e * speed + (1 + e) * wall;
  }
  return speed;
}

Strikes::State Strikes::free_state(const Body& body, double height) const
{
  State state;
  state.direct = speeds_.free_speed(body.type->type, body.radius, height);
  state.turned = turned(body, state.direct);
  if (speeds_.push() > 0) state.direct = std::max(state.direct, state.turned);  // and comes down again
  if (speeds_.shake() > 0) state.direct = state.turned = std::max(state.direct, shaken(body));
  return state;
}

void Strikes::strike(State& light, const Body& a, const State& heavy, const Body& b) const
{
  const double approach = heavy.direct + light.direct;
  if (!(approach > 0)) return;
  const double e = restitution_of(options_, meeting_of(*a.type, *b.type), effective_radius(a.radius, b.radius), effective_mass(a.mass, b.mass), approach);
  const double struck = (1 + e) * b.mass / (a.mass + b.mass) * approach - light.direct;
  if (struck <= light.direct) return;
  light = {struck, std::max(light.turned, turned_by_impact(a, struck)), true};
}

const Strikes::States& Strikes::states_at(double height) const
{
  const auto [found, is_new] = states_.try_emplace(height);
  if (!is_new) return found->second;
  States& states = found->second;
  for (const Body& body : bodies_) {
    const State own = free_state(body, height);
    State fastest = own;
    for (const auto& [heavy, state] : states) {
      if (!(heavy->mass > body.mass)) continue;
      State struck = own;
      strike(struck, body, state, *heavy);
      if (struck.direct > fastest.direct) fastest = struck;
    }
    states[&body] = fastest;
  }
  return states;
}

Approach Strikes::between(const Body& a, const Body& b) const
{
  if (options_.speed) return {*options_.speed, "given"};
  const States& states = states_at(speeds_.floor());
  const State &sa = states.at(&a), &sb = states.at(&b);
  const double speed = std::max({sa.direct + sb.turned, sb.direct + sa.turned, before_any_wall(a, b)});
  return {speed, sa.is_struck || sb.is_struck ? "strike" : "fall"};
}

/// One of the two starts later, or rests: gravity takes both alike.
double Strikes::before_any_wall(const Body& a, const Body& b) const
{
  const auto free_speed = [&](const Body& body) { return speeds_.free_speed(body.type->type, body.radius, speeds_.floor()); };
  const double starts = speeds_.start_speed(a.type->type) + speeds_.start_speed(b.type->type);
  return std::min(free_speed(a) + free_speed(b), std::max(free_speed(a), free_speed(b)) + starts);
}

Approach Strikes::to(const std::vector<const Wall*>& walls, const Body& a) const
{
  if (options_.speed) return {*options_.speed, "given"};
  Approach fastest;
  for (const Wall* w : walls) {
    const Vec3& upward = speeds_.upward();
    const bool falls = norm(upward) > 0;
    const State state = states_at(falls ? w->box.bottom(upward) : 0.0).at(&a);
    const Approach approach{state.direct + w->push_speed, state.is_struck ? "strike" : "fall"};
    if (fastest.basis.empty() || approach.speed > fastest.speed) fastest = approach;
  }
  if (const double slip = slip_speed(a); slip > fastest.speed) fastest = {slip, "slip"};
  return fastest;
}

/// The light one between the heavy one and another, or a wall: of its contact with these (`at_backing`), or of that
/// with the heavy one.
Load Strikes::caught(const Body& heavy, const Body& light, const Body* other, const Wall* wall, bool at_backing) const
{
  const double speed = other ? options_.speed.value_or(before_any_wall(heavy, *other)) : to({wall}, heavy).speed;
  const double mass = other ? effective_mass(heavy.mass, other->mass) : heavy.mass;
  if (!(speed > 0)) return {};
  const auto overlap_at = [&](const Meeting& m, double r_eff) {
    return [this, m, r_eff, mass, speed](double part) { return overlap_of(options_, m, r_eff, part * mass, speed).value; };
  };
  const auto at_heavy = overlap_at(meeting_of(*heavy.type, *light.type), effective_radius(heavy.radius, light.radius));
  const auto behind =
      other ? overlap_at(meeting_of(*light.type, *other->type), effective_radius(light.radius, other->radius)) : overlap_at(at_wall(light, *wall), light.radius);
  const double part = share_of_first(at_heavy, behind);
  return {(at_backing ? 1 - part : part) * mass, speed};
}

namespace {

void take_larger(Load& into, const Load& other)
{
  if (other.energy() > into.energy()) into = other;
}

}  // namespace

Load Strikes::load_at(const std::vector<const Wall*>& walls, const Body& a) const
{
  Load largest;
  for (const Body* heavy : heavier_than(a))
    for (const Wall* wall : walls) take_larger(largest, caught(*heavy, a, nullptr, wall, true));
  return largest;
}

double Strikes::slip_speed(const Body& a) const
{
  const auto [known, is_new] = slips_.try_emplace(&a, 0.0);
  double& fastest = known->second;
  if (!is_new) return fastest;
  for (const Body* heavy : heavier_than(a))
    for (const Wall* wall : speeds_.walls()) {
      const Load load = caught(*heavy, a, nullptr, wall, true);
      if (!(load.energy() > 0)) continue;
      const double e = restitution_of(options_, at_wall(a, *wall), a.radius, load.mass, load.speed);
      fastest = std::max(fastest, e * load.speed * std::sqrt(heavy->mass / a.mass));
    }
  return fastest;
}

Load Strikes::load_between(const Body& a, const Body& b) const
{
  Load largest;
  const Body &light = a.mass < b.mass ? a : b, &heavy = a.mass < b.mass ? b : a;
  const auto others = [&](const Body& body) {
    std::vector<const Body*> found = heavier_than(light);
    if (body.is_single) std::erase(found, &body);
    return found;
  };
  if (light.mass < heavy.mass) {
    for (const Wall* wall : speeds_.walls()) take_larger(largest, caught(heavy, light, nullptr, wall, false));
    for (const Body* other : others(heavy)) take_larger(largest, caught(heavy, light, other, nullptr, false));
  }
  for (const Body* above : heavier_than(heavy)) {
    const double part = std::max(a.radius, b.radius) / (6 * above->radius);  // 2 pi R h over pi r^2, h = 3 r
    const double speed = speeds_.walls().empty() ? between(*above, light).speed : to(speeds_.walls(), *above).speed;
    take_larger(largest, {part * above->mass, speed});
  }
  return largest;
}

}  // namespace granulaw::deck
