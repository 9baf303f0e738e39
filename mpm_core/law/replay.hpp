#pragma once

#include <functional>
#include <vector>

#include "base/attraction.hpp"
#include "base/impact_body.hpp"
#include "law/law.hpp"

namespace granulaw {

/// One collision as a particle code would compute it.
struct Replay
{
  double restitution = 0;     ///< e = separation speed/approach speed
  double force_max = 0;       ///< N
  double delta_max = 0;       ///< m
  double delta_residual = 0;  ///< m, overlap at which the force ends
  double contact_time = 0;    ///< s, from first touch until the force ends
  double work_load = 0;       ///< J, done on the contact up to delta_max
  double work_unload = 0;     ///< J, given back after it
  double work_waves = 0;      ///< J, of both, that waves take (radiation.hpp); only of a pair's replay
  double pull_off = 0;        ///< N, > 0: largest pull of a contact that was slowly pressed as deep; 0: without adhesion
  bool sticks = false;        ///< adhesion holds the bodies together: e is 0
  bool left_range = false;    ///< delta_max went past the table
  bool left_speeds = false;   ///< the approach was faster than the velocity axis goes
  bool held_speed = false;    ///< it was slower than a rate axis begins: answered as an impact there
  struct Sample
  {
    double time, delta, force, contact_radius;
    bool unloading;
  };
  std::vector<Sample> samples;  ///< every step
};

/// Force law of one contact as (overlap, largest overlap so far) -> Answer.
using NormalForce = std::function<Answer(double delta, double delta_max)>;

/// Integrates m* d2(delta)/dt2 = -F by velocity Verlet from delta = 0, v = velocity until the force ends.
/// `duration_guess` (s) sets the step: duration_guess/steps_per_contact. m* in kg, velocity in m/s.
Replay replay_collision(const NormalForce& law, double effective_mass, double velocity, double duration_guess,
                        int steps_per_contact = 20000);

/// The same for a pair of a Law: latches the impact overlap X of `velocity` at first touch, and lets waves
/// take their part. `body`: its mass, where over 0, moves in place of the effective mass, which keeps the choice of X;
/// its compliance is that of the bodies behind the contact (contact/body_behind.hpp), and overlaps hold theirs. `attraction`
/// between the surfaces (contact/adhesion.hpp); the replay then ends when they have parted, or where they come back.
Replay replay_collision(const PairLaw& pair, double r_eff, double effective_mass, double velocity,
                        int steps_per_contact = 20000, const ImpactBody& body = {}, const Attraction& attraction = {});

/// One body against the rigid wall: `radius` of curvature at its pole (m), its mass (kg).
Replay replay_on_wall(const BodyLaw& body, double radius, double mass, double velocity, double compliance = 0);

}  // namespace granulaw
