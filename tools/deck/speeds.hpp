#pragma once

#include <map>
#include <optional>
#include <vector>

#include "deck/atom_types.hpp"
#include "deck/questions.hpp"
#include "deck/scene.hpp"

namespace granulaw::deck {

struct PlanOptions;

/// Speeds at which a deck's particles come down, before they meet anything. Each starts at its source, or where a
/// wall that rises lifts it, and falls to the lowest point of the walls, losing nothing. Walls that drag it give it
/// their own speed at most. What collisions hand on is strikes.hpp's.
class SpeedBound
{
 public:
  /// Keeps references to the scene.
  SpeedBound(const Scene& scene, const std::map<int, AtomType>& types, const PlanOptions& options);

  /// Asks for heights and speeds that the deck does not give.
  void ask_for_missing(std::vector<Question>& questions) const;

  /// m/s, of a particle of this type and radius (m) that touches a wall at `height` (m along upward()).
  double free_speed(int type, double radius, double height) const;
  /// m/s, where it starts.
  double start_speed(int type) const;
  /// m/s, the largest of all walls across their surface.
  double push() const { return push_; }
  /// m/s, across gravity, of the walls of a box in motion around the particles: they hit one in turn.
  double shake() const { return shake_; }

  /// Those that particles can reach.
  const std::vector<const Wall*>& walls() const { return walls_; }
  /// Against gravity; 0 without gravity.
  const Vec3& upward() const { return upward_; }
  /// m along upward(), the lowest point of these walls; 0 without gravity.
  double floor() const { return g_ > 0 ? floor_ : 0.0; }
  /// m, the largest height that a particle may fall.
  double fall() const;

 private:
  /// Greatest height of a type's centres, and their speed there.
  struct Flight
  {
    double top = 0, speed = 0;
    double radius_min = 0;
    bool known = true;
  };

  const Scene& scene_;
  double g_ = 0;                            // m/s^2
  Vec3 upward_{0, 0, 0};                    // 0 without gravity
  std::optional<double> drop_height_;       // m, given
  std::map<int, Flight> flights_;           // by type
  double push_ = 0, drag_ = 0, shake_ = 0;  // m/s, largest of all walls
  std::vector<const Wall*> walls_;
  double floor_ = Box::infinity;  // m along upward_, the lowest point of these walls

  void follow_sources(const std::map<int, AtomType>& types);
  void lift(Flight& flight) const;
  bool encloses(const Wall& wall) const;
  void find_walls(double largest_radius);
  double highest() const;
  double falling_speed(const Flight& flight, double radius, double height) const;
};

}  // namespace granulaw::deck
