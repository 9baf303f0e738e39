#include "base/larger.hpp"
#include "atlas/composed_law.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "base/error.hpp"
#include "atlas/law_from_atlas.hpp"
#include "law/error_bound.hpp"
#include "law/radiation.hpp"
#include "law/replay.hpp"
#include "own_atlas.hpp"
#include "synthetic_law.hpp"

namespace granulaw::composed_law_test {

using tests::atlas;

/// E* = rho = 1 for the first.
LawMaterial material(const char* name, double e_star, double yield, double nu = 0.3, double density = 1)
{
  LawMaterial m;
  m.name = name, m.density = density, m.poisson_ratio = nu, m.youngs_modulus = e_star * (1 - nu * nu);
  m.yield_stress = yield;
  return m;
}
constexpr double never = std::numeric_limits<double>::infinity(), wall = never;

TwoBodyLaw composed(const LawMaterial& s, const LawMaterial& h, double radius_ratio, double fastest = 0)
{
  LawRange options;
  options.fastest = fastest;
  return compose_law(atlas(), PairBody(atlas(), s), PairBody(atlas(), h), radius_ratio, options);
}

BodyLaw alone(const LawMaterial& s)
{
  LawRange options;
  options.fastest = 0;
  return law_from(atlas(), s, options);
}

/// Largest relative difference of the loading force, and of e by works, over the range of both from x = 1e-4
/// on.
struct Difference
{
  double force = 0, restitution = 0;
};
Difference difference(const Curve& a, const Curve& b)
{
  Difference most;
  for (double x = 1e-4; x < 0.99 * std::min(a.end(), b.end()); x *= 1.1) {
    const auto e = [&](const Curve& c) { return std::sqrt(c.kept(x)); };
    most.force = larger(most.force, std::abs(a.loading(x).force / b.loading(x).force - 1));
    most.restitution = larger(most.restitution, std::abs(e(a) - e(b)));
  }
  return most;
}

TEST(ComposedLaw, IsTheBodysOwnAgainstItsLikeAndTheRigidWall)
{
  // The atlas interpolates between its stiffnesses, the equivalent spheres between theirs: up to 0.5 %
  // between two nodes.
  constexpr double force = 0.006, restitution = 0.002;
  for (const double yield : {1 / 50.0, 1 / 150.0, 1 / 700.0}) {
    const LawMaterial m = material("m", 1, yield);
    LawMaterial like = m;
    like.name = "n";
    const Difference of_like = difference(composed(m, like, 1).law.curve, alone(m).curve);
    EXPECT_LT(of_like.force, force) << yield;
    EXPECT_LT(of_like.restitution, restitution) << yield;
    const TwoBodyLaw rigid = composed(m, material("r", 1e6, never), wall);
    const Difference of_wall = difference(rigid.law.curve, alone(m).curve);
    EXPECT_LT(of_wall.force, force) << yield;
    EXPECT_LT(of_wall.restitution, restitution) << yield;
  }
}

/// Shot on a large body, media on ore: the ball hollows the yielding body out. F_max and e of impacts by the solver
/// (mpm impact --against, 24 cells, four grids), E* .85 GPa, Y 1 MPa, 1000 kg/m3, radii 4 and 1 mm.
TEST(ComposedLaw, OfASmallHardPartnerThatHollowsItOut)
{
  const LawMaterial s = material("s", 0.85e9, 1e6, 0.3, 1000), h = material("h", 0.85e9, never, 0.3, 1000);
  const UnlikePair pair{s, h, 0.25};
  const TwoBodyLaw own = composed(s, h, pair.radius_ratio, 0.1);
  const PairLaw law{{&own.law.curve, pair.mapping(), radiation(s, 4e-3, h, 1e-3)}, &own.law};
  struct Impact
  {
    double velocity, force_max, restitution;
  };
  for (const Impact& i : {Impact{1, 0.26861, 0.33846}, Impact{3.07, 0.81002, 0.23176}}) {
    const double radius = 4e-3, mass = s.density * std::pow(radius, 3);
    const Replay replay = replay_collision(law, radius * pair.r_eff(), mass * pair.m_eff(), i.velocity);
    const ErrorBound& stated = own.law.bound;
    EXPECT_NEAR(replay.force_max / i.force_max, 1, stated.force) << i.velocity;
    EXPECT_NEAR(replay.restitution, i.restitution, stated.restitution_at(i.restitution)) << i.velocity;
  }
}

TEST(ComposedLaw, OfElasticBodiesIsHertzWithEachFiniteSphere)
{
  const LawMaterial a = material("a", 1, never), b = material("b", 3, never);
  const TwoBodyLaw law = composed(a, b, 2);
  EXPECT_FALSE(std::isfinite(law.law.curve.onset()));
  EXPECT_NEAR(law.law.curve.loading(1e-6).force / 1e-9, 1, 2e-3);
  // The overlap falls short of Hertz's by k F/(E* R) of each (k = c1/2).
  const double k = 0.5 * atlas().elastic(0.3).fit.correction.c1, x = 0.01;
  const PairMapping mapping = PairMapping::deformable_partner(1, 3);
  const double r_eff = effective_radius(1, 2), force = law.law.curve.loading(x).force * mapping.force(r_eff);
  const double hertz = std::pow(force * 0.75 / mapping.e_star_pair() / std::sqrt(r_eff), 2.0 / 3.0);
  // the finite sphere's next term goes as x: 0.2 to 0.3 of it
  EXPECT_NEAR(x * mapping.length(r_eff), hertz - k * force * (1 + 1 / (3 * 2.0)), 0.3 * x * hertz);
}

TEST(ComposedLaw, IsContinuousInThePartner)
{
  const LawMaterial s = material("s", 1, 0.01);
  const Curve of_elastic = composed(s, material("h", 2, never), 1.5).law.curve,
                     of_strong = composed(s, material("h", 2, 0.09), 1.5).law.curve;
  EXPECT_LT(difference(of_elastic, of_strong).force, 0.005);  // it stays elastic up to 9 times the pressure
  const Curve like = composed(s, material("h", 1, 0.01), 1.001).law.curve,
                     nearly = composed(s, material("h", 1, 0.0101), 1).law.curve;
  EXPECT_LT(difference(like, nearly).force, 0.01);  // of a hardness 0.5 % higher on average
  const Curve large = composed(s, s, 1e4).law.curve, thick = composed(s, s, wall).law.curve;
  EXPECT_LT(difference(large, thick).force, 0.001);
}

/// Materials that differ by rounding have laws that differ by the accuracy of the roots, 2^-40 of ln(a).
TEST(ComposedLaw, OfMaterialsThatDifferByRoundingIsTheSame)
{
  constexpr double accuracy = 1e-9;
  for (const double partner : {0.6, 1.4, 2.8})
    for (const double ratio : {0.0, 1.0, 2.3, wall}) {
      LawMaterial s = material("s", 1, 0.009);
      const LawMaterial h = material("h", partner, 0.03, 0.25);
      const Curve law = composed(s, h, ratio).law.curve;
      s.youngs_modulus *= 1 + 1e-15;
      const Difference by_rounding = difference(law, composed(s, h, ratio).law.curve);
      EXPECT_LT(by_rounding.force, accuracy) << partner << ' ' << ratio;
      EXPECT_LT(by_rounding.restitution, accuracy) << partner << ' ' << ratio;
    }
}

/// A sphere dents a wall as it dents a sphere of 10,000 times its size.
TEST(ComposedLaw, OfAThickWallThatYields)
{
  const LawMaterial soft = material("soft", 1, 0.01), glass = material("glass", 2, never);
  const TwoBodyLaw of_wall = composed(soft, glass, 0), of_sphere = composed(soft, glass, 1e-4);
  EXPECT_EQ(of_wall.size_share(), 1);
  EXPECT_LT(difference(of_wall.law.curve, of_sphere.law.curve).force, 0.001);
  EXPECT_TRUE(tests::loses_no_less_further_on(of_wall.law.curve));
}

TEST(ComposedLaw, IsAdmissibleForAnyPair)
{
  std::mt19937_64 random(20);
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, static_cast<double>(random() >> 11) * 0x1p-53);
  };
  int composed_of = 0;
  for (int k = 0; k < 40; ++k) {
    LawMaterial s = material("s", 1, 1 / between(30, 1000), between(0.1, 0.45)),
                h = material("h", between(0.1, 1000), never, between(0.1, 0.45));
    if (k % 3) h.yield_stress = s.yield_stress * between(1, 10);
    if (h.yields() && h.e_star() / h.yield_stress < 20) continue;  // outside the atlas
    if (k % 4 == 0) s.hardening_modulus = between(0.001, 0.1) * s.youngs_modulus;
    const double ratio = k % 5 ? between(0.1, 10) : wall;
    const TwoBodyLaw law = composed(s, h, ratio, k % 2 ? 0.1 : 0.0);
    EXPECT_TRUE(tests::loses_no_less_further_on(law.law.curve)) << k;
    ++composed_of;
  }
  EXPECT_GT(composed_of, 25);
}

