#pragma once

#include "law/law_shape.hpp"
#include "contact/curve.hpp"

namespace granulaw {

/// Effect of inertia on `slow`, the shape's own rate-independent law, up to the speed sqrt(I) = `fastest` (at
/// most the shape's last) of a body of this `mass` (over rho R^3). Beyond the overlap that an impact reaches
/// the force goes over to the press's within half of it. The axis ends before `fastest` where that would go
/// deeper than `slow`'s table.
AxisTable tabulate_inertia(const LawShape& shape, const Curve& slow, double e_star_over_yield, double mass,
                           double fastest);

/// The same of a rate-dependent body whose `slow` law is that of no rate: an axis from the slowest impact of
/// the shape on, by the logarithm of the speed; at a body of this radius (m). The force, which falls before
/// such an impact reverses, rises to its last share's and stays there until `slow`'s is as large. Throws
/// Error where that is beyond 12 times the overlap reached.
AxisTable tabulate_rate(const LawShape& shape, const Curve& slow, double e_star_over_yield, double mass,
                        double fastest, double reference_radius);

}  // namespace granulaw
