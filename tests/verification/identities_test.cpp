// What must hold to rounding, whatever the resolution.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "references.hpp"
#include "solver/grid/mapped_body.hpp"
#include "solver/body/kernels.hpp"

namespace granulaw {
namespace {

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
    for (const double v : body.volume_p) volume += v;
    return 1 - volume / (4.0 / 3.0 * M_PI);
  };
  // chords instead of arcs: the deficit falls with the square of the cell size
  EXPECT_GT(deficit(16), 0);
  EXPECT_GT(deficit(16) / deficit(32),
            3.0);  // 4 but that ring counts are whole numbers: the grids are not similar
  const Body b = mapped_body(grid, {elastic}, 0);
  double mass = 0;
  for (const double m : b.mass_i) mass += m;
  EXPECT_NEAR(mass, 4.0 / 3.0 * M_PI, 1e-12);
}

/// A linear displacement field gives the same gradient at every point; here through the stored energy, which
/// is the same function of the strain everywhere.
TEST(PatchTest, LinearFieldIsExact)
{
  Body b = sphere(elastic);
  const double er = 0.01, ez = -0.02;
  for (int i = 0; i < b.nodes; ++i) {
    b.ur_i[i] = er * b.r_i[i];
    b.uz_i[i] = ez * b.z_i[i];
  }
  kernels().internal_force(b, false);
  const double lr = std::log(1 + er), lz = std::log(1 + ez), trace = 2 * lr + lz;
  const double deviator2 = 2 * (lr - trace / 3) * (lr - trace / 3) + (lz - trace / 3) * (lz - trace / 3);
  const double expected = elastic.shear * deviator2 + 0.5 * elastic.bulk * trace * trace;
  for (int p = 0; p < b.points; ++p)
    EXPECT_NEAR(b.elastic_energy_p[p] / b.volume_p[p], expected,
                1e-12 * expected + 1e-18);  // rounding of u ~ 1e-2
}

/// Uniform pressure is in equilibrium at every inner node: the discrete divergence theorem.
TEST(PatchTest, UniformPressureIsInEquilibrium)
{
  Body b = sphere(elastic);
  for (int i = 0; i < b.nodes; ++i) b.ur_i[i] = -0.01 * b.r_i[i], b.uz_i[i] = -0.01 * b.z_i[i];
  kernels().internal_force(b, false);
  for (int i = 0; i < b.nodes; ++i) {
    const double distance = std::hypot(b.r_i[i], b.z_i[i] - 1);
    if (distance > 1 - 1e-9) continue;
    EXPECT_NEAR(b.fz_i[i], 0.0, 1e-13);  // forces are of order pressure x cell face = 1e-2 x 1e-2
    if (b.r_i[i] > 0) {
      EXPECT_NEAR(b.fr_i[i], 0.0, 1e-13);
    }
  }
}

/// Internal forces cannot change the momentum along the axis, whatever the displacements.
TEST(Momentum, InternalForcesSumToZero)
{
  Body b = sphere(plastic);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-1e-4, 1e-4);
  for (int i = 0; i < b.nodes; ++i) b.ur_i[i] = b.r_i[i] > 0 ? jitter(random) : 0, b.uz_i[i] = jitter(random);
  kernels().internal_force(b, false);
  double sum = 0, scale = 0;
  for (int i = 0; i < b.nodes; ++i) sum += b.fz_i[i], scale += std::abs(b.fz_i[i]);
  EXPECT_LT(std::abs(sum), 1e-13 * scale);  // rounding of some hundred terms
}

/// A rigid rotation of the section is not a motion of an axisymmetric body; a rigid shift along the axis is.
TEST(Frame, ShiftAlongTheAxisCostsNothing)
{
  Body b = sphere(elastic);
  for (int i = 0; i < b.nodes; ++i) b.uz_i[i] = 0.37;
  kernels().internal_force(b, false);
  for (int i = 0; i < b.nodes; ++i) EXPECT_NEAR(b.fz_i[i], 0.0, 1e-14);
  EXPECT_LT(b.strain_energy(), 1e-25);
}

/// The force is minus the derivative of the stored energy by the node's displacement.
TEST(Energy, ForceIsItsDerivative)
{
  Body b = sphere(elastic, 6);
  for (int i = 0; i < b.nodes; ++i) {
    b.ur_i[i] = 0.01 * std::sin(3 * b.z_i[i]) * b.r_i[i];
    b.uz_i[i] = 0.01 * std::cos(2 * b.r_i[i]) * b.z_i[i];
  }
  for (int i = 0; i < b.nodes; i += 7) {
    constexpr double step = 1e-6;
    const double keep = b.uz_i[i];
    b.uz_i[i] = keep + step;
    kernels().internal_force(b, false);
    const double up = b.strain_energy();
    b.uz_i[i] = keep - step;
    kernels().internal_force(b, false);
    const double down = b.strain_energy();
    b.uz_i[i] = keep;
    kernels().internal_force(b, false);
    // central difference: energies ~ 1e-4, so rounding 1e-20/1e-6, truncation step^2 x third derivative ~
    // 1e-12
    EXPECT_NEAR(b.fz_i[i], -(up - down) / (2 * step), 1e-9);
  }
}

/// All instruction sets compute the same forces but for the last bits.
TEST(InstructionSets, Agree)
{
  const auto forces = [](const Kernels& k) {
    Body b = sphere(plastic);
    for (int step = 1; step <= 3; ++step) {
      for (int i = 0; i < b.nodes; ++i) b.uz_i[i] = -0.01 * step * b.z_i[i] * b.z_i[i];
      k.internal_force(b, false);
    }
    return b.fz_i;
  };
  const auto expected = forces(isa_generic::kernels);
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
    const auto found = forces(isa_avx2::kernels);
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-14);
  }
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl")) {
    const auto found = forces(isa_avx512::kernels);
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-14);
  }
}

}  // namespace
}  // namespace granulaw
