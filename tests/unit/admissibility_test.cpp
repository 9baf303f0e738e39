#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "law_paths.hpp"
#include "synthetic_law.hpp"

namespace granulaw {
namespace {

using testing::SyntheticLaw;
using testing::unit_pair;

RC_GTEST_PROP(Admissibility, NoClosedCycleGainsEnergy, ())
{
  SyntheticLaw law;
  law.force_reduction = *rc::gen::inRange(50, 250) / 100.0;
  law.depth = *rc::gen::inRange(20, 200) / 100.0;
  law.bend = *rc::gen::inRange(-20, 20) / 100.0;
  law.onset = std::pow(10.0, -*rc::gen::inRange(200, 600) / 100.0);
  const ContactCurve curve = law.curve();
  RC_PRE(curve.admissibility_margin() >= 0);
  testing::no_closed_cycle_gains(curve, curve);
}

TEST(Admissibility, ANegativeMarginIsACycleThatGainsEnergy)
{
  // Softer exponent with depth: the unloading work grows faster than the loading work does.
  ContactCurve::Table table = SyntheticLaw{}.table();
  for (std::size_t k = 0; k < table.exponent.size(); ++k) {
    table.exponent[k] = k > 100 ? 1.0 : 2.2;
    table.hertz_share[k] = 1;
    table.exponent_slope[k] = table.hertz_share_slope[k] = 0;
    table.residual_ratio[k] = 0;
    table.residual_ratio_slope[k] = 0;
  }
  const ContactCurve curve(table, "test");
  ASSERT_LT(curve.admissibility_margin(), 0);
  const double s = curve.table().s_end / 128, low = std::pow(100 * s, 4), high = std::pow(101 * s, 4);
  testing::Path path(curve);
  path.move(low);
  path.move(0);
  const double first = path.work();
  path.move(high);  // reloading to low, then a little further
  path.move(0);
  EXPECT_LT(path.work() - first, 0)
      << "loading a little further and taking it off again gives energy out of nothing";
}

TEST(Admissibility, SeesAJumpAtTheOnset)
{
  ContactCurve::Table table = SyntheticLaw{}.table();
  for (double& n : table.exponent) n -= 0.4;  // more work back than was put in, right after the onset
  EXPECT_LT(ContactCurve(table, "test").admissibility_margin(), 0);
}

}  // namespace
}  // namespace granulaw
