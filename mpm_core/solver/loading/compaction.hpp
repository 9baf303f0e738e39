#pragma once

#include "solver/contact/packing_contact.hpp"
#include "solver/loading/programme.hpp"

namespace granulaw {

/// Presses a packing: the sides of a periodic box come together along all axes, or the upper wall comes down
/// along z. Then, if asked, they go back. Lengths L change as dL/dt = -rate L, in units of R and c*. Bodies
/// get the increments of the affine velocity: inertia does not grow with the number of layers.
class Compaction : public Programme
{
 public:
  struct Plan
  {
    double solid = 0;    ///< volume of the bodies
    double density = 0;  ///< the end: of the solid in the box
    double rate = 0;
    bool unloads = false;
  };
  Compaction(PackingContact& contact, const Plan& plan);
  void lead(Scene& scene, double time, double dt) override;
  void apply(Scene& scene, double time, double dt, bool touching) override;
  bool finished() const override { return phase_ == Phase::ended; }
  /// Ends the unloading.
  void stop() { phase_ = Phase::ended; }
  Branch branch() const override { return turned_ > 0 ? Branch::unload : Branch::load; }
  int segment() const override { return turned_ > 0 ? 1 : 0; }
  double progress() const override;
  /// Turning is over: the box goes back at its full speed.
  bool goes_back(double time) const { return phase_ == Phase::back && time > turned_ + turn_time(); }
  double density() const { return plan_.solid / contact_.box.volume(); }
  double work() const override { return work_; }
  /// Momentum given to the bodies so far.
  const Vector3& given() const { return given_; }
  void visit_state(StateArchive& archive) override;

 private:
  enum class Phase : int { load, back, ended };
  double speed(double time) const;  ///< over the rate
  double turn_time() const;

  PackingContact& contact_;
  Plan plan_;
  Vector3 moves_;  ///< 1 along the axes that move
  double start_density_, turn_density_;
  Phase phase_ = Phase::load;
  double turned_ = 0, work_ = 0;
  Vector3 strain_rate_ = Vector3::Zero(), given_ = Vector3::Zero();
};

}  // namespace granulaw
