// The interactive page's module: requests as JSON in (request.hpp), answers as JSON out. It calls what `mpm table` and `mpm law`
// call. An answer is an object, or {"problem": sentence}.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <exception>
#include <limits>
#include <list>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "atlas/atlas_numbers.hpp"
#include "atlas/law_without_runs.hpp"
#include "base/error.hpp"
#include "base/scales.hpp"
#include "contact/tabulated.hpp"
#include "contact/thornton.hpp"
#include "law/contact_limits.hpp"
#include "law/contact_time.hpp"
#include "law/stated_collision.hpp"
#include "law_report.hpp"
#include "material_file/plausible.hpp"
#include "request.hpp"

namespace granulaw {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
const char* const source = "law";  // leads sentences about a collision

std::optional<Atlas> atlas;

/// The law of a request's pair, as `mpm table --radius-ratio RATIO` makes it.
Law make_law(const Request& r)
{
  const SceneSizes sizes = r.sizes();
  std::vector<LawMaterial> materials{r.first};
  if (!r.one_material) materials.push_back(r.second);
  const PlannedPair pair = plan_pair(r.first, r.has_rigid_wall() ? nullptr : &r.second, sizes, true);
  return law_without_runs(*atlas, materials, {pair}, {});
}

/// The last laws, so that another speed or radius costs none.
const Law& law_of(const Request& r)
{
  constexpr std::size_t most = 8;
  static std::list<std::pair<std::string, std::unique_ptr<Law>>> kept;
  const std::string key = r.key();
  for (auto at = kept.begin(); at != kept.end(); ++at)
    if (at->first == key) {
      kept.splice(kept.begin(), kept, at);
      return *kept.front().second;
    }
  auto law = std::make_unique<Law>(make_law(r));
  kept.emplace_front(key, std::move(law));
  if (kept.size() > most) kept.pop_back();
  return *kept.front().second;
}

/// A closed formula of the same pair: Thornton's, or Hertz's where nothing yields.
struct Formula
{
  Thornton pair;
  double r_eff, m_eff;

