#pragma once

#include <vector>

#include "atlas/law_shape.hpp"

namespace granulaw {

/// Prior of a body's law without its own runs, and its error. The fit takes its nodes below the first run
/// beside the runs' samples.
struct ShapePrior
{
  /// Standard error of F and e of a run of 24 cells on two grids (docs/evidence/atlas.md).
  static constexpr double run_error = 0.003;

  LawShape shape;
  double onset = 0, end = 0;  ///< overlaps over the length between which the shape's functions are defined
  /// Standard error at each node over that of a run's sample; infinity: nothing is known there.
  std::vector<double> error;

  /// A law up to the overlap `known`. Fitted to several runs it errs half as much as one: its e by 0.0012 to
  /// 0.0015 (rms), be it of the atlas or of runs (docs/develop/runs-and-laws.md).
  static constexpr double law_error = 0.5;
  static ShapePrior of(LawShape shape, double onset, double end, double known);
  /// At an overlap: the larger one of the nodes beside it.
  double error_at(double overlap) const;
  /// Nothing is known beyond this overlap.
  void end_at(double overlap);
};

/// True if a law whose shallowest run reverses at the overlap `first` needs a prior. Up to twice the onset's
/// overlap a fit that leaves the onset with zero slope follows the law.
inline bool needs_prior(double first, double onset)
{
  return first > 2 * onset;
}

/// Onset similarity: near the onset of yield a law is a function of r = delta/delta_onset, but for the finite
/// body: a term in Y/E*, which goes as sqrt(delta_onset/R), and one in its square. `onset`, `end`: of the law
/// that is sought. Its error is that of the laws used, by their weights, and what they leave of the square,
/// which is so many times delta/R of F between materials of the atlas:
inline constexpr double finite_body = 2.5;

/// - The same law over another range.
ShapePrior at_range(double onset, double end, const ShapePrior& law);
/// - Linear in Y/E* through two less stiff laws.
ShapePrior similar_by_two(double onset, double end, const ShapePrior& stiffer, const ShapePrior& softer);
/// - One less stiff law and the change from its stiffness to the sought one in another family of materials:
///   `there` is as stiff as `softer`, `here` as the sought one. `unlike`: by how many times the difference of
///   delta/R the families change differently; finite_body for those of another Poisson's ratio or hardening.
ShapePrior similar_by_change(double onset, double end, const ShapePrior& softer, const ShapePrior& there,
                             const ShapePrior& here, double unlike = finite_body);

}  // namespace granulaw
