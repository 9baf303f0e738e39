#pragma once

#include <functional>

#include "characterise/law_shape.hpp"
#include "law/contact_curve.hpp"

namespace granulaw {

/// A rate-free law as functions of the overlap x = delta/(lambda R*), from which a ContactCurve is tabulated;
/// forces over Hertz's at x = 1, radii over R. Losses are asked for from the onset on.
struct CurveSource
{
  double onset = 0;                                        ///< x at which yield begins
  std::function<ContactCurve::Loading(double x)> loading;  ///< force, stiffness and contact radius
  std::function<double(double x)> residual;                ///< -ln(1 - delta_r/delta_m) of a reversal at x
  std::function<double(double x)> dissipation;             ///< -ln(W_u/W_L) of a reversal at x
  std::function<double(double x)> hertz_share;             ///< A of the unloading, as far as it can be had
};

/// The source's law up to `x_end` or little more. Admissible at its nodes by construction: dissipation and
/// residual are made to rise, values and slopes (Fritsch and Carlson, SIAM J. Numer. Anal. 17, 1980), and the
/// unloading's exponent and its slope follow from them and the table's own work of loading. Between nodes it
/// is examined: throws Error where the loading force would fall or a closed cycle would gain energy.
ContactCurve tabulate(const CurveSource& source, double x_end);

/// The law with this shape, whose functions end at `shape_end`, at least `x_end`.
CurveSource curve_source(const LawShape& shape, double onset, double shape_end);
ContactCurve tabulate(const LawShape& shape, double onset, double shape_end, double x_end);

/// The law of a body that never yields.
ContactCurve::Table tabulate_elastic(const ElasticCorrection& elastic, double x_end);

/// Largest relative difference between e of `curve` and of the shape it was tabulated from: what making it
/// admissible took.
double change_of_restitution(const LawShape& shape, double onset, double shape_end,
                             const ContactCurve& curve);

/// Largest relative error of the loading force of `curve` against the shape it was tabulated from.
double table_error(const LawShape& shape, double onset, double shape_end, const ContactCurve& curve);

/// Throws Error where a loading force, with or without inertia, does not rise or a closed cycle gains energy.
void require_admissible(const ContactCurve& curve);

}  // namespace granulaw
