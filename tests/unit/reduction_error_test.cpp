// The estimate of what the pair rule costs, against the two-body collisions that were measured
// (tests/validation/pairs.csv, docs/evidence/pairs.md).
#include "atlas/unlike_pair.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace granulaw::reduction_error_test {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// E* given; elastic where e_over_y is 0.
LawMaterial material(double e_star, double e_over_y, double nu, double density)
{
  LawMaterial m;
  m.density = density, m.poisson_ratio = nu, m.youngs_modulus = e_star * (1 - nu * nu);
  if (e_over_y > 0) m.yield_stress = e_star / e_over_y;
  return m;
}

struct Measured
{
  std::string group;
  UnlikePair pair;
  double velocity, force, restitution, solver_force, solver_restitution;
};

/// Impacts of the table; the presses in it have no velocity.
std::vector<Measured> measured_impacts()
{
  std::ifstream file(GRANULAW_SOURCE_DIR "/tests/validation/pairs.csv");
  std::vector<Measured> rows;
  std::string line, cell;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    Measured m;
    std::getline(cells, m.group, ',');
    std::vector<double> n;
    while (std::getline(cells, cell, ',')) n.push_back(std::stod(cell));
    if (m.group == "press") continue;
    m.pair = {material(1, n.at(0), n.at(1), 1), material(n.at(3), n.at(4), n.at(5), n.at(6)), n.at(2)};
    m.velocity = n.at(7) * m.pair.yield_velocity();
    m.force = std::abs(n.at(11)), m.restitution = std::abs(n.at(12));
    m.solver_force = n.at(15), m.solver_restitution = n.at(16);
    rows.push_back(m);
  }
  return rows;
}

TEST(ReductionError, IsBoundedWhereItWasMeasured)
{
  int within = 0, over = 0, mixtures = 0, mixtures_over = 0, blurred = 0;
  std::vector<double> shares;
  for (const Measured& m : measured_impacts()) {
    const ReductionError bound = estimate_reduction_error(m.pair, m.velocity);
    if (!bound.within_measured) continue;
    const bool is_over = m.force > bound.force || m.restitution > bound.restitution;
    ++within, over += is_over;
    mixtures += m.group == "mixture", mixtures_over += m.group == "mixture" && is_over;
    blurred += m.solver_force > 0.5 * bound.force || m.solver_restitution > 0.5 * bound.restitution;
    shares.push_back(std::max(m.force / bound.force, m.restitution / bound.restitution));
    EXPECT_LT(m.force, 2 * bound.force) << m.group;  // never off by more than twice
    EXPECT_LT(m.restitution, 2 * bound.restitution) << m.group;
  }
  ASSERT_GT(within, 60);           // the table was found, and most of it counts
  EXPECT_LE(over, 0.05 * within);  // the promise of the header
  // random materials and radii took no part in choosing the coefficients
  EXPECT_GE(mixtures, 10);
  EXPECT_EQ(mixtures_over, 0);
  // the rule's error, not the solver's: what the solver leaves open is far below the bound
  EXPECT_LE(blurred, 0.05 * within);
  // and no empty bound: half of the errors are over a quarter of it ("typically a third")
  std::nth_element(shares.begin(), shares.begin() + shares.size() / 2, shares.end());
  EXPECT_GT(shares[shares.size() / 2], 0.25);
}

