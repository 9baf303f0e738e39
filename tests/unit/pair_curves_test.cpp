#include "law/pair_curves.hpp"

#include <gtest/gtest.h>

#include <set>

#include "law/replay.hpp"
#include "contact/thornton.hpp"
#include "synthetic_law.hpp"

namespace granulaw::pair_curves_test {

/// powder:glass has composed laws for like radii and for a deformable wall.
Law some_law()
{
  Law law = tests::SyntheticLaw{}.law_with_axis();
  tests::SyntheticLaw other;
  other.depth = 0.8;
  for (const double ratio : {1.0, std::numeric_limits<double>::infinity()}) {
    TwoBodyLaw& own = law.pair_laws["powder:glass"].emplace_back();
    own.law = law.bodies.at("powder");
    own.law.curve = other.curve_with_axis();
    own.law.certificate.origin = composed_origin;
    own.radius_ratio = ratio;
  }
  return law;
}

LawCurves curves_of(const Law& law, const std::string& pair, std::optional<double> radius2,
               std::optional<double> speed = {})
{
  return pair_curves(law, choose_pair(law, {"law.h5", pair, 1e-3, radius2}), speed);
}

std::multiset<std::string> roles(const auto& lines)
{
  std::multiset<std::string> found;
  for (const DrawnLine& line : lines) found.insert(line.role);
  return found;
}

template <class Line>
Line line_of(const std::vector<Line>& lines, const std::string& role)
{
  for (const Line& line : lines)
    if (line.role == role) return line;
  ADD_FAILURE() << "no line " << role;
  return {};
}

TEST(PairCurves, ThickWallShowsTheLawWithAndWithoutWavesTheRuleAndTheFormulas)
{
  const LawCurves curves = curves_of(some_law(), "powder:glass", std::numeric_limits<double>::infinity());
  EXPECT_EQ(roles(curves.force), (std::multiset<std::string>{"formula", "law", "other", "rule"}));
  EXPECT_EQ(roles(curves.restitution),
            (std::multiset<std::string>{"formula", "law", "other", "rule", "still"}));
  EXPECT_EQ(line_of(curves.restitution, "law").name, "composed law");
  EXPECT_EQ(curves.title, "powder (R = 1 mm) against a deformable wall of glass");
  const DrawnLine with = line_of(curves.restitution, "law"), still = line_of(curves.restitution, "still");
  EXPECT_LT(with.y.back(), still.y.back());
}

TEST(PairCurves, PairsWithoutALawOfTheirOwnShowNoRuleBesideIt)
{
  const Law law = some_law();
  for (const auto& [pair, name] :
       {std::pair("powder:wall", "law of the body"), std::pair("powder:powder", "law of the body")}) {
    const LawCurves curves = curves_of(law, pair, {});
    EXPECT_EQ(roles(curves.force), (std::multiset<std::string>{"formula", "law"})) << pair;
    EXPECT_EQ(line_of(curves.force, "law").name, name);
  }
  Law by_rule = law;
  by_rule.pair_laws.clear();
  EXPECT_EQ(line_of(curves_of(by_rule, "powder:glass", 1e-3).force, "law").name, "pair rule");
}

TEST(PairCurves, AreThoseOfTheLawsThatTheyName)
{
  const Law law = some_law();
  const ChosenPair pair = choose_pair(law, {"law.h5", "powder:glass", 1e-3, 1e-3});
  Law by_rule = law;
  by_rule.pair_laws.clear();
  const ChosenPair rule = choose_pair(by_rule, {"law.h5", "powder:glass", 1e-3, 1e-3});
  const LawCurves curves = pair_curves(law, pair, 3.0);
  for (const auto& [role, chosen] : {std::pair("law", &pair), std::pair("rule", &rule)}) {
    const DrawnLine e = line_of(curves.restitution, role);
    const ForceLine force = line_of(curves.force, role);
    EXPECT_DOUBLE_EQ(e.x.back(), 3.0);
    // 2000 steps a contact against 20,000
    EXPECT_NEAR(e.y.back(),
                replay_collision(chosen->law, chosen->r_eff, chosen->m_eff, 3.0).restitution, 1e-5);
    const double deepest = force.x.back();
    EXPECT_DOUBLE_EQ(force.y.back(),
                     chosen->law.evaluate(chosen->r_eff, deepest, deepest).force);
    const DrawnLine half = force.unloading[1];
    const double top = half.x.back(), foot = half.x.front();
    EXPECT_NEAR(top / deepest, 0.5, 1e-12);
    EXPECT_GT(foot, 0);
    EXPECT_DOUBLE_EQ(half.y.front(), chosen->law.evaluate(chosen->r_eff, foot, top).force);
  }
}

TEST(PairCurves, ThorntonYieldsWhereHisWorkIsTheKineticEnergy)
{
  const Law law = some_law();
  const ChosenPair pair = choose_pair(law, {"law.h5", "powder:glass", 1e-3, 2e-3});
  const DrawnLine line = line_of(pair_curves(law, pair, {}).restitution, "formula");
  const Thornton thornton(pair.law.mapping.e_star_pair(), 1.6 * 1e8);
  const double v = line.x.back();
  const double duration =
      2.87 * std::pow(pair.m_eff * pair.m_eff / (thornton.e_star * thornton.e_star * pair.r_eff * v), 0.2);
  const Replay replay =
      replay_collision([&](double d, double d_max) { return thornton.evaluate(pair.r_eff, d, d_max); },
                       pair.m_eff, v, duration);
  // eq. 41 is this law's e; velocity Verlet at 20,000 steps a contact: 1e-6
  EXPECT_NEAR(line.y.back(), replay.restitution, 1e-6);
}

TEST(BodyCurves, AreInUnitsOfTheMaterial)
{
  const Law law = some_law();
  const BodyLaw& powder = law.bodies.at("powder");
  const LawCurves curves = body_curves(law);
  EXPECT_EQ(roles(curves.force), (std::multiset<std::string>{"body", "body"}));
  EXPECT_EQ(roles(curves.restitution), (std::multiset<std::string>{"body", "formula"}));  // glass is elastic
  const ForceLine force = *std::find_if(curves.force.begin(), curves.force.end(), [](const ForceLine& line) {
    return line.name.starts_with("powder, E*/Y = ");
  });
  EXPECT_DOUBLE_EQ(force.x.back(), powder.curve.end());
  const PairLaw on_wall{{&powder.curve, PairMapping::rigid_partner(powder.material.e_star())}, &powder};
  const double overlap = 2e-3 * force.x.back();  // of another radius: the law has none
  EXPECT_NEAR(force.y.back(),
              on_wall.evaluate(2e-3, overlap, overlap).force / (powder.material.yield_stress * 2e-3 * 2e-3),
              1e-12 * force.y.back());
  const DrawnLine e = line_of(curves.restitution, "body"), thornton = line_of(curves.restitution, "formula");
  EXPECT_DOUBLE_EQ(e.x.front(), 0.5);  // V/V_y
  EXPECT_NEAR(e.y.front(), 1, 2e-9);  // of a replay, integrated step by step: 6e-10 off
  EXPECT_LT(e.y.back(), 0.5);
  EXPECT_DOUBLE_EQ(thornton.y.front(), 1);
}

}  // namespace granulaw::pair_curves_test