/// Contacts with a partner of a hundredth of its stiffness yield where they are as wide as the bodies, or not
/// at all: the law is the two finite elastic bodies' up to there.
TEST(ComposedLaw, OfASoftPartnerAgainstWhichItHardlyYields)
{
  const LawMaterial hard = material("hard", 1, 0.03), soft = material("soft", 0.01, never);
  const PairBody first(atlas(), hard), second(atlas(), soft);
  const PairMapping mapping = PairMapping::deformable_partner(1, 0.01);
  for (const double ratio : {0.0, 0.5, 1.0, 2.0, wall}) {
    const Curve law = composed(hard, soft, ratio).law.curve;
    const ComposedPair pair(first, ratio == 0 ? wall : 1, second, ratio == 0 ? 1 : ratio);
    const double length = mapping.length(pair.r_eff()), force = mapping.force(pair.r_eff());
    EXPECT_GT(law.end() * length, 0.4 * pair.smaller_radius()) << ratio;
    for (const double a : {0.05, 0.1, 0.2, 0.4, 0.6, 0.8}) {
      const ComposedState state = pair.at(a * pair.smaller_radius());
      // two terms of the elastic body, fitted over all of it
      EXPECT_NEAR(law.force(state.overlap / length) * force / state.force, 1, 0.02) << ratio << ' ' << a;
    }
    EXPECT_NEAR(law.kept(0.5 * law.end()), 1, 1e-9) << ratio;
  }
}