  Replay collision(double speed, int steps) const
  {
    const double duration = customary_contact_time(pair.e_star, r_eff, m_eff, speed);
    return replay_collision([this](double delta, double delta_max) { return pair.evaluate(r_eff, delta, delta_max); }, m_eff, speed, duration, steps);
  }
};

Formula hertz_of(const ChosenPair& c) { return {{c.law.mapping.e_star_pair(), infinite}, c.r_eff, c.m_eff}; }

/// Thornton's formula with the customary yield pressure of the body that yields first.
Formula thornton_of(const ChosenPair& c) { return {{c.law.mapping.e_star_pair(), customary_yield_pressure * c.law.yielding->material.yield_stress}, c.r_eff, c.m_eff}; }

constexpr int picture_steps = 1500;  // of a collision whose curve is drawn: e within 2e-6
constexpr int sweep_steps = 400;     // of one of many: e within 1e-5

/// Up to `points` samples of a collision: time, overlap, force.
Json curve_of(const Replay& replay, std::size_t points)
{
  Json time = Json::array(), overlap = Json::array(), force = Json::array();
  const std::size_t n = replay.samples.size(), stride = std::max<std::size_t>(1, n / points);
  std::size_t deepest = 0;
  for (std::size_t k = 0; k < n; ++k)
    if (replay.samples[k].delta > replay.samples[deepest].delta) deepest = k;
  for (std::size_t k = 0; k < n; ++k) {
    if (k % stride != 0 && k + 1 != n && k != deepest) continue;
    time.push_back(replay.samples[k].time);
    overlap.push_back(replay.samples[k].delta);
    force.push_back(replay.samples[k].force);
  }
  return {{"time", time}, {"overlap", overlap}, {"force", force}};
}

Json formula_json(const Formula& formula, double speed)
{
  const Replay replay = formula.collision(speed, picture_steps);
  Json out = collision_json(replay);
  out["curve"] = curve_of(replay, 240);
  return out;
}

/// Speed at which a collision goes as deep as `overlap` (m), to 1e-4; infinity: beyond `fastest` or never.
double speed_to_overlap(const ChosenPair& c, double overlap, double fastest)
{
  const auto reaches = [&](double speed) { return replay_collision(c.law, c.r_eff, c.m_eff, speed, 100).delta_max >= overlap; };
  double low = 1e-9 * fastest, high = fastest;
  if (!reaches(high)) return infinite;
  while (high / low > 1 + 1e-4) {
    const double middle = std::sqrt(low * high);
    (reaches(middle) ? high : low) = middle;
  }
  return high;
}

/// Speeds and the time step at which something changes.
struct Limits
{
  double onset, bound, axis, tenth, depth, end, step;
};

/// s, largest time step of a sphere that meets its like and rigid walls, as the spheres of a deck also do.
double largest_step_of_body(const BodyLaw& body, double radius)
{
  const double mass = 4.0 / 3.0 * M_PI * body.material.density * radius * radius * radius;
  const double e_star = body.material.e_star();
  const auto step = [&](const PairMapping& mapping, double r_eff, double m_eff) {
    const PairLaw pair{{&body.curve, mapping}, &body};
    return largest_step_of(Tabulated(pair, pair.measure(), Scale{}), r_eff, m_eff);
  };
  return std::min(step(PairMapping::rigid_partner(e_star), radius, mass), step(PairMapping::deformable_partner(e_star, e_star), radius / 2, mass / 2));
}

Limits limits_of(const Law& law, const ChosenPair& c, const PairStatement& statement, double damage_number_now, double speed)
{
  const Tabulated contact(c.law, c.law.measure(), Scale{});
  Limits l{};
  l.onset = onset_speed(contact, c.r_eff, c.m_eff);
  l.bound = damage_number_now > 0 ? speed * std::sqrt(statement.damage_number_max / damage_number_now) : infinite;
  l.axis = c.law.max_speed(c.r_eff, c.m_eff);
  const double length = c.law.mapping.length(c.r_eff);
  // an elastic contact reaches any depth below its speed of sound, a yielding one below that of I = 1
  const double unit = std::sqrt(c.law.mapping.force(c.r_eff) * length / c.m_eff);
  l.tenth = speed_to_overlap(c, 0.1 * length, unit);
  l.depth = speed_to_overlap(c, 1.05 * c.limit(), unit);
  l.end = std::min(l.axis, l.depth);
  l.step = largest_step_of(contact, c.r_eff, c.m_eff);
  for (const auto& entry : law.bodies) {
    const double radius = entry.first == c.names.first ? c.radius : c.radius2;
    if (std::isfinite(radius)) l.step = std::min(l.step, largest_step_of_body(entry.second, radius));
  }
  return l;
}

Json limits_json(const Limits& l)
{
  return {{"yield_speed", json_number(l.onset)}, {"bound_speed", json_number(l.bound)}, {"axis_speed", json_number(l.axis)}, {"tenth_speed", json_number(l.tenth)},
      {"depth_speed", json_number(l.depth)}, {"end_speed", json_number(l.end)}, {"largest_time_step", json_number(l.step)}};
}

/// e of the law, its error bound, and Thornton's e, at speeds around those of interest.
Json sweep_json(const ChosenPair& c, const Limits& l, const ErrorBound& bound, double speed)
{
  const double high = std::isfinite(l.end) ? l.end : 10 * speed;
  const double low = std::min(std::isfinite(l.onset) ? 0.3 * l.onset : 1e-4 * high, 0.3 * speed);
  constexpr int points = 61;
  Json speeds = Json::array(), e = Json::array(), error = Json::array(), thornton = Json::array(), deepest = Json::array();
  const Formula formula = thornton_of(c);
  for (int k = 0; k < points; ++k) {
    const double v = low * std::pow(high / low, k / double{points - 1});
    const Replay replay = replay_collision(c.law, c.r_eff, c.m_eff, v, sweep_steps);
    speeds.push_back(v);
    e.push_back(replay.restitution);
    deepest.push_back(replay.delta_max);
    error.push_back(v <= l.bound * (1 + 1e-9) ? Json(bound.at(c.law.axis_speed(c.r_eff, c.m_eff, v)).restitution_at(replay.restitution)) : Json());
    thornton.push_back(formula.collision(v, sweep_steps).restitution);
  }
  return {{"speed", speeds}, {"e", e}, {"error", error}, {"thornton", thornton}, {"overlap", deepest}};
}

struct Answered
{
  Request request;
  const Law& law;
  ChosenPair pair;
  StatedCollision found;
  double cpu_s;
};

const Atlas& opened()
{
  if (!atlas) fail("explorer", "the atlas is not open");
  return *atlas;
}

Answered answer(const char* text)
{
  opened();
  const Request r = request_of(Json::parse(text));
  const Law& law = law_of(r);
  const ChosenPair pair = choose_pair(law, r.asked());
  const std::clock_t start = std::clock();
  StatedCollision found = collide(law, pair, r.speed, source);
  const double cpu_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return {r, law, pair, std::move(found), cpu_s};
}

Json explore(const char* text)
{
  const Answered a = answer(text);
  const ChosenPair& c = a.pair;
  const Limits limits = limits_of(a.law, c, a.found.statement, a.found.damage_number, a.request.speed);
  const LawMaterial& yielding = c.law.yielding->material;
  Json out;
  out["law"] = law_json(a.found, a.cpu_s);
  out["curve"] = curve_of(a.found.replay, 400);
  out["warnings"] = warnings_of(c, a.request.speed, a.found);
  out["limits"] = limits_json(limits);
  out["length"] = c.law.mapping.length(c.r_eff);
  out["r_eff"] = c.r_eff;
  out["m_eff"] = c.m_eff;
  out["yields"] = yielding.name;
  out["stiffness_ratio"] = json_number(yielding.e_star() / yielding.yield_stress);
  out["onset_overlap"] = json_number(c.law.curve->onset() * c.law.mapping.length(c.r_eff));
  out["overlap_limit"] = c.limit();
  out["hertz"] = formula_json(hertz_of(c), a.request.speed);
  out["thornton"] = formula_json(thornton_of(c), a.request.speed);
  out["sweep"] = sweep_json(c, limits, a.found.statement.bound, a.request.speed);
  return out;
}

/// Runs `work`; what it throws is the answer {"problem": sentence}. The text stays valid until the next call.
template <class Work>
const char* answered(Work&& work)
{
  static std::string text;
  try {
    text = work().dump();
  } catch (const std::exception& failure) {
    text = Json{{"problem", failure.what()}}.dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  return text.c_str();
}

}  // namespace

}  // namespace granulaw

