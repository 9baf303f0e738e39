#include "characterise/build/slow_law.hpp"

#include "characterise/body/characterised_body.hpp"
#include "characterise/body/law_material.hpp"
#include "characterise/build/build_law.hpp"

namespace granulaw {

Curve slow_law_by_runs(const std::string& name, const Material& material, double depth, const Atlas& atlas, Farm& farm,
                       const Progress& progress)
{
  BuildOptions options;
  options.depth = depth, options.fastest = 0;
  options.atlas = &atlas, options.farm = &farm, options.progress = progress;
  return build_law(law_material(name, material), characterised_body_of(material), options).law.curve;
}

}  // namespace granulaw
