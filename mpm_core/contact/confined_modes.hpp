#pragma once

#include <algorithm>
#include <cmath>

namespace granulaw {

inline constexpr double confined_volume = 4.0 / 3.0 * M_PI;  ///< V, of the particle as made, over R^3

/// Flow of the whole particle under all of its contacts: Q^2 = sum_ij x_i x_j coupling(n_i.n_j, f_i f_j), x = F d/V.
/// The part of second order is von Mises of the mean stress over Y; the higher ones are harmonic flows. docs/theory/confined.md.
struct ConfinedModes
{
  /// Part of a flow that a flat face leaves, for its height d, the ball's radius and the face's area: f.
  static double filter(double height, double radius, double area)
  {
    return std::min(height / radius, 1.0) * std::exp(-0.3 * area / (M_PI * height * height));
  }
  /// Part of those flows that the free surface leaves: what flows between faces has to come out there.
  static double open(double free_share) { return std::sqrt(std::min(free_share / 0.2, 1.0)); }
  /// `cosine`: of the two normals; `filters`: f_i f_j, times the open part.
  static double coupling(double cosine, double filters)
  {
    const double c = std::min(cosine, 1.0), t = reach * filters;
    if (t < 1e-3) return weight * (0.5 * (3 * c * c - 1) + 0.5 * t * (5 * c * c * c - 3 * c));
    return weight * (1.0 / std::sqrt(1.0 - 2 * t * c + t * t) - 1.0 - t * c) / (t * t);
  }

 private:
  static constexpr double weight = 1.5, reach = 0.75;  // b, tau: fitted to presses of one sphere by planes
};

}  // namespace granulaw
