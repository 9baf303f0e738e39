#pragma once

namespace granulaw {

/// What a sphere is fixed to when it hits: a holder, a pendulum, the body of a rebound tester.
struct ImpactBody
{
  double mass = 0;        ///< kg, with the sphere; 0: the sphere is free
  double compliance = 0;  ///< m/N: it stores compliance F^2/2 and gives it back
};

}  // namespace granulaw
