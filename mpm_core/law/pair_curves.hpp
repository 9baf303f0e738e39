#pragma once

#include <optional>
#include <string>
#include <vector>

#include "law/chosen_pair.hpp"

namespace granulaw {

/// A line of a picture.
struct DrawnLine
{
  std::string name;  ///< for a legend
  /// "law", "still" (the law without its waves), "rule" (the pair rule, where the pair has a law of its own),
  /// "other" (the pair's laws for other ratios of radii, at this R* and m*), "formula" (Hertz, Thornton),
  /// "body" (a material on the rigid wall).
  std::string role;
  std::vector<double> x, y;  ///< of equal length; units: those of pair_curves or body_curves
};

/// Force against overlap, of slow pressing, and its unloading branches.
struct ForceLine : DrawnLine
{
  std::vector<DrawnLine> unloading;  ///< from some overlaps, until the force ends
};

/// Force against overlap, and e against approach speed.
struct LawCurves
{
  std::string title;
  std::vector<ForceLine> force;        ///< against overlap
  std::vector<DrawnLine> restitution;  ///< e against approach speed, logarithmic in x
};

/// Curves of a pair: m, N and m/s. `largest_speed`: m/s; without: a hundred yield velocities. The law's own
/// end, of overlaps or speeds, where that comes first, and for a pair that does not yield.
LawCurves pair_curves(const Law& law, const ChosenPair& pair, std::optional<double> largest_speed);

/// Curves of every material of the law on the rigid wall: overlap/R, F/(Y R^2), V/V_y; of an elastic one
/// F/(E* R^2), and no e.
LawCurves body_curves(const Law& law);

}  // namespace granulaw
