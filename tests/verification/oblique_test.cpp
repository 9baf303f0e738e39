// Oblique impacts with friction: what must hold whatever the material does.
#include <gtest/gtest.h>

#include <cmath>

#include "base/larger.hpp"
#include "solver/runs.hpp"

namespace granulaw::oblique_test {

constexpr double radius = 1e-3, velocity = 1.5, tangent = 3;  // m, m/s, of 72 degrees

/// E*/Y = 50: cheap.
Particle ball()
{
  Particle particle;
  Material m;
  m.density = 1000, m.youngs_modulus = 0.91e9, m.poisson_ratio = 0.3, m.yield_stress = 20e6;
  particle.materials = {m};
  particle.radius = radius;
  return particle;
}

/// On the grid of three dimensions, whatever the scene would need.
RunOptions in_space(RunOptions options)
{
  options.grid = GridKind::spatial;
  return options;
}

RunResult thrown(double friction, double angle_tangent, double spin = 0)
{
  Approach t;
  t.velocity = velocity, t.tangential_velocity = angle_tangent * velocity;
  t.friction = friction, t.spin = spin;
  RunOptions options;
  options.resolution = 6, options.shifted_grids = 1;
  return impact(ball(), t, {}, in_space(options));
}

/// At 45 degrees, where it slides at first and then sticks.
const RunResult& at_45_degrees()
{
  static const RunResult run = thrown(0.3, 1);
  return run;
}

/// Coulomb: while all of the contact slides, the impulses have the ratio mu, so that the tangential velocity
/// falls by mu V (1 + e). The disc of friction is filled to rounding; a marker that sticks in the first or
/// last steps leaves 1e-4 here.
TEST(Oblique, TheSlidingLimit)
{
  const Rebound r = *thrown(0.1, tangent).rebound;
  const double before = tangent * velocity;
  EXPECT_NEAR(r.tangential * before, before - 0.1 * velocity * (1 + r.normal), 1e-3 * before);
  EXPECT_NEAR(r.impulse_tangential / r.impulse_normal, 0.1, 1e-3 * 0.1);
}

/// Friction acts in the wall, R - delta below the centre, delta the centre's way since first touch; the
/// normal force where its pressure has its middle.
TEST(Oblique, TheLeverIsTheCentresHeight)
{
  const RunResult& run = at_45_degrees();
  const std::vector<PlaneSample>& samples = run.planes.front().samples;
  double largest = 0, off = 0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const PlaneSample& s = samples[k];
    const double by_lever = -(radius - run.trace[k].delta) * s.vector[0] - s.centre[0] * s.vector[2];
    largest = larger(largest, std::abs(s.torque[1]));
    off = larger(off, std::abs(s.torque[1] - by_lever));
  }
  // markers go through the plane by less than a twentieth of a cell (spatial_contact): 1e-3 R here
  EXPECT_LT(off, 5e-3 * largest);
}

/// Thrown with the spin of a body that rolls, no friction acts on it to first order, and keeps both.
TEST(Oblique, ARollingBallKeepsRolling)
{
  const Rebound r = *thrown(0.3, 0.2, 0.2 * velocity / radius).rebound;
  // the lever shortens by delta/R = 2 % and the dent tilts: the spin keeps to a tenth
  EXPECT_NEAR(r.tangential, 1, 0.03);
  EXPECT_NEAR(r.spin[1] / (0.2 * velocity / radius), 1, 0.1);
}

}  // namespace granulaw::oblique_test
