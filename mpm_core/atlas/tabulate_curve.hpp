#pragma once

#include "contact/curve.hpp"
#include "law/contact_law.hpp"

namespace granulaw {

/// The law as a particle code asks it. Force and radius are made to rise, kept and span never to rise: no
/// closed cycle gains energy.
Curve tabulate(const ContactLaw& law);
inline Curve tabulate(const LawShape& shape, double x_end)
{
  return tabulate(ContactLaw(shape, x_end));
}

/// The curve of this table and axis; throws Error where it is no law: the runs are too coarse.
Curve fitted_curve(CurveTable table, std::optional<AxisTable> axis = {});

/// Largest relative difference between e of `curve` and of the shape it was tabulated from: the
/// cost of making it rise.
double change_of_restitution(const LawShape& shape, const Curve& curve);

/// Largest relative error of the loading force of `curve` against the shape it was tabulated from.
double table_error(const LawShape& shape, const Curve& curve);

}  // namespace granulaw
