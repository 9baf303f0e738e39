#include "atlas/guide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace granulaw {

namespace {

/// As the atlas has it; of a stiffness within.
LawShape sphere(const Atlas& atlas, const PoleMaterial& pole, double stiffness)
{
  const double nu = pole.ratios.poisson_ratio;
  return pole.flow ? stand_in(atlas, stiffness, nu, of_twin(pole.flow, stiffness / pole.ratios.stiffness))
                   : atlas.shape({stiffness, nu, pole.ratios.hardening});
}

}  // namespace

std::string why_no_guide(const Atlas& atlas, const PoleMaterial& pole)
{
  MaterialRatios m = pole.ratios;
  m.stiffness = std::min(m.stiffness, atlas.grid().stiffnesses.back());
  if (pole.flow) m.hardening = 0;
  return atlas.why_not(m);
}

Guide guide_of(const Atlas& atlas, const PoleMaterial& pole, double onset, double end,
               const ElasticCorrection* elastic)
{
  const double stiffest = atlas.grid().stiffnesses.back(), stiffness = pole.ratios.stiffness;
  Guide guide;
  if (stiffness <= stiffest) {
    guide.master = sphere(atlas, pole, stiffness);
    guide.from = pole.flow ? "the atlas, at the hardening of each strain" : "the atlas";
  } else {
    // linear in Y/E* through two: what a finite body changes at one overlap/onset goes so
    const double softer = 0.5 * stiffest, own_onset = onset_of(pole.ratios);
    const double slope = (1 / stiffness - 1 / stiffest) / (1 / stiffest - 1 / softer);
    const LawShape first = sphere(atlas, pole, stiffest).at_range(own_onset, Atlas::depth),
                   second = sphere(atlas, pole, softer).at_range(own_onset, Atlas::depth);
    guide.master = first;
    guide.master.add(slope, first), guide.master.add(-slope, second);
    guide.from = fmt::format("the atlas, beyond its E*/Y of {:g}", stiffest);
  }
  if (!elastic) {
    if (stiffness <= stiffest && !pole.flow)
      guide.error_force = atlas.claimed_force(), guide.error_restitution = atlas.claimed_restitution();
    if (end != guide.master.end || onset != guide.master.onset) {
      const auto effects = guide.master.velocity_effects;
      guide.master = guide.master.at_range(onset, end);
      guide.master.velocity_effects = effects;
    }
    return guide;
  }
  const auto effects = guide.master.velocity_effects;
  if (elastic->force_ratio(std::pow(onset, 0.25)) < guide.master.elastic.force_ratio(std::pow(onset, 0.25))) {
    const LawShape skin = guide.master.at_range(guide.master.onset, end);
    guide.master = skin.as_skin_of(*elastic, end).at_range(onset, end);
    guide.from += ", behind a series compliance";
  } else {
    guide.master = guide.master.at_range(onset, end);
    guide.master.elastic = *elastic;
    guide.from += ", on the body's elastic curve";
  }
  guide.master.velocity_effects = effects;
  return guide;
}

}  // namespace granulaw
