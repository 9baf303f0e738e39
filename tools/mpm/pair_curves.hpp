#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "pair_choice.hpp"

namespace granulaw {

/// Curves that plot_pair.py draws of a pair, SI:
///
///     {"title": "a (R = 1 mm) against b (R = 2 mm)",
///      "force":       [{"name", "role", "overlap_m", "force_N",
///                       "unloading": [{"overlap_m", "force_N"}, ...]}, ...],
///      "restitution": [{"name", "role", "velocity_m_per_s", "e"}, ...]}
///
/// role: "law", "still" (the law without its waves), "rule" (the pair rule, where the pair has a law of its
/// own), "other" (the pair's laws for other ratios of radii, at this R* and m*), "formula" (Hertz, Thornton).
/// Forces are those of slow pressing.
///
/// `largest_speed`: m/s; without: a hundred yield velocities. The law's own end, of overlaps or speeds, where
/// that comes first, and for a pair that does not yield.
nlohmann::ordered_json pair_curves(const Law& law, const ChosenPair& pair,
                                   std::optional<double> largest_speed);

}  // namespace granulaw
