#include "characterise/file/law_file_plan.hpp"

#include "characterise/run/request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "characterise/build/build_law.hpp"
#include "atlas/composed_law.hpp"
#include "characterise/body/law_body.hpp"
#include "characterise/body/law_material.hpp"
#include "law/range.hpp"

namespace granulaw {

namespace {

using Names = std::pair<std::string, std::string>;

void check_range(const char* what, double value, double low, double high)
{
  if (!(value >= low && value <= high))
    fail(what, "cannot be used", fmt::format("{:g}", value), fmt::format("{:g} to {:g}", low, high));
}

void check_numbers(const LawFileRequest& r)
{
  if (!(r.depth > 0)) fail("depth", "cannot be used", fmt::format("{:g}", r.depth), fmt::format("over 0, up to {:g}", deepest_law));
  check_range("depth", r.depth, 0, deepest_law);
  check_range("damage_number", r.damage_number, 0, fastest_law);
  check_range("tolerance", r.tolerance, 1e-4, 0.5);
  check_range("radius_ratio", r.radius_ratio, 1, most_unlike_sizes);
  check_range("slowest", r.slowest, 0, 1e9);
}

bool same_pair(const Names& p, const Names& q)
{
  return p == q || (p.first == q.second && p.second == q.first);
}

std::vector<Names> every_pair(const Materials& materials)
{
  std::vector<Names> pairs;
  const std::vector<std::string> names = names_of(materials.materials);
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t k = i; k < names.size(); ++k) pairs.emplace_back(names[i], names[k]);
    pairs.emplace_back(names[i], wall_name);
  }
  return pairs;
}

/// The pairs asked for, checked.
std::vector<Names> pairs_of(const LawFileRequest& r)
{
  if (r.pairs.empty()) return every_pair(r.materials);
  std::vector<Names> pairs;
  for (Names pair : r.pairs) {
    if (pair.first == wall_name) std::swap(pair.first, pair.second);
    r.materials.require(pair.first);
    if (pair.second != wall_name) r.materials.require(pair.second);
    for (const Names& other : pairs)
      if (same_pair(pair, other))
        fail(r.words.pair,
             fmt::format("'{}:{}' and '{}:{}' are one pair", other.first, other.second, pair.first,
                         pair.second),
             {}, "each pair once");
    pairs.push_back(pair);
  }
  return pairs;
}

/// Why the law of this body needs runs; empty: the atlas has it.
std::string why_runs(const LawBody& body, const LawFileRequest& r)
{
  if (!body.characterised.is_plain()) return "its law is its own";
  if (!r.atlas) return r.words.no_atlas;
  return body.characterised.yields() ? r.atlas->why_not(MaterialRatios::of(body.material)) : std::string();
}

std::map<std::string, LawFilePlan::Body> bodies_of(const std::vector<Names>& pairs, const LawFileRequest& r)
{
  const std::string hint = fmt::format("name a particle of it, {} PARTICLE:{}", r.words.pair, wall_name);
  std::map<std::string, LawFilePlan::Body> bodies;
  for (const auto& [a, b] : pairs)
    for (const std::string& name : {a, b}) {
      if (name == wall_name || bodies.contains(name)) continue;
      LawBody body = law_body(name, r.materials, hint);
      const std::string why = why_runs(body, r);
      bodies.emplace(name, LawFilePlan::Body{std::make_shared<const LawBody>(std::move(body)), why});
    }
  return bodies;
}

/// Throws for a pair of different bodies that the pair rule is not for.
void check_pairs(const std::vector<Names>& pairs, const std::map<std::string, LawFilePlan::Body>& bodies,
                 const std::string& word)
{
  const auto as_law = [&](const std::string& name) {
    BodyLaw law;
    law.material = bodies.at(name).body->material;
    law.body = bodies.at(name).body->body;
    return law;
  };
  for (const auto& [a, b] : pairs)
    if (b != wall_name && a != b) check_partners(as_law(a), as_law(b), fmt::format("{} {}:{}", word, a, b));
}

