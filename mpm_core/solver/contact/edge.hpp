#pragma once

namespace granulaw {

/// Edge of a contact from the last closed surface point and the next two: where the gap, extrapolated from
/// the two open points as (r - a)^1.5, vanishes.
struct EdgePoint
{
  double r, gap;
};
double edge_between(double closed_r, EdgePoint first, EdgePoint second);

}  // namespace granulaw