TEST(Radiation, OfASoftSphereOnAHardWallComesBackInTime)
{
  // hardly yields: by two runs (E* 1:34, Y 0.01 E*, V/c 0.007 and 0.02) e is 0.998
  const LawMaterial hard = material("hard", 34, 0.3), soft = material("soft", 1, never);
  EXPECT_LT(radiation(hard, wall, soft, 1), 0.03 * radiation_number(0.3));
  EXPECT_LT(radiation(hard, 1, soft, 1), 0.06 * radiation_number(0.3));
}

/// Lamb's integral in complex numbers by 4,000 points each (a program apart); at 0 and .49 within the digits given.
TEST(Radiation, NumberIsLambsIntegral)
{
  const double table[][2] = {{0, .6052}, {.1, .6147}, {.2, .6319}, {.3, .6627}, {.4, .7196}, {.45, .7661}, {.49, .8187}};
  for (const auto& [nu, number] : table) EXPECT_NEAR(radiation_number(nu), number, 6e-5) << nu;
}

TEST(Radiation, OfAThickWallIsTheHalfSpacesAndOfLikeSpheresNearlyNothing)
{
  const LawMaterial m = material("m", 1, 0.01);
  const double half_space = radiation_number(0.3);  // rho = c = 1
  EXPECT_NEAR(radiation(m, 1, m, wall), half_space, 0.03 * half_space);
  EXPECT_EQ(radiation(m, 1, m, 1), 0);
  EXPECT_DOUBLE_EQ(radiation(m, 1, m, 5), radiation(m, 2, m, 10));
  const LawMaterial stiff = material("stiff", 100, never);
  EXPECT_LT(radiation(m, 1, stiff, wall), 0.03 * half_space);
}

