// Momentum and energy of a whole impact, audited from what the solver writes. Pictures:
// docs/evidence/verification.md.
#include <gtest/gtest.h>

#include <cmath>

#include "base/larger.hpp"
#include "convergence.hpp"
#include "energy_audit.hpp"

namespace granulaw::verification::balance_test {

/// The impulse of the force in the trace is the change of momentum m V (1 + e): nothing else acts on the
/// body.
TEST(Balance, ImpulseIsTheChangeOfMomentum)
{
  for (const Job& job : {elastic_impact(), plastic_impact()}) {
    RunOptions options;
    options.resolution = 12, options.shifted_grids = 1;
    const RunResult r = impact(job.sphere, {job.velocity}, {}, options);
    const double change = 4.0 / 3.0 * M_PI * job.velocity * (1 + r.summary.restitution_raw);
    EXPECT_NEAR(impulse(r.trace) / change, 1, 1e-12) << job.name;  // rounding of 1e4 steps; measured 2e-15
  }
}

/// Kinetic, elastic and plastic energy, each from the written fields, add up to what came in, at every
/// moment. What is missing is in the hourglass control, and in the half step between velocities and
/// displacements.
TEST(Balance, EnergyAddsUpFromTheFields)
{
  const Job job = plastic_impact();
  const auto largest_gap = [&](int cells) {
    double gap = 0;
    for (const EnergyShares& s : energy_audit(job.sphere, job.velocity, cells, 200))
      gap = larger(gap, std::abs(s.total() - 1));
    return gap;
  };
  const double coarse = largest_gap(8), fine = largest_gap(16);
  std::printf("largest gap: %.4f at 8 cells, %.4f at 16\n", coarse, fine);
  EXPECT_LT(coarse, 0.006);     // measured 0.0037
  EXPECT_LT(fine, coarse / 2);  // measured 1/3: hourglass energy falls with the cells
}

}  // namespace granulaw::verification::balance_test
