#pragma once

#include "characterise/rising_root.hpp"
#include "law/contact_curve.hpp"

namespace granulaw {

/// Overlap/R at which loading has taken this work, in the unit of the curve's work: that of an impact of so
/// much kinetic energy, if speed changed nothing.
inline double overlap_at_work(const ContactCurve& curve, double work)
{
  constexpr double beyond = 4;  // curves go on past their end
  return rising_root([&](double x) { return curve.work_loading(x) - work; }, 0.0, beyond, 48);
}

}  // namespace granulaw