extern "C" {

/// Takes the atlas: numbers_of(Atlas). To be called once, first.
const char* granulaw_open(const double* numbers, int count)
{
  using namespace granulaw;
  return answered([&] {
    ask_nothing_of_units();
    atlas.emplace(atlas_of(std::span<const double>(numbers, static_cast<std::size_t>(count))));
    return Json{{"error_force", atlas->claimed_force()}, {"error_restitution", atlas->claimed_restitution()}};
  });
}

/// Yield stress of drop tests: the object of `mpm calibrate --json` (request.hpp).
const char* granulaw_calibrate(const char* request)
{
  using namespace granulaw;
  return answered([&] { return drops_json(opened(), Json::parse(request)); });
}

/// Requirements of a bed of these bodies (request.hpp). `bed_height`: m, beside the state's keys.
const char* granulaw_bed(const char* request)
{
  using namespace granulaw;
  return answered([&] {
    const Json json = Json::parse(request);
    return bed_json(opened(), request_of(json), number_of(json, "bed_height", "request"));
  });
}

/// One collision: the object of `mpm law --json`.
const char* granulaw_law(const char* request)
{
  using namespace granulaw;
  return answered([&] {
    const Answered a = answer(request);
    return law_json(a.found, a.cpu_s);
  });
}

/// The same under "law", with the curves and limits that the page draws.
const char* granulaw_explore(const char* request)
{
  using namespace granulaw;
  return answered([&] { return explore(request); });
}
}
