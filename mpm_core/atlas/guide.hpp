#pragma once

#include <limits>
#include <string>

#include "atlas/atlas.hpp"
#include "atlas/stand_in.hpp"

namespace granulaw {

/// Material at the contact pole, without dimensions.
struct PoleMaterial
{
  MaterialRatios ratios;  ///< H/E of linear hardening; not read where `flow` is given
  FlowCurve flow{};       ///< of hardening that is not linear; null: linear
};

/// The law of a body without a run: its master curve is this one plus a departure (departure.hpp).
struct Guide
{
  LawShape master;
  std::string from;  ///< a clause for people
  /// Errors of F and e that 95 % of contacts lie within; infinite: none is stated.
  double error_force = std::numeric_limits<double>::infinity(),
         error_restitution = std::numeric_limits<double>::infinity();
};

/// Reason why there is no guide, as the end of a sentence; empty: there is one.
std::string why_no_guide(const Atlas& atlas, const PoleMaterial& pole);

/// The guide between `onset` and `end`, overlaps over the radius at the pole. Of a homogeneous sphere (no
/// `elastic`): the atlas's law, or what stands in for it; stiffer than the atlas's: at the same overlap/onset,
/// linear in Y/E*. Of another body, by its own elastic correction: that sphere behind a series compliance, or,
/// over a stiffer core, the sphere's functions of overlap/onset. Needs why_no_guide() empty.
Guide guide_of(const Atlas& atlas, const PoleMaterial& pole, double onset, double end,
               const ElasticCorrection* elastic = nullptr);

}  // namespace granulaw
