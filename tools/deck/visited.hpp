#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

namespace granulaw::deck {

/// Ranges that a run visited (JSON of fix granulaw/stats).
struct Visited
{
  struct Range
  {
    double speed = 0, overlap = 0, damage_number = 0;  ///< m/s; over R*; rho V^2/Y
    bool met = false;
  };
  std::string path;
  std::optional<Range> pair, wall;
  std::map<std::pair<int, int>, Range> pairs, walls;  ///< by types, the particle's first; pairs: a <= b

  /// Range of a particle of type `a` with one of type `b`, or with a wall of type `b`; empty: not in the
  /// file.
  std::optional<Range> range(int a, int b, bool is_wall) const;
};

/// Reads as much as the file holds. Throws Error.
Visited read_visited(const std::string& path);

/// By this much may a run like the visited one exceed it: seeds and ranks shuffle the single fastest impact.
inline constexpr double visited_margin = 1.25;

}  // namespace granulaw::deck
