#include "atlas/law_from_atlas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "atlas/body_numbers.hpp"
#include "atlas/finish_curve.hpp"
#include "atlas/tabulate_curve.hpp"

namespace granulaw {

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
    law.curve = tabulate({sphere.fit.correction, depth});
    c.damage_number_max = std::numeric_limits<double>::infinity();
    c.atlas_error_force = sphere.fit.error;  // e is 1
    c.solver_error_force = sphere.solver_error;
    law.state();
    return law;
  }
  const MaterialRatios ratios = MaterialRatios::of(material);
  if (const std::string why = atlas.why_not(ratios); !why.empty())
    fail(fmt::format("material '{}'", material.name), "is not in the atlas: " + why);
  const BodyNumbers body = body_numbers(ratios);
  c.interpolation_error = finish_curve(law, atlas.shape(ratios), body, range);
  const NearBounds errors = atlas.bounds_near(ratios.stiffness);
  c.atlas_error_force = errors.force;
  c.atlas_error_restitution = errors.restitution;
  c.solver_error_force = c.solver_error_restitution = errors.solver;
  law.state();
  leave_out_axis(law, collision_on_wall(body), range.tolerance);
  return law;
}

}  // namespace granulaw
