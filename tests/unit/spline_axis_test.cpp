#include "solver/body/spline_axis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace granulaw::spline_axis_test {

SplineAxis uneven()
{
  return SplineAxis({0, 0.1, 0.2, 0.3, 0.32, 0.7, 1.5, 1.6});
}

template <class Field>
double sum(const SplineAxis& axis, const SplineAxis::Values& v, const std::array<double, 3>& weights,
           Field field)
{
  double total = 0;
  for (int k = 0; k < 3; ++k) total += weights[k] * field(axis.node(v.first + k));
  return total;
}

/// Node coordinates reproduce every linear field, on any spacing, up to both ends.
TEST(SplineAxis, ReproducesLinearFields)
{
  const SplineAxis axis = uneven();
  const auto linear = [](double x) { return 3 - 2 * x; };
  for (int k = 0; k <= 1600; ++k) {
    const double x = 1e-3 * k;
    const SplineAxis::Values v = axis.at(x);
    EXPECT_NEAR(sum(axis, v, v.n, linear), linear(x), 1e-14);       // rounding
    EXPECT_NEAR(sum(axis, v, v.dn, linear), -2, 1e-12);             // slopes are up to 2/0.02
    EXPECT_NEAR(v.n[0] + v.n[1] + v.n[2], 1, 1e-15);                // unity
    for (const double n : v.n) EXPECT_GE(n, -1e-15) << "at " << x;  // never negative: lumped masses
  }
}

/// Values and slopes are continuous across the lines, so each function is one spline and not pieces.
TEST(SplineAxis, IsSmoothAcrossLines)
{
  const SplineAxis axis = uneven();
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<double> c(static_cast<std::size_t>(axis.functions()));
  for (double& x : c) x = uniform(random);
  const auto value = [&](double x, bool slope) {
    const SplineAxis::Values v = axis.at(x);
    double total = 0;
    for (int k = 0; k < 3; ++k) total += (slope ? v.dn : v.n)[k] * c[static_cast<std::size_t>(v.first + k)];
    return total;
  };
  for (std::size_t l = 1; l + 1 < axis.lines().size(); ++l) {
    const double x = axis.lines()[l], hair = 1e-9;
    // slopes are up to 200, curvatures up to 2/0.02^2 = 5000
    EXPECT_NEAR(value(x - hair, false), value(x + hair, false), 1e-6);
    EXPECT_NEAR(value(x - hair, true), value(x + hair, true), 1e-4);
  }
  for (double x = 0.013; x < 1.6;
       x += 0.0373)  // slopes are the derivative: exact for parabolas within a cell
    if (axis.cell(x - 1e-5) == axis.cell(x + 1e-5)) {
      EXPECT_NEAR((value(x + 1e-5, false) - value(x - 1e-5, false)) / 2e-5, value(x, true), 1e-9);
    }
}

TEST(SplineAxis, FindsTheCell)
{
  const SplineAxis axis = uneven();
  for (double x = 0.0005; x < 1.6; x += 0.001) {
    const auto c = static_cast<std::size_t>(axis.cell(x));
    EXPECT_GE(x, axis.lines()[c]);
    EXPECT_LT(x, axis.lines()[c + 1]);
  }
  EXPECT_EQ(axis.cell(-1), 0);
  EXPECT_EQ(axis.cell(9), axis.cells() - 1);
}

TEST(GradedLines, AreFineThenGrowToTheEnd)
{
  for (const double shift : {0.0, 0.25, -0.375}) {
    const std::vector<double> lines = graded_lines(0, 0.3, 2, 0.02, 1.15, 0.15, shift);
    EXPECT_EQ(lines.front(), 0);
    EXPECT_NEAR(lines.back(), 2, 1e-12);
    EXPECT_NEAR(lines[1], (1 - shift) * 0.02, 1e-15);
    double step = 0.02;
    for (std::size_t k = 2; k < lines.size(); ++k) {
      const double next = lines[k] - lines[k - 1];
      EXPECT_GT(next,
                0.7 * step);  // the last steps are scaled or squeezed to fit, all alike: one step's share
      EXPECT_LT(next, 1.5 * step);
      if (lines[k] <= 0.3) {
        EXPECT_NEAR(next, 0.02, 1e-14);
      }
      step = next;
    }
  }
}

}  // namespace granulaw::spline_axis_test
