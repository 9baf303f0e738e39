#pragma once

#include <vector>

#include "characterise/law_shape.hpp"
#include "law/contact_curve.hpp"

namespace granulaw {

/// One impact level of a velocity axis: the corrections of a contact that latched X, values and d/dxi at
/// nodes xi = x/X = 0, share_spacing, ...
struct ImpactLevel
{
  static constexpr double share_spacing = 0.05;

  double impact_overlap = 0;  ///< X
  double overlap_below = 0;   ///< X half-way to the level below
  std::vector<double> force, force_slope;
  std::vector<double> residual, residual_slope, exponent, exponent_slope;

  /// The correction of the force and d/dxi, as the table has it.
  struct ForceCorrection
  {
    double value, slope;
  };
  ForceCorrection force_at(double xi) const;
};

/// A of an impact that changes the force by `effect`, to xi = `ratio_end`. Inertia: beyond the impact's own
/// overlap the cubic that goes over to 0 at the end.
void tabulate_inertia_force(ImpactLevel& level, const LawShape::VelocityEffect& effect, double ratio_end);
/// The same of a rate, whose force falls before the impact reverses where a law's rises: to its peak, which
/// it keeps until the press's force is as large. Between this level and those at the overlaps `beside` it
/// rises, too: 1 + A falls no faster than the slowest of their presses' forces rises over xi, which holds for
/// every mean of such levels. False: it is not the press's at the end.
bool tabulate_rate_force(ImpactLevel& level, const LawShape::VelocityEffect& effect, const ContactCurve& slow,
                         const std::vector<double>& beside, double ratio_end);

/// B and N from the force and the losses: what the press loses to the same overlap, and what the impact adds,
/// in the share that the press has there of its loss at X; all of it beyond.
void tabulate_losses(ImpactLevel& level, const LawShape::VelocityEffect& effect, const ContactCurve& slow);

}  // namespace granulaw
