#include "law/law.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/error.hpp"
#include "law/radiation.hpp"
#include "law/size_choice.hpp"

namespace granulaw {

namespace {

constexpr double like_sizes = 0.5;  // share of either body

const BodyLaw& body(const Law& law, const std::string& name, const std::string& where)
{
  const auto found = law.bodies.find(name);
  if (found != law.bodies.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& entry : law.bodies) names.push_back(entry.first);
  fail(where, fmt::format("the law has no material '{}'{}", name, did_you_mean(name, names)), {},
       fmt::format("{}", fmt::join(names, ", ")));
}

}  // namespace

const LawPair* Law::find_pair(const std::string& a, const std::string& b) const
{
  for (const LawPair& pair : pairs)
    if ((pair.a == a && pair.b == b) || (pair.a == b && pair.b == a)) return &pair;
  return nullptr;
}

const std::vector<TwoBodyLaw>* Law::find_pair_laws(const std::string& a, const std::string& b) const
{
  for (const std::string& name : {a + ":" + b, b + ":" + a})
    if (const auto found = pair_laws.find(name); found != pair_laws.end()) return &found->second;
  return nullptr;
}

std::vector<double> Law::size_shares(const std::string& a, const std::string& b) const
{
  std::vector<double> shares;
  const std::vector<TwoBodyLaw>* laws = find_pair_laws(a, b);
  if (laws)
    for (const TwoBodyLaw& own : *laws) shares.push_back(own.size_share());
  if (a == b || shares.empty()) shares.push_back(like_sizes);
  std::sort(shares.begin(), shares.end());
  shares.erase(std::unique(shares.begin(), shares.end()), shares.end());
  return shares;
}

bool Law::states_unloading_radius() const
{
  const auto of_body = [](const auto& entry) { return entry.second.curve.states_unloading_radius(); };
  const auto of_pair = [](const auto& entry) {
    return std::all_of(entry.second.begin(), entry.second.end(),
                       [](const TwoBodyLaw& own) { return own.law.curve.states_unloading_radius(); });
  };
  return std::all_of(bodies.begin(), bodies.end(), of_body) && std::all_of(pair_laws.begin(), pair_laws.end(), of_pair);
}

std::string Law::pair_list() const
{
  std::vector<std::string> names;
  for (const LawPair& pair : pairs) names.push_back(pair.a + ":" + pair.b);
  return fmt::format("{}", fmt::join(names, ", "));
}

bool yields_first(const LawMaterial& a, const LawMaterial& b)
{
  const auto rank = [](const LawMaterial& m) { return std::tuple(m.yield_stress, m.e_star(), m.name); };
  return rank(a) <= rank(b);
}

void check_partners(const BodyLaw& a, const BodyLaw& b, const std::string& where)
{
  if (a.material.name == b.material.name) return;
  for (const BodyLaw* body : {&a, &b})
    if (!body->is_sphere())
      fail(where,
           fmt::format(
               "the law of '{}' is that of a body '{}', no homogeneous sphere: it holds only against the "
               "rigid wall and its like",
               body->material.name, body->body),
           fmt::format("'{}:{}'", a.material.name, b.material.name),
           fmt::format("{0}:{0}, {0}:{1}", body->material.name, wall_name));
}

double PairLaw::usual_mass(double r_eff) const
{
  const bool rigid = mapping.sqrt_lambda == 1.0;
  return rigid ? yielding->mass(r_eff) : 0.5 * yielding->mass(2 * r_eff);
}

void check_size(const PairLaw& pair, double radius, const std::string& where)
{
  const double only = pair.only_radius();
  if (only > 0 && !(std::abs(radius / only - 1) <= size_tolerance))
    fail(where,
         fmt::format("the law of '{}' depends on the strain rate, so it holds for one size: radius",
                     pair.yielding->material.name),
         fmt::format("{:.6g} m", radius),
         fmt::format("{:.6g} m within {:.0f} %: make a law for each size", only, 100 * size_tolerance));
}

std::string unknown_flow_stress(const Law& law, const PairLaw& pair)
{
  const BodyLaw& body = *pair.yielding;
  const std::string& name = body.material.name;
  const char* what = nullptr;
  if (!body.material.yields()) return {};
  if (!body.is_sphere()) what = "has several materials";
  if (body.curve.axis() && body.curve.axis()->by == AxisTable::By::rate) what = "depends on the strain rate";
  if (what)
    return fmt::format("'{}' {}: 'tangential plastic' needs one flow stress of the body; say 'tangential history'", name, what);
  if (!law.provenance.contains("hardening." + name) || !body.material.flow.strain.empty()) return {};
  const auto command = law.provenance.find("command");
  return fmt::format("'{}' hardens, and this older file lacks its flow stress, which 'tangential plastic' needs: make it anew with `{}`",
                     name, command == law.provenance.end() ? "mpm table" : command->second);
}

SizeChoice size_choice(const Law& law, const std::string& a, const std::string& b)
{
  if (a == b) return {ShareOf::smaller, law.size_shares(a, b)};
  const auto first = law.bodies.find(a), second = law.bodies.find(b);
  const bool a_yields = first == law.bodies.end() || second == law.bodies.end() ||
                        yields_first(first->second.material, second->second.material);
  return {a_yields ? ShareOf::i : ShareOf::j, law.size_shares(a, b)};
}

PairLaw wall_pair(const BodyLaw& body)
{
  return {{&body.curve, PairMapping::rigid_partner(body.material.e_star())}, &body};
}

namespace {

/// The pair's own law at the nearest share of sizes; null: the body's law by the pair rule is nearest.
const TwoBodyLaw* nearest(const Law& law, const std::string& a, const std::string& b, double size_share)
{
  const std::vector<double> shares = law.size_shares(a, b);
  const double share = shares[nearest_share(half_ways(shares), size_share, 1.0)];
  if (a == b && share == like_sizes) return nullptr;
  if (const std::vector<TwoBodyLaw>* laws = law.find_pair_laws(a, b))
    for (const TwoBodyLaw& own : *laws)
      if (own.size_share() == share) return &own;
  return nullptr;
}

}  // namespace

PairLaw resolve_pair(const Law& law, const std::string& a, const std::string& b, const std::string& where,
                     double radius_a, double radius_b)
{
  if (a == wall_name && b != wall_name) return resolve_pair(law, b, a, where);
  const BodyLaw& first = body(law, a, where);
  const BodyLaw* second = b == wall_name ? nullptr : &body(law, b, where);
  if (!law.find_pair(a, b))
    fail(where, fmt::format("the law was not built for the pair '{}:{}'", a, b), {}, law.pair_list());
  if (second) check_partners(first, *second, where);

  if (!second) return wall_pair(first);
  const bool swap = !yields_first(first.material, second->material);
  const BodyLaw &yielding = swap ? *second : first, &partner = swap ? first : *second;
  const PairMapping mapping =
      PairMapping::deformable_partner(yielding.material.e_star(), partner.material.e_star());
  if (a == b) std::tie(radius_a, radius_b) = std::minmax({radius_a, radius_b});
  const double ratio = swap ? radius_a / radius_b : radius_b / radius_a;
  if (std::isnan(ratio))
    fail(where, "the radii of a pair have no ratio", fmt::format("{:g} and {:g}", radius_a, radius_b),
         "numbers over 0, at most one of them infinity");
  const TwoBodyLaw* own = nearest(law, a, b, 1 / (1 + ratio));
  if (!own) return {{&yielding.curve, mapping}, &yielding};
  const bool composed = own->law.certificate.origin == composed_origin;
  const double waves = composed ? radiation(yielding.material, swap ? radius_b : radius_a, partner.material,
                                            swap ? radius_a : radius_b)
                                : 0.0;
  return {{&own->law.curve, mapping, waves}, &own->law};
}

}  // namespace granulaw
