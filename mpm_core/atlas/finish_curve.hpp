#pragma once

#include "atlas/law_range.hpp"
#include "atlas/body_numbers.hpp"
#include "atlas/law_shape.hpp"
#include "law/law.hpp"

namespace granulaw {

/// The curve and axis of `law` from its shape. Range:
/// depth, fastest, tolerance. The axis ends where an impact reaches the curve's end. An axis that changes F
/// and e by no more than the tolerance is left out; the certificate says what that costs. Returns the largest
/// relative error of the force that the table's cubics add to the shape.
double finish_curve(BodyLaw& law, const LawShape& shape, const BodyNumbers& body, const LawRange& range);

}  // namespace granulaw
