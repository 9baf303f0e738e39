#pragma once

#include "solver/contact/scene.hpp"
#include "solver/output/trace.hpp"

namespace granulaw {

/// Moves the bodies: sets velocities after the contact impulse of a step (before it, the reported overlap
/// would drift by the integral of F dt^2/m) and decides when the run is over. Solver units.
class Programme
{
 public:
  virtual ~Programme() = default;
  /// To be called before the contact of that step: velocities of planes that the programme moves.
  virtual void lead(Scene& /*scene*/, double /*time*/, double /*dt*/) {}
  /// Velocities for the step from `time` to `time + dt`; `touching`: the contact pushed in this step.
  virtual void apply(Scene& scene, double time, double dt, bool touching) = 0;
  /// A sample of the trace, whose mean force and contact radius the programme may follow.
  virtual void observe(const TraceSample& /*sample*/) {}
  virtual bool finished() const = 0;
  virtual Branch branch() const = 0;
  virtual int segment() const = 0;
  /// 0..1
  virtual double progress() const = 0;
  /// Overlap: displacement towards the plane of the loading programme's own position of the body.
  virtual double overlap(const Scene& scene) const { return scene.overlap(); }
  /// Work done on the bodies by the loading programme so far (impact: none).
  virtual double work() const { return 0; }
  virtual void visit_state(StateArchive& archive) = 0;
};

/// Time without contact after which a body counts as having left: a few crossings of the contact zone would
/// do; a surface vibration can close the contact again within about one crossing of the sphere (2 R/c).
inline constexpr double leaving_time = 2.0;

}  // namespace granulaw
