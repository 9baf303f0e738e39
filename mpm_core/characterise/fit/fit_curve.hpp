#pragma once

#include <span>

#include "law/law_shape.hpp"
#include "characterise/run/sampling_plan.hpp"

namespace granulaw {

/// Weighted least squares through one elastic press, up to which the body yields: c3 = 0.
ElasticCorrection fit_elastic(const ContactRecord& press);
/// The same of a body of several materials: its force is that of the press itself, and further below that of
/// its slow runs up to the onset of yield.
ElasticCorrection measured_elastic(const ContactRecord& press, std::span<const ContactRecord> slow,
                                   double onset);

/// The same of a body that never yields, through presses of several depths, and how well it fits: the largest
/// relative deviation of the force, averaged over parts of a press as long as the grid noise of the contact
/// edge.
ElasticFit fit_elastic(std::span<const ContactRecord> presses);

/// Deviations of a shape from the runs it was fitted to; relative numbers.
struct FitQuality
{
  double scatter = 0;         ///< rms of loading samples of the presses, over the upper half of each
  double reversal_error = 0;  ///< largest residual of e at the reversal depths of the fit
};

struct FittedShape
{
  LawShape shape;
  FitQuality quality;
};

/// The law of a yielding sphere from its records, by smooth splines that start with zero value and slope at
/// the onset of yield. `onset`, `x_end`: overlap/R where yield begins and where the shape ends. `known`: the law
/// below the first run, over the same range; null where the runs begin near the onset.
FittedShape fit_shape(const ContactRecords& records, const ElasticCorrection& elastic, double onset,
                      double x_end, const LawShape* known = nullptr);

/// The shape's radii of unloading by the reversals of slow runs beyond its onset. `known`: as in fit_shape().
void fit_radii(LawShape& shape, std::span<const ContactRecord> reversals, const LawShape* known = nullptr);

/// The law of a body with a guide, over the guide's range: guide plus departure (atlas/departure.hpp), which the
/// records show. A reversal counts as well as the cells of its run resolve its contact.
FittedShape fit_about(const LawShape& guide, const ContactRecords& records);

/// An impact as if it were slow: without these effects of inertia, by their speed.
ContactRecord without_inertia(const ContactRecord& impact, std::span<const LawShape::VelocityEffect> effects);

/// Velocity effects of a body whose quasi-static presses have this shape, its own inertia apart; at the
/// impacts' speeds.
std::vector<LawShape::VelocityEffect> fit_velocity_effects(std::span<const ContactRecords::Impact> impacts,
                                                           const LawShape& slow, double onset, double x_end);

}  // namespace granulaw
