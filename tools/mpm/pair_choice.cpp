#include "pair_choice.hpp"

#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "option_checks.hpp"

namespace granulaw {

namespace {

PairNames names_of(const Law& law, const PairOptions& options)
{
  const std::vector<PairNames> asked = pairs_asked(options.pair, law);
  if (asked.size() != 1) fail("--pair", "the law holds several pairs: name one", {}, law.pair_list());
  const auto& [a, b] = asked.front();
  return a == wall_name ? PairNames(b, a) : asked.front();
}

/// kg, of a body whose radius (of curvature at the pole) is `radius`.
double body_mass(const BodyLaw& body, double radius)
{
  return body.mass_ratio * 4.0 / 3.0 * M_PI * body.material.density * radius * radius * radius;
}

/// True if a body of this radius is a deformable wall.
bool is_thick_wall(double radius)
{
  return radius == std::numeric_limits<double>::infinity();
}

/// Wider than any particle; within, no number of a replay leaves the range of a double.
void check_radii(const PairOptions& options, const PairNames& names, double radius, double radius2)
{
  if (names.second == wall_name && options.radius2) fail("--radius2", "a rigid wall has no radius");
  require_within("--radius", radius, "m", 1e-9, 1e3);
  if (!is_thick_wall(radius2)) require_within("--radius2", radius2, "m", 1e-9, 1e3);
}

}  // namespace

void define_pair_options(Options& command, PairOptions& options)
{
  command.add_option("--pair", options.pair, "a:b or a:wall; may be left out if the file holds one");
  command.add_option(
      "--radius", options.radius,
      "radius of the first body, m (default 1e-3, e depends on no radius; of a rate-dependent\n"
      "law the one it was made for, and no other is allowed)");
  command.add_option("--radius2", options.radius2,
                     "radius of the second body, m (default: the first's); inf: a thick deformable wall");
}

ChosenPair choose_pair(const Law& law, const PairOptions& options)
{
  const PairNames names = names_of(law, options);
  const auto& [a, b] = names;
  const double only_radius = resolve_pair(law, a, b, options.law).only_radius();
  const double radius = options.radius.value_or(only_radius > 0 ? only_radius : 1e-3);
  const double radius2 = options.radius2.value_or(radius);
  check_radii(options, names, radius, radius2);
  const PairLaw pair = resolve_pair(law, a, b, options.law, radius, radius2);

  const std::string& yielding = pair.yielding->material.name;
  if (a == yielding) check_size(pair, radius, "--radius");
  if (b == yielding) check_size(pair, radius2, "--radius2");

  const double mass = body_mass(law.bodies.at(a), radius);
  if (b == wall_name || is_thick_wall(radius2)) return {names, radius, radius2, pair, radius, mass};
  return {names,
          radius,
          radius2,
          pair,
          effective_radius(radius, radius2),
          effective_mass(mass, body_mass(law.bodies.at(b), radius2))};
}

}  // namespace granulaw
