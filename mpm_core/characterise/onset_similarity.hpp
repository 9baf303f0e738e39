#pragma once

#include <string>
#include <vector>

#include "atlas/atlas.hpp"
#include "characterise/run/onset_of_yield.hpp"
#include "characterise/run/sampling_plan.hpp"
#include "characterise/shape_prior.hpp"

namespace granulaw {

/// Prior of a body's law near the onset of yield, where runs would need cells a thousandth of R: less stiff
/// spheres' laws at the same delta/delta_onset (shape_prior.hpp). Of a body of another shape the contact
/// depends on the curvature at the pole only, of one of several materials its skin. The atlas gives what
/// stiffness changes without runs, and all of the law if hardening is linear as far as these overlaps strain
/// the material.
///
/// Made before the runs of the body itself, so that its own spheres' runs go with them in one batch.
class OnsetSimilarity
{
 public:
  struct Needs
  {
    double first = 0;      ///< overlap/length of the shallowest run planned of the body
    double depth = 0;      ///< where the body's law ends
    double tolerance = 0;  ///< of F and e: presses load in loading_ramp()
    int press_cells = 24;
  };
  /// A less stiff sphere.
  struct Sphere
  {
    CharacterisedBody body;
    SamplingPlan plan;
    double depth = 0;      ///< where its law ends
    ContactRecords found;  ///< empty: what the plan's runs find
  };

  /// `atlas`: null if there is none; outlives this. Throws Error where the body's law is not that of its
  /// skin.
  OnsetSimilarity(const CharacterisedBody& body, const Needs& needs, const Atlas* atlas);

  /// Those to be run.
  std::vector<Sphere>& spheres() { return spheres_; }
  const std::vector<Sphere>& spheres() const { return spheres_; }
  /// True if the prior's error at the shallowest run planned is below the tolerance: then that run is spared.
  /// Under a skin it is not: e would be 0.0045 off.
  bool spares_first() const;
  /// The prior, which ends at the shallowest run planned; `elastic`: the body's own correction. Needs the
  /// runs' findings.
  ShapePrior prior(const ElasticCorrection& elastic) const;
  /// A clause for people.
  const std::string& how() const { return how_; }

 private:
  ShapePrior of_atlas(double stiffness) const;
  /// `elastic`: a sphere's correction; null before the runs, when only errors are known.
  ShapePrior of_runs(const Sphere& sphere, const ElasticCorrection* elastic) const;
  ShapePrior of_sphere(const ElasticCorrection* elastic) const;

  const CharacterisedBody body_;
  const Needs needs_;
  const Atlas* atlas_;
  bool is_sphere_;
  MaterialRatios ratios_;        ///< of the pole's material, hardening as if linear
  std::vector<Sphere> spheres_;  ///< the less stiff ones to be run, and ...
  bool runs_elastic_ = false;    ///< ... last, whether the elastic press of one
  bool knows_term_ = false;      ///< the atlas gives what stiffness changes
  std::string how_;
};

}  // namespace granulaw
