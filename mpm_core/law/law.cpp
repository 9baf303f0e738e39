#include "law/law.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <tuple>

#include "base/error.hpp"

namespace granulaw {

namespace {

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

bool Law::has_pair(const std::string& a, const std::string& b) const
{
  for (const auto& [i, j] : pairs)
    if ((i == a && j == b) || (i == b && j == a)) return true;
  return false;
}

std::string Law::pair_list() const
{
  std::vector<std::string> names;
  for (const auto& [i, j] : pairs) names.push_back(i + ":" + j);
  return fmt::format("{}", fmt::join(names, ", "));
}

PairLaw resolve_pair(const Law& law, const std::string& a, const std::string& b, const std::string& where)
{
  if (a == wall_name && b != wall_name) return resolve_pair(law, b, a, where);
  const BodyLaw& first = body(law, a, where);
  const BodyLaw* second = b == wall_name ? nullptr : &body(law, b, where);
  if (!law.has_pair(a, b))
    fail(where, fmt::format("the law was not built for the pair '{}:{}'", a, b), {}, law.pair_list());

  if (!second) return {&first.curve, PairMapping::rigid_partner(first.material.e_star()), &first};
  const auto rank = [](const BodyLaw& l) {
    return std::tuple(l.material.yield_stress, l.material.e_star(), l.material.name);
  };
  const bool first_yields = rank(first) <= rank(*second);
  const BodyLaw& yielding = first_yields ? first : *second;
  const BodyLaw& partner = first_yields ? *second : first;
  return {&yielding.curve,
          PairMapping::deformable_partner(yielding.material.e_star(), partner.material.e_star()), &yielding};
}

}  // namespace granulaw
