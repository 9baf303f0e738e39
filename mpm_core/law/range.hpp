#pragma once

#include <cstddef>

namespace granulaw {

/// Ends of laws, at most: overlap over the radius of one body, and damage number I = rho V^2/Y of the velocity axis.
inline constexpr double deepest_law = 0.5, fastest_law = 0.09;
/// No table that a plan asks for ends before this overlap over the radius: a deeper one of the atlas costs nothing,
/// and a simulation that goes deeper than was planned does not stop.
inline constexpr double shallowest_table = 0.2;
/// `mpm table` states a pair's error up to this ratio of radii.
inline constexpr double largest_radius_ratio = 10;
/// A law file holds pairs up to this ratio of radii.
inline constexpr double most_unlike_sizes = 100;
/// Laws of one file, of bodies and of pairs at each ratio of radii, at most: every pair of 30 materials has 1400.
inline constexpr std::size_t most_laws_of_file = 2048;

}  // namespace granulaw
