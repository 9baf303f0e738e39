#include "characterise/law_from_atlas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "characterise/characterised_body.hpp"
#include "characterise/finish_curve.hpp"

namespace granulaw {

BodyLaw law_from(const Atlas& atlas, const LawMaterial& material, const BuildOptions& options)
{
  check(options);
  BodyLaw law;
  law.material = material;
  Certificate& c = law.certificate;
  c.origin = "atlas";
  if (!material.yields()) {
    const ElasticSphere sphere = atlas.elastic(material.poisson_ratio);
    const double depth = std::min(options.depth, ElasticSphere::depth);
    law.curve = tabulate_elastic(sphere.fit.correction, depth);
    c.damage_number_max = std::numeric_limits<double>::infinity();
    c.atlas_error_force = sphere.fit.error;  // e is 1
    c.solver_error_force = sphere.solver_error;
    return law;
  }
  const MaterialRatios ratios = MaterialRatios::of(material);
  if (const std::string why = atlas.why_not(ratios); !why.empty())
    fail(fmt::format("material '{}'", material.name), "is not in the atlas: " + why);
  const CharacterisedBody body =
      characterised_body_of(ratios.stiffness, ratios.poisson_ratio, ratios.hardening);
  c.damage_number_max = options.fastest * options.fastest;
  c.interpolation_error = finish_curve(law, atlas.shape(ratios), body, options, Atlas::depth);
  c.atlas_error_force = atlas.claimed_force();
  c.atlas_error_restitution = atlas.claimed_restitution();
  c.solver_error_force = c.solver_error_restitution = atlas.solver_error();
  return law;
}

}  // namespace granulaw
