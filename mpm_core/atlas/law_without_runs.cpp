#include "atlas/law_without_runs.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "atlas/composed_law.hpp"
#include "atlas/law_from_atlas.hpp"
#include "base/error.hpp"

namespace granulaw {

namespace {

/// Partner's radius over the yielding body's, so close that half a step changes F by 0.4 % and e by 0.002 at
/// most: even steps in R_s/(R_s + R_h).
std::vector<double> composed_ratios(const SceneSizes& r, bool one_material)
{
  constexpr double step = 0.05, like = 0.5;
  const double range = like - 1 / (1 + r.radius_ratio);
  const int steps = static_cast<int>(std::ceil(range / step - 1e-9));
  std::vector<double> ratios;
  if (r.thick_walls && !one_material) ratios.push_back(0);
  for (int k = one_material ? 1 : -steps; k <= steps; ++k) {
    const double share = steps > 0 ? like - range * k / steps : like;
    ratios.push_back(1 / share - 1);
  }
  if (r.thick_walls) ratios.push_back(std::numeric_limits<double>::infinity());
  return ratios;
}

}  // namespace

PlannedPair plan_pair(const LawMaterial& a, const LawMaterial* b, const SceneSizes& sizes, bool composable)
{
  PlannedPair pair{a.name, b ? b->name : wall_name};
  if (!b) return pair;
  if (composable) pair.composed_at = composed_ratios(sizes, a.name == b->name);
  return pair;
}

ComposedLaws compose_laws(const Atlas& atlas, const PairBody& yielding, const PairBody& partner,
                          const std::vector<double>& ratios, const LawRange& range)
{
  ComposedLaws made;
  for (const double ratio : ratios) try {
      made.laws.push_back(compose_law(atlas, yielding, partner, ratio, range));
    } catch (const Error& error) {
      made.not_composed[ratio] = error.what();
    }
  return made;
}

void add_pair_laws(Law& law, const PlannedPair& pair, ComposedLaws made)
{
  law.pairs.push_back({pair.a, pair.b});
  if (!made.laws.empty()) law.pair_laws[pair.name()] = std::move(made.laws);
  for (const auto& [ratio, reason] : made.not_composed)
    law.provenance[fmt::format("not_composed.{}.{:.4g}", pair.name(), ratio)] = reason;
}

Law law_without_runs(const Atlas& atlas, const std::vector<LawMaterial>& materials,
                     const std::vector<PlannedPair>& pairs, const LawRange& range)
{
  Law law;
  for (const LawMaterial& m : materials) law.bodies[m.name] = law_from(atlas, m, range);
  std::map<std::string, PairBody> bodies;  // made once for all pairs
  const auto body = [&](const LawMaterial& m) -> const PairBody& {
    return bodies.try_emplace(m.name, atlas, m).first->second;
  };
  for (const PlannedPair& pair : pairs) {
    ComposedLaws made;
    if (!pair.composed_at.empty()) {
      const UnlikePair two = unlike_pair(law.bodies.at(pair.a).material, law.bodies.at(pair.b).material);
      made = compose_laws(atlas, body(two.yielding), body(two.partner), pair.composed_at, range);
    }
    add_pair_laws(law, pair, std::move(made));
  }
  return law;
}

}  // namespace granulaw
