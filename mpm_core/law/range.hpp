#pragma once

namespace granulaw {

/// Ends of laws, at most: overlap over the radius of one body, and damage number I = rho V^2/Y of the velocity axis.
inline constexpr double deepest_law = 0.5, fastest_law = 0.09;

}  // namespace granulaw
