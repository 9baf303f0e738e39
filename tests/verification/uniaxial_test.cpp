// Stress-strain curve of every flow law under uniaxial compression. Pictures: docs/evidence/verification.md.
#include "uniaxial.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace granulaw::verification::uniaxial_test {

/// Rate-independent laws: the curve is the equation's at every point, whatever the steps.
TEST(Uniaxial, HardeningLaws)
{
  for (const WrittenLaw& law : hardening_laws_written_out())
    for (const int steps : {50, 400})
      for (const StressStrain& p : compress(law.material, 1.0, steps)) {
        const StressStrain e = exact(law, p.strain);
        // strains of order 1 rounded in 400 steps, times E/Y = 91; measured 9e-14
        ASSERT_NEAR(p.stress / law.stress(0), e.stress / law.stress(0), 1e-11) << law.name << " " << p.strain;
        ASSERT_NEAR(p.plastic_strain, e.plastic_strain, 1e-12) << law.name << " " << p.strain;
      }
}

/// Rate-dependent laws: the kernel takes the rate as increment over step (backward Euler), so the error is of
/// first order in the step, and small at steps of 1e-3 of strain: in a run they are 1e-4 and less.
TEST(Uniaxial, RateLaws)
{
  constexpr double last = 0.05;
  for (const WrittenLaw& law : rate_laws_written_out())
    for (const double rate : {1e-3, 1e-2, 1e-1}) {
      const double stress = exact(law, last, rate).stress;
      const double whole = std::abs(compress(law.material, last, 50, rate).back().stress / stress - 1);
      const double half = std::abs(compress(law.material, last, 100, rate).back().stress / stress - 1);
      EXPECT_LT(whole, 2e-4) << law.name << " " << rate;  // measured up to 8.5e-5
      EXPECT_NEAR(half / whole, 0.5, 0.1) << law.name << " " << rate;
    }
}

}  // namespace granulaw::verification::uniaxial_test
