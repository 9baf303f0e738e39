// The pressure under an elastic sphere, p = p0 sqrt(1 - (r/a)^2), with a and p0 from the force: nothing is
// fitted. Pictures: docs/evidence/verification.md.
#include <gtest/gtest.h>

#include <cmath>

#include "base/larger.hpp"
#include "convergence.hpp"
#include "elastic_press.hpp"

namespace granulaw::verification::hertz_test {

struct Deviation
{
  double rms, largest;  // over p0, inside r < 0.9 a
};

/// From `theory(r/a)`, in units of p0.
template <class Theory>
Deviation deviation(const PressedSphere& s, Theory theory)
{
  std::vector<double> all;
  double largest = 0;
  for (const PressurePoint& p : contact_pressure(s)) {
    if (p.r_over_a > 0.9) continue;
    all.push_back(p.pressure - theory(p.r_over_a));
    largest = larger(largest, std::abs(all.back()));
  }
  EXPECT_GT(all.size(), 7u);  // a profile, not a few cells
  return {root_mean_square(all), largest};
}

Deviation from_moved_surface(const PressedSphere& s)
{
  return deviation(s, [&](double x) { return hertz::pressure_on_moved_surface(x, s.nu, s.contact.p0); });
}

/// At 5e-4 R Hertz's own error, the excess (2/pi) (1 - 2 nu)/(1 - nu) a/R in the middle, is 0.8 % of p0;
/// cells of a/18 add as much near the edge, where the pressure falls by 2 p0 in one a. RMS: half of that.
TEST(Hertz, PressureDistribution)
{
  const PressedSphere s = press_elastic(0.3, 5e-4, 24);
  const Deviation d = deviation(s, hertz::pressure);
  std::printf("deviation from Hertz, of p0, r < 0.9 a: rms %.4f, largest %.4f\n", d.rms, d.largest);
  EXPECT_LT(d.rms, 0.008);      // measured 0.0045
  EXPECT_LT(d.largest, 0.016);  // measured 0.008
  // Outside there is no contact; the cell across the edge may carry a little.
  for (const PressurePoint& p : contact_pressure(s))
    if (p.r_over_a > 1.06) {
      EXPECT_LT(std::abs(p.pressure), 0.02) << p.r_over_a;
    }
}

/// With the inward motion of the surface taken into account the theory holds at larger depth and for every
/// nu, and what is left is the cells' second order: rms 0.0058, 0.0026, 0.0015 of p0 with 16, 24, 32 cells.
TEST(Hertz, PressureOnTheMovedSurface)
{
  for (const double nu : {0.0, 0.3, 0.45}) {
    const PressedSphere s = press_elastic(nu, 2e-3, 20);
    const Deviation d = from_moved_surface(s);
    std::printf("nu %.2f: rms %.4f, largest %.4f; the surface's motion, in the middle: %.4f\n", nu, d.rms,
                d.largest, (1 - 2 * nu) / (1 - nu) * s.contact.p0);
    EXPECT_LT(d.rms, 0.006);      // measured 0.004: between those of 16 and 24 cells
    EXPECT_LT(d.largest, 0.015);  // at the edge: measured 0.009
  }
}

TEST(Hertz, PressureConverges)
{
  const std::vector<int> cells{12, 14, 16, 18, 20, 24};
  std::vector<double> errors;
  for (const int n : cells) errors.push_back(from_moved_surface(press_elastic(0.3, 4e-3, n)).rms);
  const Order order = fit_order(cells, errors);
  std::printf("order %.2f +- %.2f\n", order.p, order.standard_error);
  EXPECT_GT(order.p, 1.5);  // two, but that the edge lies anywhere in its cell
}

/// The pressure, summed over the contact, is the force that the plane gives: the same number from the
/// stresses of the surface cells as from the impulses at the nodes. Both ends of a cell are at rest on the
/// plane, so what remains is the edge's cell and the second order in the cell size.
TEST(Hertz, PressureSumsToTheForce)
{
  const PressedSphere s = press_elastic(0.3, 1e-3, 16);
  const auto profile = contact_pressure(s);
  double sum = 0;
  double inner = 0;
  for (std::size_t k = 0; k + 1 < profile.size(); ++k) {
    const double outer = 0.5 * (profile[k].r_over_a + profile[k + 1].r_over_a);
    sum += profile[k].pressure * M_PI * (outer * outer - inner * inner);
    inner = outer;
  }
  // Hertz: the mean pressure is 2/3 p0. Half a cell's ring at the edge, 0.04 a, at p/p0 below 0.3: 1 to 2 %
  EXPECT_NEAR(sum / (2.0 / 3.0 * M_PI), 1.0, 0.015);
}

/// Hertz is the limit of small contacts: his error is proportional to a/R, so from two depths, one four times
/// the other, the limit follows; and its fraction is the one that the surface's motion predicts.
TEST(HertzSlow, SmallContactLimit)
{
  const PressedSphere shallow = press_elastic(0.3, 5e-4, 32), deep = press_elastic(0.3, 2e-3, 32);
  const double e1 = centre_excess(shallow), e2 = centre_excess(deep);
  const double predicted = 0.4 / 0.7 * (deep.contact.p0 - shallow.contact.p0);
  std::printf("pressure in the middle over p0, less one: %.4f at 5e-4 R, %.4f at 2e-3 R\n", e1, e2);
  EXPECT_NEAR(2 * e1 - e2, 0.0, 0.004);           // measured -0.002: cells of a/25
  EXPECT_NEAR((e2 - e1) / predicted, 1.0, 0.15);  // measured 0.98; second order in a/R
}

}  // namespace granulaw::verification::hertz_test
