#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "law/law_shape.hpp"
#include "characterise/run/sampling_plan.hpp"
#include "contact/axis.hpp"

namespace granulaw {

/// Force and coefficient of restitution of a contact that reverses.
struct AtReversal
{
  double force = 0;  ///< in any unit, the same for what is compared; 0: not known
  double restitution = 0;
};

/// A run, slow or fast, beside what the law fitted without it predicts.
struct LeftOutRun
{
  double coordinate = 0;  ///< in which the law is smooth: ln(overlap) of a slow run; of an impact sqrt(I) for
                          ///< inertia, ln(sqrt(I)) for a rate
  double overlap = 0;     ///< over the length, where the run reverses
  AtReversal measured;
  std::optional<AtReversal> predicted;  ///< none: the law without the run would be extrapolated
};

/// Errors of F and of e, both relative, as they count for the tolerance, the larger: below e = 0.5 that of e is
/// relative to 0.5. One that is no number stays.
double counted(double force, double e, double restitution);

/// Error of a prediction as it counts for the tolerance, of F or e, whichever is larger.
double miss(const LeftOutRun& run);
double largest_miss(std::span<const LeftOutRun> runs);
/// Largest relative errors of a predicted F and of a predicted e.
AtReversal largest_errors(std::span<const LeftOutRun> runs);

/// ln of the ratio of two overlaps nearer than which no run is put between them. A straight line through ln F
/// over an interval w of ln(overlap) misses by up to w^2/8 times the curvature, which is about 1 at most: d
/// ln F/d ln(overlap) falls from 3/2 to 1 while the overlap grows e-fold. In a shorter interval than that of
/// the tolerance the runs scatter, which no further run mends.
double least_interval(double tolerance);

/// A place where the law is exact without a run, and the nearest place to it that may be run.
struct Exact
{
  double coordinate, nearest;
};
/// Places that need runs: half-way between each run that is missed by more than the tolerance and its
/// neighbours; ascending coordinates. `runs` ascend. `exact`: below the first of them.
std::vector<double> bisections(std::span<const LeftOutRun> runs, double tolerance, std::optional<Exact> exact = {});

/// Slow runs, each left out whole of the law that `fit` makes of the others, a press with all its reversal points. The
/// deepest run has no prediction, nor has any of fewer runs beyond the onset than `least`. `onset`, `x_end`: as in
/// fit_shape().
using ShapeOf = std::function<LawShape(const ContactRecords&)>;
std::vector<LeftOutRun> leave_out_slow(const ContactRecords& records, const ShapeOf& fit, double onset,
                                       double x_end, long least);

/// Fast impacts, each left out of the interpolation between the others' velocity effects. The ends of the
/// axis have no prediction; the lower end of inertia's is the standstill.
std::vector<LeftOutRun> leave_out_fast(std::span<const ContactRecords::Impact> impacts,
                                       std::span<const LawShape::VelocityEffect> effects,
                                       AxisTable::By kind);

}  // namespace granulaw
