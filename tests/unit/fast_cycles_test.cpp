// Closed overlap cycles on the lookup that the contact loop of a particle code runs: FastCurve with its
// FastAxis.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <memory>
#include <random>

#include "characterise/law_from_atlas.hpp"
#include "law/fast_curve.hpp"
#include "law_paths.hpp"
#include "synthetic_law.hpp"

namespace granulaw {
namespace {

using testing::SyntheticLaw;
using testing::unit_pair;

/// Largest error of the lookup's force against the curve's, over the force at the reversal
/// (fast_curve_test.cpp).
constexpr double lookup_error = 2e-5;

struct Lookup
{
  std::string what;
  ContactCurve curve;
  FastCurve fast;
  Lookup(std::string name, const ContactCurve& c) : what(std::move(name)), curve(c), fast(curve) {}
};
using Lookups = std::vector<std::unique_ptr<Lookup>>;

/// Laws of the shipped atlas, of random materials inside it.
const Lookups& atlas_laws()
{
  static const Lookups laws = [] {
    const Atlas atlas = read_atlas(GRANULAW_ATLAS_FILE);
    std::mt19937 random(20261121);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    Lookups all;
    for (int k = 0; k < 6; ++k) {
      const double stiffness = 20 * std::pow(250, part(random)), nu = 0.49 * part(random);
      LawMaterial m{"m", 1000, 1e9, nu, 0, 0};
      m.yield_stress = m.e_star() / stiffness;
      m.hardening_modulus = k % 2 ? 0.3 * part(random) * m.youngs_modulus : 0.0;
      BuildOptions options;
      options.fastest = 0.05 + 0.25 * part(random);
      if (!atlas.why_not(MaterialRatios::of(m)).empty()) continue;
      const BodyLaw law = law_from(atlas, m, options);
      all.push_back(std::make_unique<Lookup>(
          fmt::format("E*/Y {:.4g}, nu {:.2f}, H/E {:.2f}, {}", stiffness, nu,
                      m.hardening_modulus / m.youngs_modulus, law.curve.axis() ? "axis" : "no axis"),
          law.curve));
    }
    return all;
  }();
  return laws;
}

/// An X of the curve's axis or beyond, now and then none.
double any_impact_overlap(const ContactCurve& curve)
{
  return curve.axis() ? curve.axis()->overlap_end() * *rc::gen::inRange(0, 1100) / 1000.0 : 0.0;
}

void no_closed_cycle_gains(const Lookup& law)
{
  RC_LOG() << law.what << '\n';
  testing::no_closed_cycle_gains(law.fast, law.curve, any_impact_overlap(law.curve), lookup_error);
}

/// Nowhere a jump: not at the reversal, where loading begins and unloading ends, nor anywhere else.
void force_is_continuous(const Lookup& law)
{
  RC_LOG() << law.what << '\n';
  const double X = any_impact_overlap(law.curve);
  const double x_m = std::pow(law.curve.table().s_end * *rc::gen::inRange(1, 1100) / 1000.0, 4);
  for (const double x :
       {x_m, law.curve.onset(), law.curve.x_end(), x_m * *rc::gen::inRange(1, 2000) / 1000.0}) {
    const double step = 1e-9 * x;
    const auto at = [&](double overlap) { return law.fast.evaluate(unit_pair, 1.0, overlap, x_m, X); };
    const ContactForce below = at(x - step), above = at(x + step);
    const double stiffest = std::max({below.stiffness, above.stiffness, above.force / x});
    // by no more than the stiffnesses on either side allow; 1e-12: rounding
    RC_ASSERT(std::abs(above.force - below.force) <= 4 * step * stiffest + 1e-12 * at(x_m).force);
  }
}

SyntheticLaw any_synthetic()
{
  SyntheticLaw law;
  law.force_reduction = *rc::gen::inRange(50, 250) / 100.0;
  law.depth = *rc::gen::inRange(20, 200) / 100.0;
  law.bend = *rc::gen::inRange(-20, 20) / 100.0;
  law.onset = std::pow(10.0, -*rc::gen::inRange(200, 600) / 100.0);
  return law;
}
ContactCurve any_curve()
{
  const SyntheticLaw law = any_synthetic();
  switch (*rc::gen::inRange(0, 3)) {
    case 0:
      return law.curve();
    case 1:
      return law.curve_with_axis();
    default:
      return {law.table(), law.rate_axis(1e-3), "synthetic"};
  }
}

RC_GTEST_PROP(FastCycles, NoClosedCycleOfARandomAdmissibleLawGainsEnergy, ())
{
  const Lookup law("synthetic", any_curve());
  RC_PRE(law.curve.admissibility_margin() >= 0);
  no_closed_cycle_gains(law);
}

RC_GTEST_PROP(FastCycles, NoClosedCycleOfAnAtlasLawGainsEnergy, ())
{
  ASSERT_GE(atlas_laws().size(), 4u);
  no_closed_cycle_gains(*atlas_laws()[*rc::gen::inRange<std::size_t>(0, atlas_laws().size())]);
}

RC_GTEST_PROP(FastCycles, ForceIsContinuousOfRandomLaws, ())
{
  const Lookup law("synthetic", any_curve());
  force_is_continuous(law);
  testing::stiffness_is_the_derivative(law.fast, law.curve, any_impact_overlap(law.curve));
}

RC_GTEST_PROP(FastCycles, ForceIsContinuousOfAtlasLaws, ())
{
  const Lookup& law = *atlas_laws()[*rc::gen::inRange<std::size_t>(0, atlas_laws().size())];
  force_is_continuous(law);
  testing::stiffness_is_the_derivative(law.fast, law.curve, any_impact_overlap(law.curve));
}

/// The property must be able to fail: a law that returns more than it took.
TEST(FastCycles, ACycleThatGainsIsSeen)
{
  ContactCurve::Table table = SyntheticLaw{}.table();
  for (double& n : table.exponent) n = std::max(1.0, n - 0.3);
  const Lookup law("returns too much", ContactCurve(table, "test"));
  testing::Path contact(law.fast);
  contact.move(1.2 * law.curve.onset());
  contact.move(0.0);
  EXPECT_LT(contact.work(), -10 * (2 * lookup_error * contact.scale() + contact.open()));
}

}  // namespace
}  // namespace granulaw
