#include "law/chosen_pair.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "base/error.hpp"

namespace granulaw {

namespace {

PairNames names_of(const Law& law, const PairAsked& asked)
{
  const std::vector<PairNames> pairs = pairs_asked(asked.pair, law);
  if (pairs.size() != 1) fail("--pair", "the law holds several pairs: name one", {}, law.pair_list());
  const auto& [a, b] = pairs.front();
  return a == wall_name ? PairNames(b, a) : pairs.front();
}

/// True of the radius of a thick deformable wall.
bool is_thick_wall(double radius)
{
  return radius == std::numeric_limits<double>::infinity();
}

void require_radius(const char* option, double value)
{
  if (!(value >= 1e-9 && value <= 1e3))
    fail(option, "cannot be used", fmt::format("{:g} m", value), "1e-09 to 1000 m");
}

/// Wider than any particle; within, no number of a replay leaves the range of a double.
void check_radii(const PairAsked& asked, const PairNames& names, double radius, double radius2)
{
  if (names.second == wall_name && asked.radius2) fail("--radius2", "a rigid wall has no radius");
  require_radius("--radius", radius);
  if (!is_thick_wall(radius2)) require_radius("--radius2", radius2);
}

}  // namespace

ChosenPair choose_pair(const Law& law, const PairAsked& asked)
{
  const PairNames names = names_of(law, asked);
  const auto& [a, b] = names;
  const double only_radius = resolve_pair(law, a, b, asked.law).only_radius();
  const double radius = asked.radius.value_or(only_radius > 0 ? only_radius : 1e-3);
  const double radius2 = asked.radius2.value_or(radius);
  check_radii(asked, names, radius, radius2);
  const PairLaw pair = resolve_pair(law, a, b, asked.law, radius, radius2);

  const std::string& yielding = pair.yielding->material.name;
  if (a == yielding) check_size(pair, radius, "--radius");
  if (b == yielding) check_size(pair, radius2, "--radius2");

  const double mass = law.bodies.at(a).mass(radius);
  if (b == wall_name || is_thick_wall(radius2)) return {names, radius, radius2, pair, radius, mass};
  return {names,
          radius,
          radius2,
          pair,
          effective_radius(radius, radius2),
          effective_mass(mass, law.bodies.at(b).mass(radius2))};
}

}  // namespace granulaw
