#pragma once

#include <limits>

#include "contact/curve.hpp"
#include "law/law_shape.hpp"

namespace granulaw {

/// The slow law of a contact as a function of the overlap x = delta/R, without a table. Forces over 4/3 E*
/// R^2, energies over 4/3 E* R^3, as Curve has them. Beyond its end the loading force goes on with its last
/// stiffness, all else keeps its last value. A Curve is tabulated from it (atlas/tabulate_curve.hpp) where a
/// particle code asks at every step.
class ContactLaw
{
 public:
  explicit ContactLaw(const LawShape& shape) : ContactLaw(shape, shape.end) {}
  /// The same up to another end. That of a shape that ends before it goes on as its functions do at their
  /// end.
  ContactLaw(const LawShape& shape, double end);
  /// A body that never yields.
  ContactLaw(const ElasticCorrection& elastic, double end);

  double onset() const { return onset_; }  ///< x of first yield; infinity: elastic
  double end() const { return end_; }      ///< the largest x that the law holds for

  struct Loading
  {
    double force, stiffness, radius, radius_slope;  ///< F, dF/dx, contact radius over R, its slope by x
  };
  /// First loading to x > 0.
  Loading loading(double x) const;
  double force(double x) const { return loading(x).force; }
  double radius(double x) const { return loading(x).radius; }
  /// Work of loading to x.
  double work(double x) const;

  /// What a reversal at x loses, and the shape of its unloading; slopes by x. From the onset on.
  struct Losses
  {
    double kept, kept_slope, span, span_slope, share, share_slope;  ///< as CurveTable has them
    std::array<double, 3> unloading_radius;
  };
  /// The functions themselves, which do not end: for a table whose last node lies beyond the end.
  Loading continued_loading(double x) const;
  Losses continued_losses(double x) const;
  /// Source of the shape of a reversal at x.
  Curve::Top top(double x) const;
  /// The unloading curve from a reversal at x.
  Reversal reversal(double x) const { return Curve::reversal(x, top(x)); }
  /// Work that complete unloading from x returns, over work(x).
  double kept(double x) const { return top(x).kept; }
  /// 1 - residual overlap/x.
  double span(double x) const { return top(x).span; }
  /// k of UnloadingRadius below a reversal at x.
  std::array<double, 3> unloading_radius(double x) const;

  /// Overlap at which loading has taken this work: that of an impact of so much kinetic energy, if speed
  /// changed nothing.
  double overlap_at_work(double work) const;

 private:
  double q(double x) const;
  double work_within(double x) const;
  void tabulate_work();

  double onset_ = std::numeric_limits<double>::infinity(), end_;
  ElasticCorrection elastic_;
  Spline reduction_, widening_, residual_, dissipation_, share_;  // by q
  std::array<Spline, 3> radii_;                                   // k - k_elastic, by q
  HermiteColumn log_work_;                                        // from the onset to the end, even in q
  Loading last_{};
  double last_work_ = 0;
};

/// The Hertz coefficient next to `wanted` with which the unloading from x rises and is not less stiff than
/// loading; the work is the same with any.
double admissible_hertz_share(double wanted, const Curve::Top& top, double x, double stiffness);

}  // namespace granulaw
