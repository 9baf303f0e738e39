#include "law/contact_step.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "base/larger.hpp"
#include "base/scales.hpp"
#include "atlas/law_from_atlas.hpp"
#include "law/replay.hpp"
#include "own_atlas.hpp"

namespace granulaw::contact_step_test {

/// e of a collision as a particle code computes it: velocity Verlet, first touch at `phase` of a step.
double restitution(const auto& force, double m_eff, double speed, double dt, double phase)
{
  double delta = -phase * speed * dt, delta_max = 0, v = speed, f = 0;
  do {
    v -= 0.5 * dt * f / m_eff;
    delta += dt * v;
    f = delta > 0 ? force(delta, delta_max) : 0.0;
    delta_max = std::max(delta, delta_max);
    v -= 0.5 * dt * f / m_eff;
  } while (v > 0 || delta > 0);
  return -v / speed;
}

/// Largest error of e over the phases of the step.
double error_of_e(const auto& force, double m_eff, double speed, double dt, double e)
{
  double largest = 0;
  for (double phase = 0.05; phase < 1; phase += 0.1)
    largest = larger(largest, std::abs(restitution(force, m_eff, speed, dt, phase) - e));
  return largest;
}

/// Largest error of e over phases, materials, pairs and speeds, with the step that `share` of the largest is.
double worst_error(double share)
{
  const Atlas atlas = tests::atlas();
  const double radius = 1e-3, mass = 4.0 / 3.0 * M_PI * 1000 * radius * radius * radius;
  LawRange options;
  options.depth = 0.5, options.fastest = 0.3;
  double worst = 0;
  for (const double ratio : {30.0, 100.0, 1000.0}) {
    const LawMaterial material{"m", 1000, 1e8 * (1 - 0.09), 0.3, 1e8 / ratio, 0};
    const BodyLaw body = law_from(atlas, material, options);
    const double v_y = yield_velocity(1e8, material.yield_stress, 1000);
    for (const double sqrt_lambda : {1.0, 2.0})
      for (const double relative : {0.3, 2.0, 20.0, 200.0}) {
        const double r_eff = radius / sqrt_lambda, m_eff = mass / sqrt_lambda, speed = relative * v_y;
        const PairLaw pair{{&body.curve, {1e8, sqrt_lambda}}, &body};
        const Replay replay = replay_collision(pair, r_eff, m_eff, speed);
        if (replay.left_range || replay.left_speeds) continue;
        const double latched = pair.impact_overlap(r_eff, m_eff, speed);
        const auto force = [&](double d, double d_max) {
          return pair.evaluate(r_eff, d, d_max, latched).force;
        };
        const double step = largest_step_to(replay.delta_max, m_eff,
                                            [&](double d) { return planned_stiffness(pair, r_eff, d); });
        worst = larger(worst, error_of_e(force, m_eff, speed, share * step, replay.restitution));
      }
  }
  return worst;
}

/// Neither the stiffness at the end nor one on the way may be passed over if it is no number: no step
/// follows.
TEST(ContactStep, AStiffnessThatIsNoNumberGivesNoStep)
{
  for (const double bad : {0.3, 1.0})
    EXPECT_TRUE(std::isnan(largest_step_to(1.0, 1.0, [&](double d) {
      return std::abs(d - bad) < 0.02 ? std::nan("") : 1.0;
    }))) << bad;
}

/// The table of the reference page, rounded up: at the largest step e is right to 0.0033.
TEST(ContactStep, TheLargestStepKeepsRestitution)
{
  for (const auto& [share, stated] : {std::pair{0.5, 0.0008}, {1.0, 0.0033}, {2.0, 0.017}, {4.0, 0.09}}) {
    const double worst = worst_error(share);
    EXPECT_LE(worst, stated) << share;
    EXPECT_GT(worst, 0.9 * stated) << share;
  }
}

/// Hertz's k = 2 E* sqrt(R* d) grows with depth: rule and inverse in closed form.
TEST(ContactStep, OverlapOfStepIsTheInverse)
{
  const double e_star = 1e8, r = 1e-3, m = 1e-6;
  const auto hertz = [&](double d) { return 2 * e_star * std::sqrt(r * d); };
  for (const double overlap : {1e-6, 3e-5, 9e-5}) {
    const double step = largest_step_to(overlap, m, hertz);
    EXPECT_DOUBLE_EQ(step, 0.1 * M_PI * std::sqrt(m / hertz(overlap)));
    EXPECT_NEAR(overlap_of_step(step, m, 1e-4, hertz), overlap, 2e-6 * 1e-4);  // to 1e-6 of the deepest
  }
  EXPECT_EQ(overlap_of_step(1e-9, m, 1e-4, hertz), 1e-4);
}

}  // namespace granulaw::contact_step_test