/// A pair's own law, made at equal radii, at others (tests/validation/pair_law_radii.csv): what `mpm table
/// --radius-ratio` states of it.
TEST(ReductionError, OfALawOfEqualRadiiIsBoundedAtOthers)
{
  const auto soft = [] {
    LawMaterial m = material(1, 0, 0.3, 1000);
    m.youngs_modulus = 1e9, m.yield_stress = 1.0989e7;
    return m;
  }();
  struct Row
  {
    double restitution, force, solver;  // rule over two bodies
  };
  std::map<std::string, Row> equal;  // by damage number and partner
  std::ifstream file(GRANULAW_SOURCE_DIR "/tests/validation/pair_law_radii.csv");
  std::string line, damage_number, partner, cell;
  std::getline(file, line);
  int count = 0, over = 0;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::getline(cells, damage_number, ','), std::getline(cells, partner, ',');
    std::vector<double> n;
    while (std::getline(cells, cell, ',')) n.push_back(std::stod(cell));
    const Row row{n.at(2) / n.at(3), n.at(4) / n.at(5), n.at(6)};
    if (n.at(0) == 1) {
      equal[damage_number + partner] = row;
      continue;
    }
    const Row& at_equal = equal.at(damage_number + partner);
    LawMaterial other = soft;
    other.name = partner, other.yield_stress = infinity;
    if (partner == "harder") other.yield_stress = 1.5 * soft.yield_stress;
    if (partner == "stiff") other.youngs_modulus = 1e10, other.density = 5200;
    const ReductionError bound = estimate_remaining_error({soft, other, n.at(0)}, 1, n.at(1));
    const double solver = 2 * (row.solver + at_equal.solver);  // the tool's estimate of each run, twice
    const double force = std::abs(row.force / at_equal.force - 1),
                 restitution = std::abs(row.restitution / at_equal.restitution - 1);
    ++count;
    over += force > bound.force + solver || restitution > bound.restitution + solver;
    EXPECT_LT(force, 2 * bound.force + solver);  // never off by more than twice
    EXPECT_LT(restitution, 2 * bound.restitution + solver);
  }
  ASSERT_GE(count, 24);
  EXPECT_LE(over, 0.05 * count);  // the promise of the header
}

TEST(ReductionError, IsTheFloorWhereTheRuleIsExact)
{
  const LawMaterial powder = material(1e9, 100, 0.3, 1500);
  const UnlikePair like{powder, powder, 1};
  const ReductionError none = estimate_reduction_error(like, 20 * like.yield_velocity());
  EXPECT_NEAR(none.force, 0.002, 1e-12);
  EXPECT_NEAR(none.restitution, 0.002, 1e-12);
  // a rigid wall: what is left of a partner a million times as stiff
  const UnlikePair wall{powder, material(1e15, 0, 0.3, 1500e6), infinity};
  const ReductionError rigid = estimate_reduction_error(wall, 20 * wall.yield_velocity());
  EXPECT_NEAR(rigid.force, 0.002, 1e-4);
  EXPECT_NEAR(rigid.restitution, 0.002, 1e-4);
  EXPECT_TRUE(rigid.within_measured);
}

TEST(ReductionError, GrowsWithVelocityAndSaysWhereItEnds)
{
  const LawMaterial powder = material(1e9, 100, 0.3, 1500);
  const UnlikePair pair{powder, material(3e9, 50, 0.2, 2500), 3};
  ReductionError before;
  for (const double damage_number : {1e-6, 1e-5, 1e-4, 1e-3, 2e-3}) {
    const double v = fastest_of_law(pair, damage_number);
    EXPECT_NEAR(v * v * pair.yielding.density * pair.one_body_density() / pair.yielding.yield_stress,
                damage_number, 1e-12 * damage_number);
    const ReductionError now = estimate_reduction_error(pair, v);
    EXPECT_GT(now.force, before.force);
    EXPECT_GT(now.restitution, before.restitution);
    EXPECT_TRUE(now.within_measured);
    before = now;
  }
  EXPECT_FALSE(estimate_reduction_error(pair, fastest_of_law(pair, 0.01)).within_measured);
  EXPECT_FALSE(estimate_reduction_error({powder, powder, 20}, 1e-3).within_measured);
  EXPECT_FALSE(estimate_reduction_error({powder, material(1e8, 0, 0.3, 1500), 1}, 1e-3).within_measured);
}

}  // namespace granulaw::reduction_error_test
