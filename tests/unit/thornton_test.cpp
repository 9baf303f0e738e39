#include "contact/thornton.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/scales.hpp"
#include "law/replay.hpp"
#include "synthetic_law.hpp"

namespace granulaw::thornton_test {

TEST(Thornton, ClosedFormMatchesThePublishedNumbers)
{
  const double table[][2] = {{2, .93063},  {5, .77334},   {10, .65856},  {20, .55711},
                             {50, .44461}, {100, .37430}, {1000, .21070}};
  for (const auto& [v, e] : table) EXPECT_NEAR(thornton_restitution(v), e, 1e-5);
  EXPECT_EQ(thornton_restitution(0.5), 1.0);
}

TEST(Thornton, NoNumberInNoForceOut)
{
  const Thornton pair(10e9, 1.6e8);
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (const double delta : {1e-8, 1e-4})  // below yield and beyond
    for (const auto& [now, largest] : {std::pair(none, delta), std::pair(none, 0.0), std::pair(delta, none)})
      EXPECT_TRUE(std::isnan(pair.evaluate(2e-3, now, largest).force));
}

TEST(Thornton, ReplayGivesTheClosedForm)
{
  const double e_star = 10e9, y = 1e8, rho = 1500, r = 0.002;
  const Thornton pair(e_star, 1.6 * y);
  const double mass = 4.0 / 3.0 * M_PI * rho * r * r * r;
  for (const double ratio : {0.5, 1.5, 2.0, 5.0, 20.0, 100.0, 1000.0}) {
    const double v = ratio * yield_velocity(e_star, y, rho);
    const double guess = 2.87 * std::pow(mass * mass / (e_star * e_star * r * v), 0.2);
    const Replay replay = replay_collision(
        [&](double delta, double delta_max) { return pair.evaluate(r, delta, delta_max); }, mass, v, guess);
    // velocity Verlet at 20000 steps a contact: 1e-6; the kink at the reversal adds one step's work
    EXPECT_NEAR(replay.restitution, thornton_restitution(ratio), 2e-4 * thornton_restitution(ratio)) << ratio;
    EXPECT_NEAR(replay.work_unload / replay.work_load, replay.restitution * replay.restitution, 1e-3);
  }
}

TEST(Thornton, ForceAndRadiusAreContinuousAtYieldAndAtTheReversal)
{
  const Thornton pair(10e9, 1.6e8);
  const double r = 0.002, d_y = pair.yield_overlap() * r;
  const auto below = pair.evaluate(r, d_y * (1 - 1e-12), 0), above = pair.evaluate(r, d_y * (1 + 1e-12), 0);
  EXPECT_NEAR(below.force, above.force, 1e-10 * above.force);
  EXPECT_NEAR(below.stiffness, above.stiffness, 1e-10 * above.stiffness);
  const double d_m = 30 * d_y;
  const auto loading = pair.evaluate(r, d_m, d_m), unloading = pair.evaluate(r, d_m * (1 - 1e-12), d_m);
  EXPECT_NEAR(loading.force, unloading.force, 1e-9 * loading.force);
  EXPECT_NEAR(loading.contact_radius, unloading.contact_radius, 1e-9 * loading.contact_radius);
}

TEST(Thornton, WorkAndStiffnessAreThoseOfTheForce)
{
  const Thornton pair(10e9, 1.6e8);
  const double r = 0.002, d_y = pair.yield_overlap() * r;
  for (const double d_m : {0.5 * d_y, 3 * d_y, 40 * d_y}) {
    const int steps = 20000;
    double loading = 0, stored = 0;
    for (int k = 0; k < steps; ++k) {  // midpoint rule: 1e-8 of it, but for the roots at the ends
      const double d = (k + 0.5) / steps * d_m;
      loading += pair.evaluate(r, d, d).force * d_m / steps;
      stored += pair.evaluate(r, d, d_m).force * d_m / steps;
    }
    EXPECT_NEAR(pair.stored_energy(r, d_m, d_m, 0) / stored, 1.0, 1e-5);
    EXPECT_NEAR(pair.dissipated(r, 0, d_m, 0), loading - stored, 1e-5 * loading);
    // half-way out the contact holds what it gives back from there
    double rest = 0;
    const double half = 0.9 * d_m;
    for (int k = 0; k < steps; ++k)
      rest += pair.evaluate(r, (k + 0.5) / steps * half, d_m).force * half / steps;
    EXPECT_NEAR(pair.stored_energy(r, half, d_m, 0), rest, 1e-5 * stored);
    const double top = pair.evaluate(r, d_m, d_m).force,
                 below = pair.evaluate(r, d_m * (1 - 1e-6), d_m).force;
    EXPECT_NEAR(pair.stiffness(r, d_m, 0) / ((top - below) / (1e-6 * d_m)), 1.0, 1e-4);
  }
}

TEST(Thornton, UnloadsAsHertzOfTheFlattenedRadius)
{
  const double e_star = 10e9, p_y = 1.6e8, r = 0.002;
  const Thornton pair(e_star, p_y);
  const double d_y = std::pow(M_PI * p_y / (2 * e_star), 2) * r, f_y = 4.0 / 3.0 * e_star * std::sqrt(r * d_y) * d_y;
  for (const double d_m : {1.5 * d_y, 40 * d_y}) {
    const double f_m = f_y + M_PI * p_y * r * (d_m - d_y);  // the formulas as he writes them
    const double r_p = 4 * e_star / (3 * f_m) * std::pow((2 * f_m + f_y) / (2 * M_PI * p_y), 1.5);
    const double d_p = d_m - std::pow(3 * f_m / (4 * e_star * std::sqrt(r_p)), 2.0 / 3.0);
    for (const double part : {1.0, 0.5, 0.01}) {
      const double d = d_p + part * (d_m - d_p);
      // rounding of d - d_p, of which the force goes as the power 1.5, at a hundredth of the way
      EXPECT_NEAR(pair.evaluate(r, d, d_m).force, 4.0 / 3.0 * e_star * std::sqrt(r_p) * std::pow(d - d_p, 1.5), 1e-11 * f_m);
      EXPECT_NEAR(pair.evaluate(r, d, d_m).contact_radius, std::sqrt(r_p * (d - d_p)), 1e-11 * r);
    }
    EXPECT_EQ(pair.evaluate(r, 0.99 * d_p, d_m).force, 0);
  }
}

TEST(Thornton, StretchedDoesTheSameWorkOverALongerWay)
{
  const double r = 0.002, stretch = 3;
  const Thornton real(1e8, 1.6e6), stretched(1e8, 1.6e6, stretch);
  const double d_m = 40 * real.yield_overlap() * r;
  const auto near = [](double a, double b) { EXPECT_NEAR(a, b, 1e-12 * std::abs(b)); };  // rounding of some ten operations
  near(stretched.yield_overlap(), stretch * real.yield_overlap());
  near(stretched.dissipated(r, 0, stretch * d_m, 0), real.dissipated(r, 0, d_m, 0));
  near(stretched.stiffness(r, stretch * d_m, 0), real.stiffness(r, d_m, 0) / (stretch * stretch));
  for (const double d : {d_m, 0.95 * d_m}) {
    const Answer one = real.evaluate(r, d, d_m), other = stretched.evaluate(r, stretch * d, stretch * d_m);
    near(other.force, one.force / stretch);
    near(other.stiffness, one.stiffness / (stretch * stretch));
    near(other.contact_radius, one.contact_radius);
    near(stretched.stored_energy(r, stretch * d, stretch * d_m, 0), real.stored_energy(r, d, d_m, 0));
  }
}

TEST(Replay, ElasticCollisionOfALawIsHertz)
{
  // The synthetic law at 1e-8 of an overlap is Hertz to 0.9 sqrt(1e-8) = 1e-4.
  const Law law = tests::SyntheticLaw{}.law();
  const PairLaw pair = resolve_pair(law, "glass", "wall", "test");
  const double r = 0.002, mass = 4.0 / 3.0 * M_PI * 2500 * r * r * r, e_star = pair.mapping.e_star;
  const double delta = 1e-8 * r;
  const double v = std::sqrt(16.0 / 15.0 * e_star * std::sqrt(r) * std::pow(delta, 2.5) / mass);
  const Replay replay = replay_collision(pair, r, mass, v);
  EXPECT_NEAR(replay.restitution, 1.0, 1e-6);
  EXPECT_NEAR(replay.delta_max / delta, 1.0, 2e-4);
  // Hertz: T = 2.9432 delta/V (Johnson, sect. 11.4)
  EXPECT_NEAR(replay.contact_time / (2.9432 * delta / v), 1.0, 5e-4);
  EXPECT_FALSE(replay.left_range);
}

TEST(Replay, RestitutionIsTheRatioOfTheWorkFunctions)
{
  const Law law = tests::SyntheticLaw{}.law();
  const PairLaw pair = resolve_pair(law, "powder", "wall", "test");
  const double r = 0.002, mass = 4.0 / 3.0 * M_PI * 1500 * r * r * r;
  for (const double v : {0.05, 0.5, 3.0}) {
    const Replay replay = replay_collision(pair, r, mass, v);
    const double x = replay.delta_max / r;
    ASSERT_FALSE(replay.left_range);
    EXPECT_NEAR(replay.restitution, std::sqrt(pair.curve->kept(x)),
                2e-4);
  }
}

}  // namespace granulaw::thornton_test
