#pragma once

#include <vector>

#include "base/attraction.hpp"
#include "solver/contact/surface.hpp"

namespace granulaw {

/// Attraction between the first body's surface of revolution and what it meets. Each surface point is pulled by the traction at its
/// gap times the area of its ring now; the other surface by the opposite, at the place across.
class SurfacePull : public Pull
{
 public:
  /// In units of the run.
  SurfacePull(const Attraction& attraction, std::span<const Body> bodies);
  double pull(std::span<Body> bodies, double kick) override;
  void account(std::span<const Body> bodies) override;

 private:
  struct Pulled
  {
    int marker;
    Opposite::Place across;
    double impulse, before;  ///< before: velocity of separation at the start of the step
  };
  /// Rate of its gap, less what the nodes' forces added over `kick`.
  static double separation(std::span<const Body> bodies, const Pulled& point, double kick);
  /// Adds its impulse along the gap to the nodes that carry a pulled point, and to those across it.
  static void push(std::span<Body> bodies, const Pulled& point, double kick);

  Attraction attraction_;
  std::vector<Pulled> pulled_;  // of this step
};

}  // namespace granulaw
