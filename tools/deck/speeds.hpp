#pragma once

#include <map>
#include <optional>
#include <vector>

#include "deck/atom_types.hpp"
#include "deck/questions.hpp"
#include "deck/scene.hpp"

namespace granulaw::deck {

struct PlanOptions;

/// Bound on the speed at which two bodies of a deck can meet. Each particle starts at its source and falls to
/// the lowest point
/// of the walls, losing nothing; a wall that moves at U gives it up to 2U more (an elastic rebound), one that
/// drags its surface U; two particles meet at most with the sum of their speeds. The floor under a cloud of
/// equal spheres at rest is shielded by the lowest of them: `landing_speed` (deck/shielding.hpp).
class SpeedBound
{
 public:
  /// Keeps references to the scene.
  SpeedBound(const Scene& scene, const std::map<int, AtomType>& types, const PlanOptions& options);

  /// Asks for heights and speeds that the deck does not give.
  void ask_for_missing(std::vector<Question>& questions) const;

  /// m/s, relative, of two particles of these types.
  double between(int a, int b) const;
  struct Approach
  {
    double speed = 0;  ///< m/s
    bool shielded = false;
  };
  /// Approach of a particle of this type to a wall.
  Approach to(const Wall& wall, int type) const;

  /// Those that particles can reach.
  const std::vector<const Wall*>& walls() const { return walls_; }
  /// m, the largest height that a particle may fall.
  double fall() const;

 private:
  /// Greatest height of a type's centres without a wall's help, and their speed there.
  struct Flight
  {
    double top = 0, speed = 0;
    bool known = true;
  };

  const Scene& scene_;
  double g_ = 0;                       // m/s^2
  Vec3 upward_{0, 0, 0};               // 0 without gravity
  std::optional<double> drop_height_;  // m, given
  std::map<int, Flight> flights_;      // by type
  double push_ = 0, drag_ = 0;         // m/s, largest of all walls: by moving, by dragging
  std::vector<const Wall*> walls_;
  double floor_ = Box::infinity;   // m along upward_, the lowest point of these walls
  std::optional<double> landing_;  // m/s, on the floor that a cloud shields

  void follow_sources(const std::map<int, AtomType>& types);
  void find_walls(double largest_radius);
  double highest_lift() const;
  double highest() const;
  double speed_at(int type, double height) const;
  double falling_speed(const Flight& flight, double height) const;
};

}  // namespace granulaw::deck
