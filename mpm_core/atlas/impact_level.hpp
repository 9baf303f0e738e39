#pragma once

#include <vector>

#include "law/law_shape.hpp"
#include "contact/curve.hpp"

namespace granulaw {

/// Distance of the nodes of x/X in a velocity axis.
inline constexpr double share_spacing = 0.05;

/// A of an impact that changes the force by `effect`, at nodes from 0 to share_end. Inertia: beyond the
/// impact's own overlap the cubic that goes over to 0 at the end.
HermiteColumn inertia_force(const LawShape::VelocityEffect& effect, double share_end);
/// The same of a rate, whose force falls before the impact to `latched` reverses where a law's rises: to its
/// peak, which it keeps until the force of `slow` is as large. Between this level and those at the overlaps
/// `beside` it rises, too: 1 + A falls no faster than the slowest of their presses' forces rises over x/X,
/// which holds for every mean of such levels. Empty: it is not the press's at the end.
HermiteColumn rate_force(const LawShape::VelocityEffect& effect, double latched, const Curve& slow,
                  const std::vector<double>& beside, double share_end);

}  // namespace granulaw
