#include "atlas/law_from_atlas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/error.hpp"
#include "atlas/body_numbers.hpp"
#include "atlas/confident_bound.hpp"
#include "atlas/finish_curve.hpp"
#include "atlas/tabulate_curve.hpp"

namespace granulaw {

namespace {

/// Errors of the atlas's laws about one stiffness E*/Y.
struct NearErrors
{
  double force = 0, restitution = 0;  ///< against fresh impacts: relative; absolute
  double solver = 0;                  ///< of these impacts, of F and e: relative
};

/// Errors of the checks nearest in ln(E*/Y), with which both grow. 93 are the fewest of which the second largest
/// error bounds 95 % with a confidence of 95 % (confident_bound.hpp). The solver's error is that of 95 % of their
/// estimates, times the largest ratio of true error to estimate in 32 (docs/evidence/solver-accuracy.md).
NearErrors errors_near(std::vector<AtlasCheck> checks, double stiffness)
{
  constexpr std::size_t near = 93;
  constexpr double true_over_estimate = 0.67;
  if (checks.empty()) return {};
  const auto distance = [&](const AtlasCheck& c) { return std::abs(std::log(c.material.stiffness / stiffness)); };
  std::sort(checks.begin(), checks.end(),
            [&](const AtlasCheck& a, const AtlasCheck& b) { return distance(a) < distance(b); });
  checks.resize(std::min(checks.size(), near));
  std::vector<double> estimates;
  for (const AtlasCheck& c : checks) estimates.push_back(c.solver_estimate);
  std::sort(estimates.begin(), estimates.end());
  const auto at95 = static_cast<std::size_t>(std::ceil(0.95 * static_cast<double>(estimates.size()))) - 1;
  return {confident_bound(checks, &AtlasCheck::error_force), confident_bound(checks, &AtlasCheck::error_restitution),
          true_over_estimate * estimates[at95]};
}

}  // namespace

BodyLaw law_from(const Atlas& atlas, const LawMaterial& material, const LawRange& range)
{
  check(range);
  BodyLaw law;
  law.material = material;
  Certificate& c = law.certificate;
  c.origin = "atlas";
  if (!material.yields()) {
    const ElasticSphere sphere = atlas.elastic(material.poisson_ratio);
    const double depth = std::min(range.depth, ElasticSphere::depth);
    law.curve = tabulate_elastic(sphere.fit.correction, depth);
    c.damage_number_max = std::numeric_limits<double>::infinity();
    c.atlas_error_force = sphere.fit.error;  // e is 1
    c.solver_error_force = sphere.solver_error;
    return law;
  }
  const MaterialRatios ratios = MaterialRatios::of(material);
  if (const std::string why = atlas.why_not(ratios); !why.empty())
    fail(fmt::format("material '{}'", material.name), "is not in the atlas: " + why);
  c.damage_number_max = range.fastest * range.fastest;
  c.interpolation_error = finish_curve(law, atlas.shape(ratios), body_numbers(ratios), range);
  const NearErrors errors = errors_near(atlas.checks(), ratios.stiffness);
  c.atlas_error_force = errors.force;
  c.atlas_error_restitution = errors.restitution;
  c.solver_error_force = c.solver_error_restitution = errors.solver;
  return law;
}

}  // namespace granulaw