/// A body of another flow law with its own law on a flat, here one of the atlas: by the right flow curve alone it is
/// known. By one that hardens half as much the departure, shared by all stiffnesses at one overlap/onset, takes most
/// of the difference.
TEST(ComposedLaw, OfABodyThatTheAtlasDoesNotKnow)
{
  LawMaterial hardening = material("m", 1, 1 / 100.0);
  hardening.hardening_modulus = 0.03 * hardening.youngs_modulus;
  const LawMaterial glass = material("glass", 2, never);
  LawMaterial unknown = hardening, softer = hardening;
  unknown.hardening_modulus = 0, softer.hardening_modulus *= 0.5;
  const double slope = hardening.hardening_modulus / hardening.yield_stress;
  const FlowCurve right = [slope](double strain) { return 1 + slope * strain; }, half = of_twin(right, 0.5);
  const Curve own = alone(hardening).curve;
  const PairBody known(atlas(), hardening), by_right(atlas(), unknown, right, own), by_half(atlas(), unknown, half, own),
      without(atlas(), softer), partner(atlas(), glass);
  LawRange options;
  options.fastest = 0;
  for (const double ratio : {0.5, 1.0, 3.0}) {
    const auto law = [&](const PairBody& body) {
      return compose_law(atlas(), body, partner, ratio, options).law.curve;
    };
    const Difference right_one = difference(law(by_right), law(known)), half_one = difference(law(by_half), law(known)),
                     none = difference(law(without), law(known));
    // the table of the own law, from which the departure is taken
    EXPECT_LT(right_one.force, 0.002) << ratio;
    EXPECT_LT(right_one.restitution, 0.001) << ratio;
    // half the hardening changes F by 8 % at 300 onsets of E*/Y = 200, by 12 % at 100: of F a third remains, of e, where
    // the equivalent sphere is softer than the body, half
    EXPECT_LT(half_one.force, 0.35 * none.force) << ratio;
    EXPECT_LT(half_one.restitution, 0.5 * none.restitution) << ratio;
  }
}

/// Strains go as the curvature, so stresses that grow with the strain do so in an equivalent sphere as E does:
/// a body between a flat and its like is pressed by what an equivalent sphere of the same H/E is.
TEST(ComposedLaw, TwinsHaveTheBodysHardeningOverItsModulus)
{
  LawMaterial m = material("m", 1, 1 / 100.0);
  m.hardening_modulus = 0.03 * m.youngs_modulus;
  LawMaterial stiffer = material("n", 2, 1 / 100.0);
  stiffer.hardening_modulus = 0.03 * stiffer.youngs_modulus;
  // twice the curvature on a sphere of E* as the flat's on one of 2 E*: same pressure, twice the overlap
  const PairBody body(atlas(), m), twin(atlas(), stiffer);
  for (const double flat : {0.05, 0.1, 0.2}) {
    const double hollow = 0.5 * (1 - std::sqrt(1 - 4 * flat)), contact = 2 * flat - hollow;  // its alpha' is the flat's
    const PairBody::State a = body.at(2 * flat, contact), b = twin.at(flat, flat);
    EXPECT_NEAR(a.pressure / b.pressure, 1, 0.004);  // the atlas between its stiffnesses
    EXPECT_NEAR(a.residual / b.residual, 2, 0.02);
  }
}

/// The rule was measured by impacts whose cells have an error, too: as for an atlas law, it adds to the rule's.
TEST(ComposedLaw, ItsBoundIncludesTheSolversErrorOfTheLessCertainBody)
{
  const LawMaterial s = material("s", 1, 1 / 100.0), h = material("h", 2, 1 / 500.0);
  const double softer = atlas().bounds_near(100).solver, stiffer = atlas().bounds_near(1000).solver;
  ASSERT_GT(stiffer, 1.5 * softer);  // the larger of the two is not the yielding body's
  const Certificate c = composed(s, h, 1).law.certificate;
  EXPECT_EQ(c.solver_error_force, stiffer);
  EXPECT_EQ(c.solver_error_restitution, stiffer);
  const ComposedError composing = composed_error(2);
  EXPECT_DOUBLE_EQ(bound_of(c).force, std::hypot(composing.force, stiffer));
  EXPECT_DOUBLE_EQ(bound_of(c).restitution_at(0.5), std::hypot(composing.restitution, 0.5 * stiffer));
  const Certificate elastic = composed(material("s", 1, never), material("h", 2, never), 1).law.certificate;
  EXPECT_GT(elastic.solver_error_force, 0);
  EXPECT_EQ(elastic.solver_error_restitution, 0);  // e is 1
}

}  // namespace granulaw::composed_law_test
