#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "synthetic_law.hpp"

namespace granulaw {
namespace {

using testing::SyntheticLaw;

const PairMapping unit_pair = PairMapping::rigid_partner(0.75);

/// Work done on the contact from overlap `from` to `to`, whose largest overlap so far is `x_m` (updated), by
/// Simpson's rule in s = x^(1/4) over `pieces`.
double work_done(const ContactCurve& curve, double from, double to, double& x_m, int pieces = 400)
{
  double work = 0;
  const double a = std::pow(from, 0.25), b = std::pow(to, 0.25), h = (b - a) / pieces;
  const double reached = x_m;
  const auto integrand = [&](double s) {
    const double x = s * s * s * s;
    // x_m only matters on the way down or below it: on the way up beyond it, evaluate() is on the loading
    // curve
    return 4 * s * s * s * (x > 0 ? curve.evaluate(unit_pair, 1.0, x, reached).force : 0.0);
  };
  for (int k = 0; k < pieces; ++k)
    work += h / 6 * (integrand(a + k * h) + 4 * integrand(a + (k + 0.5) * h) + integrand(a + (k + 1) * h));
  x_m = std::max(x_m, to);
  return work;
}

RC_GTEST_PROP(Admissibility, NoClosedCycleGainsEnergy, ())
{
  SyntheticLaw law;
  law.softening = *rc::gen::inRange(50, 250) / 100.0;
  law.depth = *rc::gen::inRange(20, 200) / 100.0;
  law.bend = *rc::gen::inRange(-20, 20) / 100.0;
  law.onset = std::pow(10.0, -*rc::gen::inRange(200, 600) / 100.0);
  const ContactCurve curve = law.curve();
  RC_PRE(curve.admissibility_margin() >= 0);

  double x = 0, x_m = 0, work = 0;
  const int turns = *rc::gen::inRange(2, 12);
  for (int k = 0; k < turns; ++k) {
    const double s = curve.table().s_end * *rc::gen::inRange(1, 1000) / 1000.0, next = s * s * s * s;
    work += work_done(curve, x, next, x_m);
    x = next;
  }
  work += work_done(curve, x, 0.0, x_m);
  // Simpson at the kinks u = 0 and x = x_m of the path: 1e-4 of the largest loading work
  RC_ASSERT(work >= -1e-4 * curve.work_loading(x_m));
}

TEST(Admissibility, ANegativeMarginIsACycleThatGainsEnergy)
{
  // Softer exponent with depth: the unloading work grows faster than the loading work does.
  ContactCurve::Table table = SyntheticLaw{}.table();
  for (std::size_t k = 0; k < table.exponent.size(); ++k) {
    table.exponent[k] = k > 100 ? 1.0 : 3.0;
    table.exponent_slope[k] = 0;
    table.residual_ratio[k] = 0;
    table.residual_ratio_slope[k] = 0;
  }
  const ContactCurve curve(table, "test");
  ASSERT_LT(curve.admissibility_margin(), 0);
  const double s = curve.table().s_end / 128, low = std::pow(100 * s, 4), high = std::pow(101 * s, 4);
  double x_m = 0, first = 0, second = 0;
  first += work_done(curve, 0, low, x_m);
  first += work_done(curve, low, 0, x_m);
  second += work_done(curve, 0, low, x_m);  // on the reloading curve
  second += work_done(curve, low, high, x_m);
  second += work_done(curve, high, 0, x_m);
  EXPECT_LT(second, 0) << "loading a little further and taking it off again gives energy out of nothing";
}

TEST(Admissibility, SeesAJumpAtTheOnset)
{
  ContactCurve::Table table = SyntheticLaw{}.table();
  for (double& n : table.exponent) n -= 0.4;  // more work back than was put in, right after the onset
  EXPECT_LT(ContactCurve(table, "test").admissibility_margin(), 0);
}

}  // namespace
}  // namespace granulaw
