#pragma once

#include "contact/curve.hpp"
#include "contact/pair.hpp"

namespace granulaw {

/// A pair of bodies under one law.
struct PairContact
{
  const Curve* curve = nullptr;  ///< of the yielding body, or the pair's own
  PairMapping mapping;
  double radiation = 0;  ///< C of the dashpot that stands for waves, s^3/kg; 0: the curve has what waves take
};

/// The law: force, stiffness and contact radius of a pair at overlap `delta` (m, > 0) whose largest overlap
/// so far is `delta_max` (m) and which latched X. No allocation, no exception.
inline Answer answer(const Curve& curve, const PairMapping& mapping, double r_eff, double delta,
                     double delta_max, double latched = 0)
{
  const double per_length = 1.0 / mapping.length(r_eff), force = mapping.force(r_eff),
               radius = mapping.radius(r_eff);
  const double x = delta * per_length, x_max = delta_max * per_length;
  if (!curve.unloads(x, x_max)) {
    const Curve::Loading now = curve.loading(x, latched);
    return {force * now.force, force * per_length * now.stiffness, radius * now.radius,
            std::max(delta, delta_max), Answer::Branch::loading};
  }
  const Reversal reversal = curve.reversal(x_max, latched);
  const double u = reversal.part(x);
  if (u <= 0.0) return {0.0, 0.0, 0.0, delta_max, Answer::Branch::apart};
  // a = a_m phi'(u)/phi'(1): dF/dx = 2 E* a keeps its ratio
  const double root = std::sqrt(u), slope = reversal.slope_at(u, root);
  return {force * reversal.force_at(u, root), force * per_length * slope * reversal.per_span,
          radius * curve.radius(x_max) * slope / reversal.slope_at(1.0, 1.0), delta_max,
          Answer::Branch::unloading};
}

/// State of a contact between two steps; zero again when the overlap ends.
struct ContactState
{
  double deepest = 0;  ///< m, largest overlap since first touch
  double latched = 0;  ///< X
};

/// The same of a contact that keeps its state.
inline Answer answer(const PairContact& pair, double r_eff, double delta, ContactState& state)
{
  if (!(delta > 0)) {
    state = {};
    return {0.0, 0.0, 0.0, 0.0, Answer::Branch::apart};
  }
  const Answer now = answer(*pair.curve, pair.mapping, r_eff, delta, state.deepest, state.latched);
  state.deepest = now.delta_max;
  return now;
}

}  // namespace granulaw
