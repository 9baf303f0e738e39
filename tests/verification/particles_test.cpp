// Layers, inclusions and shapes: against the homogeneous sphere, closed forms, and bodies that are hard to
// compute.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>

#include "base/scales.hpp"
#include "references.hpp"
#include "refusal.hpp"
#include "solver/body/kernels.hpp"
#include "solver/body/stable_step.hpp"
#include "solver/grid/rectilinear_body.hpp"
#include "solver/run/grid_noise.hpp"
#include "solver/run/time_step.hpp"
#include "solver/runs.hpp"
#include "solver/shape/shapes.hpp"

namespace granulaw::particles_test {

Particle sphere(double e_over_y)
{
  return reference::unit_sphere(e_over_y);
}

RunOptions options_of(int resolution, int shifted_grids, GridKind grid = GridKind::automatic)
{
  RunOptions o;
  o.resolution = resolution, o.shifted_grids = shifted_grids, o.grid = grid;
  return o;
}

/// The same body described in other words, on the same kind of grid.
class SameBody : public testing::Test
{
 protected:
  static constexpr double velocity = 0.0051;  // 100 V_y: overlap 0.03
  static RunResult run(const Particle& p, int grids)
  {
    return impact(p, {velocity}, {}, options_of(16, grids, GridKind::rectilinear));
  }
};

TEST_F(SameBody, LayersAndInclusionsOfTheSameMaterial)
{
  Particle layered = sphere(100);
  layered.materials.push_back(layered.materials.front());
  layered.materials.push_back(layered.materials.front());
  layered.layers = {{0.1, 1}, {0.2, 2}};
  layered.inclusions = {{0, 0.5, 0.15, 2}, {0.5, 1, 0.1, 1}};
  const RunResult sphere_run = run(sphere(100), 2), layered_run = run(layered, 2);
  const RunSummary &a = sphere_run.summary, &b = layered_run.summary;
  EXPECT_GT(b.points, a.points);  // pieces are cut where they would be, were the materials unlike
  // the same grid; points see other means where a quarter is cut: measured 2e-5 (F as a fit through all of
  // the loading gives it; in the trace's peak, a single sample, 2.4e-4)
  const auto force = [](const RunResult& r) { return TreatedLoading(r.trace).force(r.summary.delta_max); };
  EXPECT_NEAR(b.restitution, a.restitution, 2e-4 * a.restitution);
  EXPECT_NEAR(force(layered_run), force(sphere_run), 2e-4 * a.force_max);
  EXPECT_NEAR(b.delta_max, a.delta_max, 2e-4 * a.delta_max);
}

TEST_F(SameBody, AProfileOfPoints)
{
  Particle drawn = sphere(100);
  drawn.profile = ellipsoid(1, 1);
  const RunSummary a = run(sphere(100), 8).summary, b = run(drawn, 8).summary;
  // the block is sized a little otherwise, so the grid noise (0.6 % of e in a single grid) has another phase:
  // measured e 1e-4, F 7e-4, overlap 1e-5
  EXPECT_NEAR(b.restitution, a.restitution, 6e-3 * a.restitution);
  EXPECT_NEAR(b.force_max, a.force_max, 2e-3 * a.force_max);
  EXPECT_NEAR(b.delta_max, a.delta_max, 1e-3 * a.delta_max);
}

/// Apparent bulk modulus p V/dV of a ball (radius 1, elastic `shell`) with a concentric core under uniform
/// pressure: forces of the pressure are consistent, -p times the integral of the gradients, and the body is
/// relaxed by damped time steps.
double apparent_bulk_modulus(const Moduli& shell, const Moduli* core, double core_radius, double fine)
{
  CutSection s;
  s.phases = {{shell}};
  if (core) s.phases.push_back({*core});
  s.phase_at = [&](double r, double z) {
    const double d = std::hypot(r, z - 1);
    if (d < core_radius) return core ? 1 : -1;
    return d <= 1 ? 0 : -1;
  };
  s.surface_z = [](double r) { return 1 - std::sqrt(std::max(0.0, 1 - r * r)); };
  s.block = 1, s.depth = 2, s.fine = fine;
  Body b = rectilinear_body(s);
  // pressure on the outer surface only: gradients of the pieces fill the ball but for the pore, whose wall is
  // free, so its own part of the integral is added from a body without it
  CutSection whole = s;
  whole.phases = {{shell}};
  whole.phase_at = [](double r, double z) { return std::hypot(r, z - 1) <= 1 ? 0 : -1; };
  const Body full = rectilinear_body(whole);
  const double pressure = 1e-6;
  const auto key = [](const Body& body, int i) {
    return std::pair(std::lround(1e6 * body.reference().place_i(i, 0)),
                     std::lround(1e6 * body.reference().place_i(i, 1)));
  };
  std::map<std::pair<long, long>, std::array<double, 2>> load;
  double volume = 0;
  for (int p = 0; p < full.points(); ++p) {
    volume += full.reference().volume_p[p];
    for (int k = 0; k < 9; ++k) {
      const std::size_t at = std::size_t(k) * full.points() + p;
      auto& f = load[key(full, full.reference().corners.node[at])];
      f[0] -= pressure * full.reference().volume_p[p] *
              (full.reference().corners.full.br[at] + full.reference().corners.full.bh[at]);
      f[1] -= pressure * full.reference().volume_p[p] * full.reference().corners.full.bz[at];
    }
  }
  std::vector<double> pr(b.nodes()), pz(b.nodes());
  for (int i = 0; i < b.nodes(); ++i) pr[i] = load[key(b, i)][0], pz[i] = load[key(b, i)][1];

  const double dt = 0.85 * StableStep(b).limit(b), damping = 1.5;  // slowest radial mode: period about 2.5
  double before = 0, work = 0;
  for (int n = 0; n * dt < 60; ++n) {
    kernels(b).points_to_grid(b);
    for (int i = 0; i < b.nodes(); ++i) b.f_i(i, 0) += pr[i], b.f_i(i, 1) += pz[i];
    kernels(b).accelerate(b, dt);
    for (int i = 0; i < b.nodes(); ++i) b.v_i(i, 0) *= 1 - damping * dt, b.v_i(i, 1) *= 1 - damping * dt;
    kernels(b).grid_to_points(b, dt);
    before = work;
    work = 0;
    for (int i = 0; i < b.nodes(); ++i) work += pr[i] * b.u_i(i, 0) + pz[i] * b.u_i(i, 1);
  }
  EXPECT_NEAR(before, work, 1e-8 * work);  // at rest
  return pressure * pressure * volume / work;
}

/// Hashin's composite sphere: K_eff = K_s + c (K_c - K_s)/(1 + (1 - c)(K_c - K_s)/(K_s + 4/3 G_s)), c the
/// core's share of the volume; exact for the two-layer ball under uniform pressure (Z. Hashin, J. Appl. Mech.
/// 29, 1962). An empty core, K_c = 0: Mackenzie's pore (1950).
double hashin(const Moduli& shell, double core_bulk, double core_radius)
{
  const double c = core_radius * core_radius * core_radius, d = core_bulk - shell.bulk;
  return shell.bulk + c * d / (1 + (1 - c) * d / (shell.bulk + 4.0 / 3.0 * shell.shear));
}

TEST(Composite, BulkModulusIsHashins)
{
  const Moduli shell{0.35, 0.76, 0, 0, false};
  Moduli stiff = shell, soft = shell;
  stiff.shear *= 10, stiff.bulk *= 10;
  soft.shear *= 0.1, soft.bulk *= 0.1;
  // one material: a linear field, which the grid holds exactly; strains of 1e-6 are small
  EXPECT_NEAR(apparent_bulk_modulus(shell, &shell, 0.6, 0.1), shell.bulk, 1e-5 * shell.bulk);
  // A spline cannot kink within a cell, so an interface costs O(h), and stiffness is overestimated. Four and
  // eight cells in the shell, measured: core ten times as stiff 2.9 %, 1.4 %; a tenth 0.3 %, 0.2 %; pore
  // -0.2 %, 0.0 %.
  struct Case
  {
    const Moduli* core;
    double coarse, fine;
  };
  for (const Case c : {Case{&stiff, 0.035, 0.018}, Case{&soft, 0.005, 0.004}, Case{nullptr, 0.004, 0.002}}) {
    const double exact = hashin(shell, c.core ? c.core->bulk : 0, 0.6);
    EXPECT_NEAR(apparent_bulk_modulus(shell, c.core, 0.6, 0.1) / exact, 1, c.coarse);
    EXPECT_NEAR(apparent_bulk_modulus(shell, c.core, 0.6, 0.05) / exact, 1, c.fine);
  }
}

/// Elastic, thrown at the rigid plane: force and overlap at the reversal.
RunSummary elastic_impact(const Particle& p, double velocity, int cells = 16)
{
  return impact(p, {velocity}, {}, options_of(cells, 2)).summary;
}

/// Hertz with the radius of curvature at the pole. The body is finite: its centre of mass comes nearer by k F
/// less (bodies_test.cpp), so k is taken at one depth and the other is foretold. A radius wrong by 10 % would
/// miss by 1.4 %.
TEST(Shapes, EllipsoidIsHertzAtItsPole)
{
  for (const double aspect : {0.6, 1.6}) {
    Particle p = sphere(0);
    p.profile = ellipsoid(1, aspect);
    const auto half_space = [&](double force) {
      return std::pow(0.75 * force * std::sqrt(aspect), 2.0 / 3.0);  // pole's radius 1/aspect
    };
    const RunSummary deep = elastic_impact(p, 0.004, 12), shallow = elastic_impact(p, 0.0015, 12);
    const double k = (half_space(deep.force_max) - deep.delta_max) / deep.force_max;
    EXPECT_GT(k, 0.1);
    EXPECT_LT(k, 0.8);
    // the next term is of order delta/R = 0.01 to 0.03 of k F: measured 0.3 % and 0.5 %
    EXPECT_NEAR((half_space(shallow.force_max) - k * shallow.force_max) / shallow.delta_max, 1, 0.007);
    EXPECT_NEAR(deep.restitution, 1, 2e-3);  // the flat one keeps 0.2 % of the energy as vibration
    EXPECT_LT(deep.energy_error, 2e-4);
  }
}

/// A flat tip of radius a under a small overlap: delta = F (1/(2 E* a) - k/(E* R)), k = 0.45 of the sphere.
TEST(Shapes, FlatTipIsAPunch)
{
  constexpr double a = 0.2;
  Particle p = sphere(0);
  p.profile = flattened_sphere(1, a, 0.05 * a);
  const RunSummary s = elastic_impact(p, 1e-4, 16);
  EXPECT_LT(s.delta_max, 0.1 * 0.05 * a);  // well within the rounded edge
  // Measured 0.9915: the rounded edge gives, and its singular stress sits in one cell. Without k 1.21.
  EXPECT_NEAR(s.force_max * (1 / (2 * a) - 0.45) / s.delta_max, 1, 0.02);
  EXPECT_LT(s.energy_error, 1e-3);  // the whole face touches at once: measured 2e-4
}

/// Beyond its rounded tip a cone is Sneddon's: F = 2/pi E* tan(half angle) delta^2.
TEST(Shapes, ConeIsSneddons)
{
  Particle p = sphere(0);
  const double angle = 70 * M_PI / 180, tip = 0.02;
  p.profile = conical_tip(1, 70, tip);
  const RunResult r = impact(p, {0.01}, {}, options_of(16, 2));
  const TreatedLoading t(r.trace);
  const double d = r.summary.delta_max;
  EXPECT_GT(d, 3 * tip);
  EXPECT_NEAR(std::log(t.force(d) / t.force(0.5 * d)) / std::log(2.0), 2, 0.1);  // measured 2.03
  // tip cut off (delta longer by tip (1/sin - 1), 4 %), finite body (5 %) and slope of 20 degrees, which
  // Sneddon has small: measured 1.13 to 1.16
  EXPECT_NEAR(t.force(d) / (2 / M_PI * std::tan(angle) * d * d), 1.1, 0.1);
  EXPECT_NEAR(r.summary.restitution, 1, 2e-3);
}

/// A pore that closes ends the run: its walls would pass each other unseen.
TEST(Hard, PoreBelowThePole)
{
  Particle p = sphere(100);
  p.inclusions = {{0, 0.06, 0.05, -1}};  // a roof of 0.01 R
  PressPlan plan;
  plan.depth = 0.05;
  const RunSummary open = press(p, plan, {}, options_of(12, 1)).summary;
  EXPECT_LT(open.energy_error, 2e-3);  // measured 4e-4 at 16 cells: plastic work by steps
  EXPECT_GT(open.restitution, 0.2);
  EXPECT_LT(open.restitution, 0.7);
  plan.depth = 0.15;
  expect_error("the pore at r = 0, z = 0.06", [&] { press(p, plan, {}, options_of(12, 1)); });
}

/// A hard, stiff shell on a soft core, and a soft one on a hard core: energies add up, and the shell has an
/// effect.
TEST(Hard, ThinShells)
{
  const double v = 20 * yield_velocity(1, 0.01, 1);
  const RunSummary plain = impact(sphere(100), {v}, {}, options_of(8, 1, GridKind::rectilinear)).summary;
  Particle p = sphere(100);
  p.materials.push_back(p.materials.front());
  p.layers = {{0.02, 1}};
  p.materials[1].yield_stress *= 0.1;
  const RunSummary soft = impact(p, {v}, {}, options_of(8, 1)).summary;
  EXPECT_LT(soft.energy_error, 1e-3);  // measured 3e-5
  EXPECT_LT(soft.restitution, plain.restitution);
  EXPECT_GT(soft.delta_max, plain.delta_max);
  p.materials[1].yield_stress = 0.1, p.materials[1].youngs_modulus *= 10;
  const RunSummary hard = impact(p, {v}, {}, options_of(8, 1)).summary;
  EXPECT_LT(hard.energy_error, 1e-3);  // measured 5e-6
  EXPECT_GT(hard.restitution, plain.restitution);
  EXPECT_LT(hard.delta_max, plain.delta_max);
}

/// A film of a thousandth of the core's yield stress is squeezed out: the run says so and ends.
TEST(Hard, AFilmThatIsSqueezedOut)
{
  Particle p = sphere(100);
  p.materials.push_back(p.materials.front());
  p.layers = {{0.02, 1}};
  p.materials[1].yield_stress *= 1e-3;
  expect_error("squeezed", [&] { impact(p, {20 * yield_velocity(1, 0.01, 1)}, {}, options_of(8, 1)); });
}

}  // namespace granulaw::particles_test
