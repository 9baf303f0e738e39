// The body behind a contact: Boussinesq's energy, the root that the series compliance has, and the work of closed paths.
#include "contact/body_behind.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "contact/tabulated.hpp"
#include "law/replay.hpp"
#include "synthetic_law.hpp"

namespace granulaw::body_behind_test {

const Law law = tests::SyntheticLaw{}.law();

/// Under F = E* = 1 the line from the depth 1 down shortens by the integral of its strain, (s_zz - 2 nu s_rr)/E with the
/// stresses below a point load, s_zz = -3/(2 pi z^2) and s_rr = (1 - 2 nu)/(4 pi z^2) (Johnson 1985, eqs 3.19 and 3.20).
TEST(BodyBehind, FarFieldIsBoussinesqs)
{
  for (const double nu : {0.0, 0.2, 0.3, 0.45, 0.5}) {
    const double strain = (3 / (2 * M_PI) + 2 * nu * (1 - 2 * nu) / (4 * M_PI)) / (1 - nu * nu);  // at z = 1; falls as 1/z^2
    EXPECT_NEAR(far_field(nu), strain, 1e-14) << nu;
  }
}

TEST(BodyBehind, NoneBehindASphere)
{
  EXPECT_EQ(reach_behind(1.7e-3, 1.7e-3), 0.0);
  EXPECT_EQ(overlap_of_law(3e-5, 0.0, 1e-5, [](double) -> Response { ADD_FAILURE(); return {}; }), 3e-5);
}

/// On its pole a body of revolution of half axes a, a, c has the radius of curvature a^2/c, and its centre c over it.
TEST(BodyBehind, OfAnEllipsoid)
{
  const double a = 2e-3, infinity = std::numeric_limits<double>::infinity();
  for (const double c : {1.5e-3, 2e-3, 4e-3}) EXPECT_NEAR(reach_behind(a * a / c, c), c / (a * a) - 1 / c, 1e-9);
  EXPECT_GT(reach_behind(a * a / 4e-3, 4e-3), 0.0);       // sharp
  EXPECT_LT(reach_behind(a * a / 1.5e-3, 1.5e-3), 0.0);   // blunt
  EXPECT_EQ(reach_behind(infinity, 1e-3), 0.0);           // a plane side
}

/// Loading, unloading, below the residual overlap, softer and stiffer: the parts make the whole.
TEST(BodyBehind, PartsMakeTheWhole)
{
  const PairLaw pair = wall_pair(law.bodies.at("powder"));
  const Tabulated contact(pair, pair.measure(), {});
  const double r = 1e-3;
  for (const double distance : {0.5 * r, 0.8 * r, 1.5 * r, 10 * r}) {
    const double c = far_field(0.3) / contact.pair_modulus() * reach_behind(r, distance);
    for (const double deepest : {0.0, 1e-3, 0.05})
      for (const double overlap : {1e-7, 1e-4, 1e-2, 0.049, 0.05, 0.051, 0.1}) {
        std::vector<double> history(NormalState<Tabulated>::values, 0.0);
        history[0] = deepest * r;
        const double x = overlap_of_law(contact, r, overlap * r, c, history.data());
        const double force = contact.force(r, x, deepest * r, 0.0, history.data() + NormalState<Tabulated>::own);
        EXPECT_NEAR((x + c * force) / (overlap * r), 1, 1e-13) << distance << " " << deepest << " " << overlap;
      }
  }
}

/// Random overlaps and back to the first: the work is what the law books and the bodies hold.
TEST(BodyBehind, NoClosedPathGains)
{
  const PairLaw pair = wall_pair(law.bodies.at("powder"));
  const Tabulated contact(pair, pair.measure(), {});
  const double r = 1e-3, c = 0.3 / (contact.pair_modulus() * r);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> overlaps(0.0, 0.05 * r);
  std::vector<double> history(NormalState<Tabulated>::values, 0.0);
  double* const own = history.data() + NormalState<Tabulated>::own;
  double at = 0, work = 0, force = 0, law_overlap = 0;
  for (int path = 0; path < 20; ++path) {
    const double to = path == 19 ? 0.01 * r : overlaps(random);
    constexpr int steps = 20000;
    const double d = (to - at) / steps;
    for (int k = 0; k < steps; ++k) {
      at += d;
      const double before = force;
      law_overlap = overlap_of_law(contact, r, at, c, history.data());
      force = contact.force(r, law_overlap, history[0], 0.0, own);
      history[0] = std::max(history[0], law_overlap);
      work += 0.5 * (before + force) * d;
    }
  }
  const double booked = contact.dissipated(r, 0.0, history[0], 0.0) + contact.stored_energy(r, law_overlap, history[0], 0.0) +
                        energy_behind(c, force);
  EXPECT_NEAR(work / booked, 1, 1e-6);
}

TEST(BodyBehind, AnImpactGivesMoreBack)
{
  const BodyLaw& powder = law.bodies.at("powder");
  const double r = 1e-3, mass = 1e-5, v = 0.5;
  const Replay alone = replay_on_wall(powder, r, mass, v), same = replay_on_wall(powder, r, mass, v, 0.0);
  EXPECT_EQ(alone.restitution, same.restitution);
  const double c = far_field(0.3) / powder.material.e_star() * reach_behind(r, 2 * r);
  const Replay body = replay_on_wall(powder, r, mass, v, c);
  const PairLaw pair = wall_pair(powder);
  const double lost = Tabulated(pair, pair.measure(), {}).dissipated(r, 0.0, body.delta_max - c * body.force_max, 0.0);
  EXPECT_NEAR(body.restitution * body.restitution, 1 - lost / (0.5 * mass * v * v), 1e-4);  // the steps' error
  EXPECT_GT(body.restitution - alone.restitution, 0.003);
}

}  // namespace granulaw::body_behind_test
