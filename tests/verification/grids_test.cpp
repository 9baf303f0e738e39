// The grids `rectilinear` and `updated`: what must hold to rounding, what must converge, and that all three
// grids find the same contact.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/larger.hpp"
#include "base/scales.hpp"
#include "references.hpp"
#include "solver/body/kernels.hpp"
#include "solver/body/updated_points.hpp"
#include "solver/contact/surface.hpp"
#include "solver/grid/rectilinear_body.hpp"
#include "solver/grid/updated_body.hpp"
#include "solver/loading/flight.hpp"
#include "solver/run/grid_noise.hpp"
#include "solver/run/time_step.hpp"
#include "solver/runs.hpp"

namespace granulaw::grids_test {

constexpr Moduli elastic{0.35, 0.76, 0.0, 0.0, false};
constexpr Moduli plastic{0.35, 0.76, 0.01, 0.02, true};

CutSection sphere_section(const Moduli& m, double fine)
{
  CutSection s;
  s.phases = {{m}};
  s.phase_at = [](double r, double z) { return r * r + (z - 1) * (z - 1) <= 1 ? 0 : -1; };
  s.surface_z = [](double r) { return 1 - std::sqrt(std::max(0.0, 1 - r * r)); };
  s.block = 0.3, s.depth = 0.24, s.fine = fine;
  return s;
}

/// Volumes of the cut pieces against closed forms: a sphere with a core and a pore in it.
TEST(CutCells, VolumesConverge)
{
  const auto errors = [](double fine) {
    CutSection s = sphere_section(elastic, fine);
    s.phases = {{elastic}, {elastic, 3}};
    const auto whole = s.phase_at;
    s.phase_at = [whole](double r, double z) {
      if (std::hypot(r, z - 1.5) < 0.2) return -1;          // pore
      return std::hypot(r, z - 1) < 0.6 ? 1 : whole(r, z);  // core
    };
    const SplineAxis r_axis(graded_lines(0, 1, 1, fine, 1.15, 0.15));
    const SplineAxis z_axis(graded_lines(0, 2, 2, fine, 1.15, 0.15));
    std::array<double, 2> volume{}, moment{};
    for (const Piece& p : cut_pieces(s, r_axis, z_axis)) {
      volume[p.phase] += p.volume, moment[p.phase] += p.volume * p.z;
      // means of a piece: unity, and its centroid from the node coordinates
      double unity = 0, r = 0, z = 0;
      for (int k = 0; k < 9; ++k) {
        unity += p.n[k];
        r += p.n[k] * r_axis.node(p.r_first + k / 3), z += p.n[k] * z_axis.node(p.z_first + k % 3);
      }
      EXPECT_NEAR(unity, 1, 1e-13);
      EXPECT_NEAR(r, p.r, 1e-13);
      EXPECT_NEAR(z, p.z, 1e-13);
    }
    const auto ball = [](double radius) { return 4.0 / 3.0 * M_PI * radius * radius * radius; };
    // the pore reaches from z = 1.3 to 1.7, across the core's edge at 1.6: the lens of two balls 0.5 apart
    const double a = 0.6, c = 0.2, d = 0.5;
    const double lens =
        M_PI * (a + c - d) * (a + c - d) * (d * d + 2 * d * (a + c) - 3 * (a - c) * (a - c)) / (12 * d);
    return std::array{std::abs(volume[1] / (ball(a) - lens) - 1),
                      std::abs(volume[0] / (ball(1) - ball(a) - (ball(c) - lens)) - 1),
                      std::abs((moment[0] + moment[1]) / (ball(1) - ball(c) * 1.5) - 1)};
  };
  const auto coarse = errors(0.1), fine = errors(0.025);
  // samples lie h/16 apart, and their errors along the cut are random: between h and h^2 (measured: core
  // 5.4e-4 to 1.8e-4, shell 4.5e-4 to 3e-5, moment 4.5e-4 to 2e-5 over a factor 4)
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT(coarse[k], 1e-3);
    EXPECT_LT(fine[k], 2.5e-4);
  }
}

Body updated_sphere(const Moduli& m, double fine = 0.08)
{
  return updated_body(sphere_section(m, fine));
}

/// A flying body keeps its velocity and its shape, however many cells it crosses.
TEST(Updated, FliesFreely)
{
  Scene scene;
  scene.bodies.push_back(updated_sphere(plastic));
  scene.contact = std::make_unique<RowContact>(std::make_unique<Surface>(scene.bodies), sweeps_of_revolution);
  Body& b = scene.bodies.front();
  const MovingPoints before = *b.moving;
  const double v = 0.01, dt = 0.02;
  throw_body(b, {0, 0, v});  // away from the plane
  Flight programme(1);
  constexpr int steps = 500;  // 0.1: more than a cell
  for (int n = 0; n < steps; ++n) EXPECT_EQ(advance(scene, programme, n * dt, dt, dt), 0);
  const MovingPoints& m = *b.moving;
  double worst = 0, worst_stress = 0, worst_place = 0;
  for (int p = 0; p < b.points(); ++p) {
    worst = larger(worst, larger(std::abs(m.vz[p] - v), std::abs(m.vr[p])));
    worst_stress = larger(worst_stress, larger(std::abs(m.tzz[p]), larger(std::abs(m.trr[p]), std::abs(m.trz[p]))));
    worst_place = larger(worst_place, larger(std::abs(m.r[p] - before.r[p]), std::abs(m.z[p] - before.z[p] - v * dt * steps)));
  }
  EXPECT_LT(worst, 1e-12 * v);         // rounding of 500 transfers
  EXPECT_LT(worst_stress, 1e-14 * v);  // of v dt/h in a strain, 500 times at random
  EXPECT_LT(worst_place, 1e-13);
  EXPECT_NEAR(b.travel[2], v * dt * steps, 1e-13);
}

