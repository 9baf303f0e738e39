#pragma once

namespace granulaw {

/// Force of a free sphere over that of one whose equator plane is driven, at this overlap/R, at E*/Y = 100:
/// why there is no single pair law at large overlaps (docs/evidence/solver-accuracy.md).
double support_ratio(double overlap);

}  // namespace granulaw
