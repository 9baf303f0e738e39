// Energy that an impact takes from the rigid motion, and that it returns.
#include "characterise/shape/energetic_restitution.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

namespace granulaw::energetic_restitution_test {

constexpr double velocity = 2, mass = 3;

/// A run whose force is `force(t)` along the wall's normal, at `arm` from the centre of mass.
template <class Force>
RunResult run_of(Force force, const Vector3& arm)
{
  RunResult run;
  run.planes.resize(1);
  constexpr int samples = 4000;
  for (int k = 0; k < samples; ++k) {
    const double t = (k + 0.5) / samples;
    const Vector3 f(0, 0, force(t)), torque = arm.cross(f);
    run.trace.push_back({t, 0, f[2], 0, Branch::load, 0});
    run.planes[0].samples.push_back(
        {0, f[2], {f[0], f[1], f[2]}, {torque[0], torque[1], torque[2]}, {arm[0], arm[1], arm[2]}, {}});
  }
  return run;
}

const RigidBody body{mass, Vector3(0.5, 0.7, 0.9).asDiagonal()};

/// Ratio of the normal velocities of a contact that stays at its place: J = m_e V (1 + e).
TEST(EnergeticRestitution, OfAFixedContactIsTheRatioOfVelocities)
{
  for (const Vector3& arm : {Vector3(0, 0, -1), Vector3(0.4, 0.3, -1)})
    for (const double e : {0.0, 0.3, 1.0}) {
      const Vector3 lever = arm.cross(Vector3::UnitZ());
      const double effective = 1 / (1 / mass + lever.dot(body.inertia.inverse() * lever));
      const double impulse = effective * velocity * (1 + e);
      const RunResult run = run_of([&](double t) { return impulse * 6 * t * (1 - t); }, arm);
      // a step changes the velocity by 4e-4 of V at most; the least energy is quadratic in it
      EXPECT_NEAR(energetic_restitution(run, body, velocity), e, 1e-3) << arm.transpose();
    }
}

/// A contact that moves to the centre's normal meets more mass on its way: J/(m_e V) - 1 is above 1, but no
/// more energy comes back than went in.
TEST(EnergeticRestitution, StaysBelowOneWhereTheContactMoves)
{
  RunResult run =
      run_of([&](double t) { return 1.6 * mass * velocity * 6 * t * (1 - t); }, Vector3(0.6, 0, -1));
  for (std::size_t k = 0; k < run.trace.size(); ++k) {
    PlaneSample& s = run.planes[0].samples[k];
    const double moves = std::max(0.0, 1 - 5 * run.trace[k].time);
    s.torque[1] *= moves, s.centre[0] *= moves;
  }
  const double e = energetic_restitution(run, body, velocity);
  EXPECT_GT(e, 0.3);
  EXPECT_LT(e, 1);
}

/// Friction takes energy, too: e of the contact is that of the normal force alone.
TEST(EnergeticRestitution, IsThatOfTheNormalForce)
{
  constexpr double e = 0.6, friction = 0.3;
  RunResult run =
      run_of([&](double t) { return mass * velocity * (1 + e) * 6 * t * (1 - t); }, Vector3(0, 0, -1));
  for (PlaneSample& s : run.planes[0].samples) {
    s.vector[0] = -friction * s.force;
    s.torque[1] = friction * s.force;  // arm (0, 0, -1)
  }
  const RigidMotion before{Vector3(5, 0, -velocity), Vector3(0, 2, 0)};
  const ContactWork work = contact_work(run, body, before);
  EXPECT_NEAR(work.restitution(), e, 1e-3);
  EXPECT_NEAR(work.taken / (0.5 * mass * velocity * velocity), 1, 1e-3);
  EXPECT_EQ(work.contacts, 1);
}

/// A body that turns over its first contact and hits again: e is that of the first.
TEST(EnergeticRestitution, IsThatOfTheFirstContact)
{
  constexpr double e = 0.5;
  const auto pulse = [](double t, double begin, double end) {
    const double x = (t - begin) / (end - begin);
    return x > 0 && x < 1 ? 6 * x * (1 - x) / (end - begin) : 0;
  };
  const RunResult run = run_of(
      [&](double t) { return mass * velocity * ((1 + e) * pulse(t, 0, 0.4) + 0.2 * pulse(t, 0.7, 0.9)); },
      Vector3(0, 0, -1));
  const ContactWork work = contact_work(run, body, {Vector3(0, 0, -velocity), Vector3::Zero()});
  EXPECT_NEAR(work.restitution(), e, 2e-3);
  EXPECT_EQ(work.contacts, 2);
}

}  // namespace granulaw::energetic_restitution_test
