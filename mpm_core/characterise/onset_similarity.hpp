#pragma once

#include <string>
#include <vector>

#include "characterise/atlas.hpp"
#include "characterise/sampling_plan.hpp"

namespace granulaw {

/// What tells a law near the onset of yield, where runs would need cells a thousandth of R: a less stiff
/// sphere's law holds at the same delta/delta_onset, but for a term in Y/E*, which two of them tell
/// (atlas_build.hpp). Of a body of another shape the contact sees the curvature at the pole only, of one of
/// several materials its skin. The atlas tells the term without runs, and all of it if hardening is linear as
/// far as these overlaps strain the material.
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
  /// Whether the shallowest run planned would tell nothing more: not of a body of several materials, nor of
  /// one so stiff that a less stiff sphere at the same delta/delta_onset is pressed to over 0.2 R. Of a
  /// sphere of E*/Y = 500 whose yield stress goes as ep^0.3 the law without it is off by 0.0015 in e, 0.57 %
  /// in F at most from 9e-5 to 1.5e-3 R, with it by 0.0016, 0.57 %; under a skin e would be 0.0045 off.
  bool spares_first() const { return spares_first_; }
  /// Overlap up to which it is asked: the body's first run, or less.
  double end() const { return spares_first_ ? needs_.first : 1.0; }
  /// The guide, as functions of u over the body's range; `elastic`: the body's own. Needs the runs' findings.
  LawShape shape(const ElasticCorrection& elastic) const;
  /// A clause for people.
  const std::string& how() const { return how_; }

 private:
  LawShape of_atlas(double stiffness) const;
  LawShape of_runs(const Sphere& sphere, const ElasticCorrection& elastic) const;
  double range() const;

  const CharacterisedBody body_;
  const Needs needs_;
  const Atlas* atlas_;
  bool is_sphere_, spares_first_;
  MaterialRatios ratios_;        ///< of the pole's material, hardening as if linear
  std::vector<Sphere> spheres_;  ///< the less stiff ones to be run, and ...
  bool runs_elastic_ = false;    ///< ... last, whether the elastic press of one
  bool knows_term_ = false;      ///< the atlas tells the term in Y/E*
  std::string how_;
};

/// The press that tells the finite body's elastic correction; of a body without yield.
SamplingPlan::Press elastic_press_of(const CharacterisedBody& body, int cells);

}  // namespace granulaw