/// Points to grid and back keeps every affine velocity field.
TEST(Updated, AffineMotionIsTransferredExactly)
{
  Body b = updated_sphere(elastic);
  MovingPoints& m = *b.moving;
  const double a = 0.3, c = -0.2, g = 0.1, v = 0.05;
  for (int p = 0; p < b.points(); ++p) {
    m.vr[p] = a * m.r[p], m.vz[p] = v + g * m.r[p] + c * m.z[p];
    m.crr[p] = a, m.crz[p] = 0, m.czr[p] = g, m.czz[p] = c;
  }
  updated_points_to_grid(b);
  for (int i = 0; i < b.nodes(); ++i) {
    if (b.reference().inverse_mass_i(i, 1) == 0) continue;
    EXPECT_NEAR(b.v_i(i, 0), a * b.reference().place_i(i, 0), 1e-12);
    EXPECT_NEAR(b.v_i(i, 1), v + g * b.reference().place_i(i, 0) + c * b.reference().place_i(i, 1), 1e-12);
  }
  updated_grid_to_points(b, 0);
  for (int p = 0; p < b.points(); ++p) {
    EXPECT_NEAR(m.vr[p], a * m.r[p], 1e-12);
    EXPECT_NEAR(m.vz[p], v + g * m.r[p] + c * m.z[p], 1e-12);
    EXPECT_NEAR(m.crr[p], a, 1e-11);
    EXPECT_NEAR(m.crz[p], 0, 1e-11);
    EXPECT_NEAR(m.czr[p], g, 1e-11);
    EXPECT_NEAR(m.czz[p], c, 1e-11);
  }
}

/// Three unrelated grids, one contact. Resolutions are the cheapest that satisfy the bounds.
struct Agreement
{
  int v_over_vy;
  int mapped;  ///< cells of the grid the others are held against
  GridKind grid;
  int cells;
  double restitution;  ///< allowed, relative
};

class ThreeGrids : public testing::TestWithParam<Agreement>
{
 protected:
  void compare();
};
class ThreeGridsSlow : public ThreeGrids
{
};

/// Free impacts at E*/Y = 100. Treated loading force at half and at all of the overlap: 0.3 % (mapped grids
/// of 32 and 40 cells themselves agree to 0.1 %). e: 0.5 %, but `updated` at V/V_y = 500: see below.
void ThreeGrids::compare()
{
  const Agreement& a = GetParam();
  const auto run = [&](GridKind grid, int cells) {
    RunOptions o;
    o.grid = grid, o.resolution = cells;
    return impact(reference::unit_sphere(100), {a.v_over_vy * yield_velocity(1, 0.01, 1)}, {}, o);
  };
  const RunResult mapped = run(GridKind::mapped, a.mapped), other = run(a.grid, a.cells);
  const TreatedLoading expected(mapped.trace), found(other.trace);
  const double deepest = std::min(mapped.summary.delta_max, other.summary.delta_max);
  for (const double part : {0.5, 1.0})
    EXPECT_NEAR(found.force(part * deepest) / expected.force(part * deepest), 1, 0.003) << part;
  EXPECT_NEAR(other.summary.delta_max / mapped.summary.delta_max, 1, 0.002);
  EXPECT_NEAR(other.summary.restitution / mapped.summary.restitution, 1, a.restitution);
  // `rectilinear` measured 4e-4 at 100, 2e-3 at 500; `updated` loses 7e-3 and 2e-2: APIC's transfer smooths
  // steep velocities (docs/evidence/solver-accuracy.md)
  EXPECT_LT(other.summary.energy_error, a.grid == GridKind::updated ? 0.025 : 0.004);
}

TEST_P(ThreeGrids, FindTheSameContact)
{
  compare();
}
TEST_P(ThreeGridsSlow, FindTheSameContact)
{
  compare();
}

std::string name_of(const testing::TestParamInfo<Agreement>& p)
{
  return (p.param.grid == GridKind::rectilinear ? "rectilinear" : "updated") +
         std::to_string(p.param.v_over_vy);
}

INSTANTIATE_TEST_SUITE_P(Grids, ThreeGrids,
                         testing::Values(Agreement{100, 32, GridKind::rectilinear, 16, 0.005},
                                         Agreement{500, 40, GridKind::rectilinear, 32, 0.005},
                                         Agreement{100, 32, GridKind::updated, 16, 0.006}),
                         name_of);
// e of `updated` at V/V_y = 500: .2498 at 32 and 48 cells, while `mapped` comes from below (.2475, .2477,
// .2479 at 40, 48, 64 cells) and `rectilinear` is at .2483.
INSTANTIATE_TEST_SUITE_P(Grids, ThreeGridsSlow,
                         testing::Values(Agreement{5, 16, GridKind::rectilinear, 16, 0.005},
                                         Agreement{5, 16, GridKind::updated, 12, 0.005},
                                         Agreement{20, 16, GridKind::rectilinear, 16, 0.005},
                                         Agreement{20, 16, GridKind::updated, 12, 0.005},
                                         Agreement{500, 40, GridKind::updated, 48, 0.01}),
                         name_of);

}  // namespace granulaw::grids_test
