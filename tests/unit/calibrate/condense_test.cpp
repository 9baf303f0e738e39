#include "calibrate/condense.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "calibrate/kind/kind.hpp"

namespace granulaw::condense_test {

/// x^1.5 to 1 with an unloading to 0.8 by (x - 0.8)^1.5, `rows` each.
Measurement curve(int rows)
{
  Measurement m;
  m.kind = &kind_named("platens", "test");
  const auto add = [&](double x, double y) {
    m.data.push_back({x, y, 0, static_cast<int>(m.data.size()) + 2});
  };
  for (int k = 0; k <= rows; ++k) add(1.0 * k / rows, std::pow(1.0 * k / rows, 1.5));
  for (int k = rows - 1; k >= 0; --k) add(0.8 + 0.2 * k / rows, std::pow(1.0 * k / rows, 1.5));
  return m;
}

TEST(Condense, TheNumberOfDataIsBounded)
{
  Measurement coarse = curve(10), dense = curve(2000), denser = curve(10000);
  for (Measurement* m : {&coarse, &dense, &denser}) condense(*m);
  EXPECT_EQ(coarse.data.size(), 21u);
  // 100 of the loading, ln 1000 over 0.1 of the unloading at most, and the rows about the reversal
  EXPECT_LT(dense.data.size(), 180u);
  EXPECT_NEAR(static_cast<double>(denser.data.size()), static_cast<double>(dense.data.size()), 10);
  int rows = 0;
  for (const Datum& d : denser.data) {
    rows += d.rows;
    // a mean over 0.01 departs from x^1.5 by 3/4 x^-0.5 0.01^2/24
    if (d.line <= 10002 && d.x > 0.05) {
      EXPECT_NEAR(d.y, std::pow(d.x, 1.5), 1.5e-5);
    }
  }
  EXPECT_EQ(rows, 20001);
}

TEST(Condense, RowsAtRestAreOneDatum)
{
  Measurement m = curve(200);
  const Datum top = m.data[200];
  m.data.insert(m.data.begin() + 200, 5000, top);
  condense(m);
  EXPECT_LT(m.data.size(), 180u);
  EXPECT_EQ(m.unloadings().front().gap, 0);
}

TEST(Condense, StatedNoiseAveragesDown)
{
  Measurement m = curve(2000);
  for (Datum& d : m.data) d.sd = 0.1;
  condense(m);
  for (const Datum& d : m.data) EXPECT_DOUBLE_EQ(d.sd, 0.1 / std::sqrt(d.rows));
}

}  // namespace granulaw::condense_test
