#pragma once

#include <functional>
#include <limits>

#include "atlas/law_range.hpp"
#include "atlas/body_numbers.hpp"
#include "law/law_shape.hpp"
#include "law/law.hpp"
#include "law/replay.hpp"

namespace granulaw {

/// The curve and axis of `law` from its shape. range: depth, fastest. The axis ends where an impact reaches the curve's
/// end; the certificate says what it changes there. Returns the largest relative error of the force that the table's
/// cubics add to the shape.
double finish_curve(BodyLaw& law, const LawShape& shape, const BodyNumbers& body, const LawRange& range);

/// Head-on collision by a law at the speed v of its velocity axis.
using AxisCollision = std::function<Replay(const BodyLaw& law, double v)>;
/// Steps of such a replay a contact: F_max and e within 1e-5 of those of ten times as many.
inline constexpr int cheap_replay = 2000;
/// The body against the rigid wall.
AxisCollision collision_on_wall(const BodyNumbers& body);

/// Leaves an axis of inertia out if it changes F_max and e by no more than the tolerance at any speed, and widens the bound
/// by the change at each speed, up to v = `fastest` (law/error_bound.hpp). A rate's axis stays: it says for which size of the body the law holds.
void leave_out_axis(BodyLaw& law, const AxisCollision& collide, double tolerance,
                    double fastest = std::numeric_limits<double>::infinity());

}  // namespace granulaw
