#pragma once

namespace granulaw {

/// Ends of laws, at most: overlap over the radius of one body, and damage number I = rho V^2/Y of the velocity axis.
inline constexpr double deepest_law = 0.5, fastest_law = 0.09;
/// `mpm table` states a pair's error up to this ratio of radii.
inline constexpr double largest_radius_ratio = 10;

}  // namespace granulaw
