// Identities that hold to rounding, whatever the resolution.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "references.hpp"
#include "solver/body/kernels.hpp"
#include "solver/grid/mapped_body.hpp"

namespace granulaw::identities_test {

constexpr Moduli elastic{0.35, 0.76, 0.0, 0.0, false};
constexpr Moduli plastic{0.35, 0.76, 0.01, 0.02, true};

Body sphere(const Moduli& m, int cells = 12)
{
  return mapped_body(MappedGrid::build(cells, 0.3, true), {m}, 0.05 * m.shear);
}

TEST(Grid, FillsTheSphere)
{
  const MappedGrid grid = MappedGrid::build(16, 0.3, true);
  for (const int i : grid.surface) {
    const auto& n = grid.nodes[static_cast<std::size_t>(i)];
    EXPECT_NEAR(n.r * n.r + (n.z - 1) * (n.z - 1), 1.0, 1e-14);  // on the true sphere, to rounding
  }
  const auto deficit = [](int cells) {
    const Body body = mapped_body(MappedGrid::build(cells, 0.3, true), {elastic}, 0);
    double volume = 0;
    for (const double v : body.reference().volume_p) volume += v;
    return 1 - volume / (4.0 / 3.0 * M_PI);
  };
  // chords instead of arcs: the deficit falls with the square of the cell size
  EXPECT_GT(deficit(16), 0);
  EXPECT_GT(deficit(16) / deficit(32),
            3.0);  // 4 but that ring counts are whole numbers: the grids are not similar
  const Body b = mapped_body(grid, {elastic}, 0);
  double mass = 0;
  for (const double m : b.reference().mass_i) mass += m;
  EXPECT_NEAR(mass, 4.0 / 3.0 * M_PI, 1e-12);
}

/// A linear displacement field gives the same gradient at every point; here through the stored energy, which
/// is the same function of the strain everywhere.
TEST(PatchTest, LinearFieldIsExact)
{
  Body b = sphere(elastic);
  const double er = 0.01, ez = -0.02;
  for (int i = 0; i < b.nodes(); ++i) {
    b.u_i(i, 0) = er * b.reference().place_i(i, 0);
    b.u_i(i, 1) = ez * b.reference().place_i(i, 1);
  }
  kernels(b).points_to_grid(b);
  const double lr = std::log(1 + er), lz = std::log(1 + ez), trace = 2 * lr + lz;
  const double deviator2 = 2 * (lr - trace / 3) * (lr - trace / 3) + (lz - trace / 3) * (lz - trace / 3);
  const double expected = elastic.shear * deviator2 + 0.5 * elastic.bulk * trace * trace;
  for (int p = 0; p < b.points(); ++p)
    EXPECT_NEAR(b.state.elastic_energy_p[p] / b.reference().volume_p[p], expected,
                1e-12 * expected + 1e-18);  // rounding of u ~ 1e-2
}

/// Uniform pressure is in equilibrium at every inner node: the discrete divergence theorem.
TEST(PatchTest, UniformPressureIsInEquilibrium)
{
  Body b = sphere(elastic);
  for (int i = 0; i < b.nodes(); ++i)
    b.u_i(i, 0) = -0.01 * b.reference().place_i(i, 0), b.u_i(i, 1) = -0.01 * b.reference().place_i(i, 1);
  kernels(b).points_to_grid(b);
  for (int i = 0; i < b.nodes(); ++i) {
    const double distance = std::hypot(b.reference().place_i(i, 0), b.reference().place_i(i, 1) - 1);
    if (distance > 1 - 1e-9) continue;
    EXPECT_NEAR(b.f_i(i, 1), 0.0, 1e-13);  // forces are of order pressure x cell face = 1e-2 x 1e-2
    if (b.reference().place_i(i, 0) > 0) {
      EXPECT_NEAR(b.f_i(i, 0), 0.0, 1e-13);
    }
  }
}

/// Internal forces cannot change the momentum along the axis, whatever the displacements.
TEST(Momentum, InternalForcesSumToZero)
{
  Body b = sphere(plastic);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-1e-4, 1e-4);
  for (int i = 0; i < b.nodes(); ++i)
    b.u_i(i, 0) = b.reference().place_i(i, 0) > 0 ? jitter(random) : 0, b.u_i(i, 1) = jitter(random);
  kernels(b).points_to_grid(b);
  double sum = 0, scale = 0;
  for (int i = 0; i < b.nodes(); ++i) sum += b.f_i(i, 1), scale += std::abs(b.f_i(i, 1));
  EXPECT_LT(std::abs(sum), 1e-13 * scale);  // rounding of some hundred terms
}

/// A rigid rotation of the section is not a motion of an axisymmetric body; a rigid shift along the axis is.
TEST(Frame, ShiftAlongTheAxisCostsNothing)
{
  Body b = sphere(elastic);
  for (int i = 0; i < b.nodes(); ++i) b.u_i(i, 1) = 0.37;
  kernels(b).points_to_grid(b);
  for (int i = 0; i < b.nodes(); ++i) EXPECT_NEAR(b.f_i(i, 1), 0.0, 1e-14);
  EXPECT_LT(b.strain_energy(), 1e-25);
}

/// The force is minus the derivative of the stored energy by the node's displacement.
TEST(Energy, ForceIsItsDerivative)
{
  Body b = sphere(elastic, 6);
  for (int i = 0; i < b.nodes(); ++i) {
    b.u_i(i, 0) = 0.01 * std::sin(3 * b.reference().place_i(i, 1)) * b.reference().place_i(i, 0);
    b.u_i(i, 1) = 0.01 * std::cos(2 * b.reference().place_i(i, 0)) * b.reference().place_i(i, 1);
  }
  for (int i = 0; i < b.nodes(); i += 7) {
    constexpr double step = 1e-6;
    const double keep = b.u_i(i, 1);
    b.u_i(i, 1) = keep + step;
    kernels(b).points_to_grid(b);
    const double up = b.strain_energy();
    b.u_i(i, 1) = keep - step;
    kernels(b).points_to_grid(b);
    const double down = b.strain_energy();
    b.u_i(i, 1) = keep;
    kernels(b).points_to_grid(b);
    // central difference: energies ~ 1e-4, so rounding 1e-20/1e-6, truncation step^2 x third derivative ~
    // 1e-12
    EXPECT_NEAR(b.f_i(i, 1), -(up - down) / (2 * step), 1e-9);
  }
}

/// All instruction sets compute the same forces but for the last bits.
TEST(InstructionSets, Agree)
{
  const auto forces = [](InstructionSet set) {
    Body b = sphere(plastic);
    for (int step = 1; step <= 3; ++step) {
      for (int i = 0; i < b.nodes(); ++i)
        b.u_i(i, 1) = -0.01 * step * b.reference().place_i(i, 1) * b.reference().place_i(i, 1);
      kernels(b, set).points_to_grid(b);
    }
    return b.f_i.values;
  };
  const auto expected = forces(InstructionSet::generic);
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    const auto found = forces(InstructionSet::avx2);
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-14);
  }
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    const auto found = forces(InstructionSet::avx512);
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-14);
  }
}

}  // namespace granulaw::identities_test
