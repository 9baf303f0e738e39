#pragma once

#include <map>
#include <string>
#include <vector>

#include "atlas/atlas.hpp"
#include "atlas/law_range.hpp"
#include "atlas/pair_body.hpp"
#include "atlas/unlike_pair.hpp"
#include "law/law.hpp"

namespace granulaw {

/// Sizes of the spheres in a scene.
struct SceneSizes
{
  double radius_ratio = 1;  ///< largest ratio of two spheres' radii, 1 or more: pairs are composed up to it
  bool thick_walls = true;  ///< either of two bodies may also be a deformable wall
};

/// A pair of a law file, before its law is made.
struct PlannedPair
{
  std::string a, b;  ///< names; b may be wall_name, a is not
  /// Partner's radius over the yielding body's of each law that will be composed, ascending
  /// (composed_law.hpp); infinity: a deformable wall; 0: the yielding body is one. None: the pair follows the
  /// rule, or has its own law by runs.
  std::vector<double> composed_at{};

  std::string name() const { return a + ":" + b; }
};

/// Plans the pair of two homogeneous spheres, or of one and the rigid wall (no `b`). `composable`: the atlas
/// holds the equivalent spheres of both (PairBody).
PlannedPair plan_pair(const LawMaterial& a, const LawMaterial* b, const SceneSizes& sizes, bool composable);

/// Laws of one pair.
struct ComposedLaws
{
  std::vector<TwoBodyLaw> laws;                ///< ascending ratio of radii
  std::map<double, std::string> not_composed;  ///< ratios at which no law can be composed, each with the reason
};
ComposedLaws compose_laws(const Atlas& atlas, const PairBody& yielding, const PairBody& partner,
                          const std::vector<double>& ratios, const LawRange& range);

/// Adds the pair and its laws. At a ratio that cannot be composed the law at the nearest one stands in, or the
/// pair rule where there is none, of which no error is stated; the provenance has the reason.
void add_pair_laws(Law& law, const PlannedPair& pair, ComposedLaws made);

/// A law file's laws without a run of the solver: spheres of these materials by the atlas, which holds them
/// all (Atlas::why_not), and the composed laws of these pairs.
Law law_without_runs(const Atlas& atlas, const std::vector<LawMaterial>& materials,
                     const std::vector<PlannedPair>& pairs, const LawRange& range);

}  // namespace granulaw
