// The fields that are written for looking at: they must be the kernel's own, and looking must change nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/larger.hpp"
#include "solver/body/kernels.hpp"
#include "solver/grid/mapped_body.hpp"
#include "solver/runs.hpp"

namespace granulaw::fields_test {

/// A body that has yielded in several steps, after internal_force; no hourglass control, so that the stress
/// is all there is in forces and energies.
Body deformed(const Moduli& m)
{
  Body b = mapped_body(MappedGrid::build(8, 0.3, true), {m}, 0.0);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> jitter(-1e-4, 1e-4);
  for (int step = 1; step <= 4; ++step) {
    for (int i = 0; i < b.nodes(); ++i) {
      b.u_i(i, 0) = b.reference().place_i(i, 0) *
                    (0.01 * step * std::sin(2 * b.reference().place_i(i, 1)) + jitter(random));
      b.u_i(i, 1) = -0.02 * step * b.reference().place_i(i, 1) * b.reference().place_i(i, 1) +
                    0.01 * step * b.reference().place_i(i, 0) * b.reference().place_i(i, 0) + jitter(random);
    }
    kernels(b).points_to_grid(b);
  }
  return b;
}

class Stress : public testing::TestWithParam<Moduli>
{
};

/// Internal forces summed from the Cauchy stress, f = -V J sigma F^-T b, are the kernel's; so is the stored
/// energy, V (dev(tau)^2/(4 G) + p_tau^2/(2 K)).
TEST_P(Stress, GivesTheKernelsForcesAndEnergies)
{
  const Moduli m = GetParam();
  Body b = deformed(m);
  std::vector<CauchyStress> stress(std::size_t(b.points()));
  kernels(b).stress(b, stress.data());
  std::vector<double> fr(b.nodes(), 0.0), fz(b.nodes(), 0.0);
  double largest = 0, energy = 0;
  for (int p = 0; p < b.points(); ++p) {
    double hrr = 0, hrz = 0, hzr = 0, hzz = 0, hhh = 0;
    for (int k = 0; k < 4; ++k) {
      const std::size_t at = std::size_t(k) * b.points() + p;
      const int i = b.reference().corners.node[at];
      hrr += b.reference().corners.full.br[at] * b.u_i(i, 0),
          hrz += b.reference().corners.full.bz[at] * b.u_i(i, 0);
      hzr += b.reference().corners.full.br[at] * b.u_i(i, 1),
          hzz += b.reference().corners.full.bz[at] * b.u_i(i, 1);
      hhh += b.reference().corners.full.bh[at] * b.u_i(i, 0);
    }
    const double det = (1 + hrr) * (1 + hzz) - hrz * hzr, j = det * (1 + hhh);
    const CauchyStress& s = stress[p];
    // F^-T
    const double irr = (1 + hzz) / det, irz = -hzr / det, izr = -hrz / det, izz = (1 + hrr) / det;
    for (int k = 0; k < 4; ++k) {
      const std::size_t at = std::size_t(k) * b.points() + p;
      const int i = b.reference().corners.node[at];
      const double gr = irr * b.reference().corners.full.br[at] + irz * b.reference().corners.full.bz[at],
                   gz = izr * b.reference().corners.full.br[at] + izz * b.reference().corners.full.bz[at];
      fr[i] -= b.reference().volume_p[p] * j *
               (s.xx * gr + s.xz * gz + s.yy * b.reference().corners.full.bh[at] / (1 + hhh));
      fz[i] -= b.reference().volume_p[p] * j * (s.xz * gr + s.zz * gz);
    }
    const double q = j * s.von_mises(), pressure = j * s.pressure();
    const double stored =
        b.reference().volume_p[p] * (q * q / (6 * m.shear) + 0.5 * pressure * pressure / m.bulk);
    // the kernel's plastic flow uses a Taylor series of exp, good to some 1e-10 at steps as long as here
    EXPECT_NEAR(stored, b.state.elastic_energy_p[p], 1e-8 * b.state.elastic_energy_p[p] + 1e-18);
    energy += stored;
    if (m.yields && b.state.plastic_strain_p[p] > 0) {
      EXPECT_LT(s.von_mises(), (m.yield + m.hardening * b.state.plastic_strain_p[p]) * (1 + 1e-8));
    }
  }
  for (int i = 0; i < b.nodes(); ++i)
    largest = larger(largest, larger(std::abs(b.f_i(i, 0)), std::abs(b.f_i(i, 1))));
  for (int i = 0; i < b.nodes(); ++i) {
    EXPECT_NEAR(fr[i], b.f_i(i, 0), 1e-8 * largest);
    EXPECT_NEAR(fz[i], b.f_i(i, 1), 1e-8 * largest);
  }
  EXPECT_GT(energy, 0);
  if (m.yields) {
    EXPECT_GT(b.plastic_work(), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Moduli, Stress,
                         testing::Values(Moduli{0.35, 0.76, 0.0, 0.0, false},
                                         Moduli{0.35, 0.76, 0.01, 0.0, true},
                                         Moduli{0.35, 0.76, 0.01, 0.02, true}));

const Particle powder = Particle::sphere(1e-3, {1500, 9.1e9, 0.3, 100e6});

/// Frames are in SI and hold what they say; the run is the same, bit for bit, whether anyone looks or not.
TEST(Fields, LookingChangesNothing)
{
  RunOptions options;
  options.resolution = 8, options.shifted_grids = 2;
  const RunResult blind = impact(powder, {2.6}, {}, options);
  std::vector<FieldFrame> frames;
  int nodes = 0, cells = 0, begun = 0;
  options.fields.frames = 20;
  options.fields.begin = [&](int n, const std::vector<std::array<int, 4>>& c) {
    nodes = n, cells = int(c.size()), ++begun;
  };
  options.fields.frame = [&](const FieldFrame& f) { frames.push_back(f); };
  const RunResult seen = impact(powder, {2.6}, {}, options);
  ASSERT_EQ(blind.trace.size(), seen.trace.size());
  for (std::size_t k = 0; k < seen.trace.size(); ++k) {
    EXPECT_EQ(blind.trace[k].force, seen.trace[k].force);
    EXPECT_EQ(blind.trace[k].delta, seen.trace[k].delta);
  }
  EXPECT_EQ(begun, 1);
  EXPECT_EQ(cells, seen.summary.points);
  ASSERT_GT(frames.size(), 10u);  // the duration is only guessed beforehand: 20 is what is aimed at
  EXPECT_LT(frames.size(), 40u);
  EXPECT_EQ(frames.front().time, 0);
  for (std::size_t k = 1; k < frames.size(); ++k) EXPECT_GT(frames[k].time, frames[k - 1].time);
  for (const FieldFrame& f : frames) {
    ASSERT_EQ(int(f.r.size()), nodes);
    ASSERT_EQ(int(f.pressure.size()), cells);
    double lowest = 1, hardest = 0;
    for (const double z : f.z) lowest = std::min(lowest, z);
    for (const double q : f.von_mises) hardest = larger(hardest, q);
    EXPECT_GT(lowest, -1e-15);               // m: nothing below the plane, to rounding of a radius of 1e-3
    EXPECT_LT(hardest, 100e6 * (1 + 1e-8));  // perfectly plastic: nowhere above the yield stress
  }
  EXPECT_DOUBLE_EQ(frames.front().vz.front(), -2.6);  // to solver units and back: rounding
  double deepest = 0, strain = 0;
  for (const FieldFrame& f : frames) deepest = larger(deepest, f.delta);
  for (const double e : frames.back().plastic_strain) strain = larger(strain, e);
  EXPECT_NEAR(deepest, seen.summary.delta_max,
              0.03 * seen.summary.delta_max);  // parabola, 1/20 of its width off
  EXPECT_GT(strain, 0.01);
}

class Motion : public testing::TestWithParam<GridKind>
{
};

/// Node by node: places are where they began plus the displacement, and the displacement is the velocity's
/// integral.
TEST_P(Motion, IsTheIntegralOfTheVelocity)
{
  RunOptions options;
  options.resolution = 8, options.shifted_grids = 1, options.grid = GetParam();
  std::vector<FieldFrame> frames;
  options.fields.frames = 1000;
  options.fields.frame = [&](const FieldFrame& f) { frames.push_back(f); };
  impact(powder, {2.6}, {}, options);
  ASSERT_GT(frames.size(), 100u);
  const FieldFrame& first = frames.front();
  const std::size_t nodes = first.r.size();
  for (std::size_t i = 0; i < nodes; ++i) {
    EXPECT_LE(std::hypot(first.r[i], first.z[i] - 1e-3),
              1.03e-3);  // the sphere; pieces at its rim are drawn whole
    EXPECT_EQ(first.ur[i], 0);
    EXPECT_EQ(first.uz[i], 0);
    EXPECT_NEAR(first.vr[i], 0, 1e-12);
    EXPECT_NEAR(first.vz[i], -2.6, 1e-12);  // to solver units and back: rounding
  }
  double largest = 0, worst_r = 0, worst_z = 0, spread = 0;
  std::vector<double> r(nodes, 0.0), z(nodes, 0.0);
  for (std::size_t k = 1; k < frames.size(); ++k) {
    const FieldFrame &a = frames[k - 1], &b = frames[k];
    const double half = 0.5 * (b.time - a.time);
    for (std::size_t i = 0; i < nodes; ++i) {
      r[i] += half * (a.vr[i] + b.vr[i]), z[i] += half * (a.vz[i] + b.vz[i]);
      largest = larger(largest, std::abs(b.uz[i])), spread = larger(spread, std::abs(b.ur[i]));
      worst_r = larger(worst_r, std::abs(b.ur[i] - r[i]));
      worst_z = larger(worst_z, std::abs(b.uz[i] - z[i]));
      EXPECT_NEAR(b.r[i], first.r[i] + b.ur[i], 1e-17);
      EXPECT_NEAR(b.z[i], first.z[i] + b.uz[i], 1e-17);
    }
  }
  // velocities stand half a step beside the places, and cells at the contact swing within a few steps: 5 %
  // found
  EXPECT_LT(worst_r, 0.1 * spread);
  EXPECT_LT(worst_z, 0.1 * largest);
}

INSTANTIATE_TEST_SUITE_P(Grids, Motion, testing::Values(GridKind::mapped, GridKind::rectilinear),
                         [](const auto& grid) {
                           return grid.param == GridKind::mapped ? "mapped" : "rectilinear";
                         });

}  // namespace granulaw::fields_test
