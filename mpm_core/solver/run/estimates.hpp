#pragma once

#include <algorithm>
#include <cmath>

namespace granulaw {

// Rules by which grids and durations are chosen before a run; solver units.

/// Overlap at which Hertz's elastic contact of a sphere of `radius` stops a mass. Of two bodies: the reduced
/// mass and radius, and 1/E* the sum of theirs.
inline double hertz_overlap(double mass, double e_star, double radius, double velocity)
{
  return std::pow(15.0 / 16.0 * mass * velocity * velocity / (e_star * std::sqrt(radius)), 0.4);
}

/// The same of a mean pressure of 2.8 Y on the geometric area 2 pi radius delta.
inline double plastic_overlap(double mass, double radius, double yield, double velocity)
{
  return velocity * std::sqrt(mass / (5.6 * M_PI * radius * yield));
}

/// Overlap to which attraction draws elastic spheres in at no load, at most: a^2/R with a = (9 pi w R^2/(2 E*))^(1/3).
inline double drawn_in_overlap(double work, double e_star, double radius)
{
  return std::pow(4.5 * M_PI * work * radius * radius / e_star, 2.0 / 3.0) / radius;
}

/// Largest overlap that a run is set up for, R.
inline constexpr double deepest_overlap = 0.9;

/// Height of both surfaces apart at the edge of the contact: half the overlap while elastic, growing towards
/// all of it (the geometric intersection) when fully plastic. `onset`: overlap at first yield, infinity:
/// elastic.
inline double gap_at_edge(double overlap, double onset)
{
  const double share = std::clamp(std::log10(std::max(1.0, overlap / onset)) / 2.0, 0.0, 1.0);
  return 0.5 * overlap * (1 + share);
}

/// Half width of the fine cells over the radius of the contact.
inline constexpr double block_over_contact = 1.3;
/// Most of it, in R: beyond 0.85 grids of 8 and 10 cells fold, and a contact covers no more than 0.7 R of the
/// reference surface: at V/V_y = 3000 it is 1.2 R wide, stretched from 0.63 R.
inline constexpr double widest_block = 0.85;

}  // namespace granulaw