/// Throws where `slowest` is of no use, or leaves the rate axis no room.
void check_slowest(const LawFileRequest& r, const std::map<std::string, LawFilePlan::Body>& bodies)
{
  if (r.slowest == 0) return;
  constexpr double room = 0.7;  // of the fastest impact, below which the axis has at least two nodes
  bool used = false;
  for (const auto& [name, planned] : bodies) {
    if (!planned.body->characterised.rate_dependent()) continue;
    used = true;
    const LawMaterial& m = planned.body->material;
    const double limit = room * std::sqrt(r.damage_number * m.yield_stress / m.density);
    if (r.slowest > limit)
      fail(r.words.slowest,
           fmt::format("is no slower than the fastest impact of '{}' ({})", name, r.words.damage_number),
           fmt::format("{:g} m/s", r.slowest), fmt::format("up to {:.4g} m/s", limit));
  }
  if (!used) fail(r.words.slowest, "no body of the pairs depends on the rate: leave it out");
}

/// True if the atlas holds the body's equivalent spheres (PairBody): a homogeneous sphere without rate
/// dependence.
bool can_be_composed(const LawFilePlan::Body& body, const LawFileRequest& r)
{
  if (!r.atlas || body.body->body != sphere_name || body.body->characterised.rate_dependent()) return false;
  if (body.from_atlas()) return true;
  const LawMaterial& m = body.body->material;
  return m.yields() && r.atlas->why_not({m.e_star() / m.yield_stress, m.poisson_ratio, 0}).empty();
}

LawFilePlan::Pair plan_pair(const Names& names, const LawFilePlan& plan)
{
  const LawFileRequest& r = plan.request;
  const LawFilePlan::Body& first = plan.bodies.at(names.first);
  if (names.second == wall_name) return {granulaw::plan_pair(first.body->material, nullptr, r, false)};
  const LawFilePlan::Body& second = plan.bodies.at(names.second);
  const LawBody &a = *first.body, &b = *second.body;
  LawFilePlan::Pair pair{granulaw::plan_pair(a.material, &b.material, r,
                                             can_be_composed(first, r) && can_be_composed(second, r))};
  if (pair.a == pair.b || !a.is_plain_sphere() || !b.is_plain_sphere()) return pair;
  const UnlikePair bodies = unlike_pair(a.material, b.material);
  const ComposedError composed = composed_error(bodies.partner.e_star() / bodies.yielding.e_star());
  pair.worth_own_law = bodies.yielding.yields() &&
                       (pair.composed_at.empty() || std::max(composed.force, composed.restitution) > r.tolerance);
  pair.own_law = r.own_laws && pair.worth_own_law;
  return pair;
}

/// Throws where one file cannot hold the laws of all pairs.
void check_count(const LawFilePlan& plan)
{
  std::size_t laws = plan.bodies.size();
  for (const LawFilePlan::Pair& pair : plan.pairs)
    laws += std::max(pair.composed_at.size(), static_cast<std::size_t>(pair.own_law));
  if (laws > most_laws_of_file)
    fail(plan.request.words.pair,
         fmt::format("{} pairs, with a law for each ratio of radii, are too many for one file: name those that meet, "
                     "or take a smaller ratio of radii",
                     plan.pairs.size()),
         fmt::format("{} laws", laws), fmt::format("up to {}", most_laws_of_file));
}

}  // namespace

bool LawFilePlan::needs_runs() const
{
  return std::any_of(bodies.begin(), bodies.end(),
                     [](const auto& b) { return !b.second.from_atlas() || b.second.body->shape; }) ||
         std::any_of(pairs.begin(), pairs.end(), [](const Pair& p) { return p.own_law; });
}

BuildOptions LawFilePlan::build_options() const
{
  BuildOptions options;
  options.depth = request.depth;
  options.fastest = std::sqrt(request.damage_number);
  options.tolerance = request.tolerance;
  options.atlas = request.atlas;
  return options;
}

LawFilePlan plan_law_file(LawFileRequest request)
{
  check_numbers(request);
  const std::vector<Names> pairs = pairs_of(request);
  LawFilePlan plan;
  plan.request = std::move(request);
  plan.bodies = bodies_of(pairs, plan.request);
  check_pairs(pairs, plan.bodies, plan.request.words.pair);
  check_slowest(plan.request, plan.bodies);
  for (const auto& [name, body] : plan.bodies)
    if (!body.from_atlas())
      require_reachable(body.body->material, body.body->characterised, plan.build_options());
  for (const Names& names : pairs) plan.pairs.push_back(plan_pair(names, plan));
  check_count(plan);
  return plan;
}

}  // namespace granulaw
