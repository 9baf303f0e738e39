// Layers, inclusions and shapes: against the homogeneous sphere, closed forms, and bodies that are hard to
// compute.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "references.hpp"
#include "solver/kernels.hpp"
#include "solver/profiles.hpp"
#include "solver/ripple.hpp"
#include "solver/runs.hpp"
#include "solver/tartan_body.hpp"
#include "solver/time_step.hpp"

namespace granulaw {
namespace {

Particle sphere(double e_over_y)
{
  return Particle::from(reference::unit_sphere(e_over_y));
}

RunOptions options_of(int resolution, int phases, GridKind grid = GridKind::automatic)
{
  RunOptions o;
  o.resolution = resolution, o.phases = phases, o.grid = grid;
  return o;
}

/// The same body described in other words, on the same kind of grid.
class SameBody : public testing::Test
{
 protected:
  static constexpr double velocity = 0.0051;  // 100 V_y: overlap 0.03
  static RunSummary run(const Particle& p)
  {
    return run_impact(p, velocity, options_of(16, 2, GridKind::tartan)).summary;
  }
};

TEST_F(SameBody, LayersAndInclusionsOfTheSameMaterial)
{
  Particle layered = sphere(100);
  layered.materials.push_back(layered.materials.front());
  layered.materials.push_back(layered.materials.front());
  layered.layers = {{0.1, 1}, {0.2, 2}};
  layered.inclusions = {{0, 0.5, 0.15, 2}, {0.5, 1, 0.1, 1}};
  const RunSummary a = run(sphere(100)), b = run(layered);
  std::printf("e %g %g F %g %g d %g %g err %g points %ld %ld\n", a.restitution, b.restitution, a.force_max,
              b.force_max, a.delta_max, b.delta_max, b.energy_error, a.points, b.points);
  EXPECT_GT(b.points, a.points);  // pieces are cut where they would be, were the materials unlike
  EXPECT_NEAR(b.restitution, a.restitution, 2e-3 * a.restitution);
  EXPECT_NEAR(b.force_max, a.force_max, 1e-3 * a.force_max);
  EXPECT_NEAR(b.delta_max, a.delta_max, 1e-3 * a.delta_max);
}

TEST_F(SameBody, AProfileOfPoints)
{
  Particle drawn = sphere(100);
  drawn.profile = ellipsoid(1, 1);
  const RunSummary a = run(sphere(100)), b = run(drawn);
  std::printf("e %g %g F %g %g d %g %g\n", a.restitution, b.restitution, a.force_max, b.force_max,
              a.delta_max, b.delta_max);
  EXPECT_NEAR(b.restitution, a.restitution, 2e-3 * a.restitution);
  EXPECT_NEAR(b.force_max, a.force_max, 1e-3 * a.force_max);
  EXPECT_NEAR(b.delta_max, a.delta_max, 1e-3 * a.delta_max);
}

/// Apparent bulk modulus p V/dV of a ball (radius 1, elastic `shell`) with a concentric core under uniform
/// pressure: forces of the pressure are consistent, -p times the integral of the gradients, and the body is
/// relaxed by damped time steps.
double apparent_bulk_modulus(const Moduli& shell, const Moduli* core, double core_radius, double fine)
{
  Section s;
  s.phases = {{shell}};
  if (core) s.phases.push_back({*core});
  s.phase_at = [&](double r, double z) {
    const double d = std::hypot(r, z - 1);
    if (d < core_radius) return core ? 1 : -1;
    return d <= 1 ? 0 : -1;
  };
  s.surface_z = [](double r) { return 1 - std::sqrt(std::max(0.0, 1 - r * r)); };
  s.block = 1, s.depth = 2, s.fine = fine;
  Body b = tartan_body(s);
  // pressure on the outer surface only: gradients of the pieces fill the ball but for the pore, whose wall is
  // free, so its own part of the integral is added from a body without it
  Section whole = s;
  whole.phases = {{shell}};
  whole.phase_at = [](double r, double z) { return std::hypot(r, z - 1) <= 1 ? 0 : -1; };
  const Body full = tartan_body(whole);
  const double pressure = 1e-6;
  const auto key = [](const Body& body, int i) { return std::pair(std::lround(1e6 * body.r_i[i]), std::lround(1e6 * body.z_i[i])); };
  std::map<std::pair<long, long>, std::array<double, 2>> load;
  for (int p = 0; p < full.points; ++p)
    for (int k = 0; k < 9; ++k) {
      const std::size_t at = std::size_t(k) * full.points + p;
      auto& f = load[key(full, full.corner_p[at])];
      f[0] -= pressure * full.volume_p[p] * (full.br_p[at] + full.bh_p[at]);
      f[1] -= pressure * full.volume_p[p] * full.bz_p[at];
    }
  std::vector<double> pr(b.nodes), pz(b.nodes);
  for (int i = 0; i < b.nodes; ++i) pr[i] = load[key(b, i)][0], pz[i] = load[key(b, i)][1];

  const double dt = 0.85 * StableStep(b).limit(b), damping = 1.5;  // slowest radial mode: period about 2.5
  double before = 0, work = 0;
  for (int n = 0; n * dt < 60; ++n) {
    kernels().internal_force(b, false);
    for (int i = 0; i < b.nodes; ++i) b.fr_i[i] += pr[i], b.fz_i[i] += pz[i];
    kernels().accelerate(b, dt);
    for (const int i : b.axis) b.vr_i[i] = 0;
    for (int i = 0; i < b.nodes; ++i) b.vr_i[i] *= 1 - damping * dt, b.vz_i[i] *= 1 - damping * dt;
    kernels().move(b, dt);
    before = work;
    work = 0;
    for (int i = 0; i < b.nodes; ++i) work += pr[i] * b.ur_i[i] + pz[i] * b.uz_i[i];
  }
  EXPECT_NEAR(before, work, 1e-8 * work);  // at rest
  return pressure * pressure * (4.0 / 3.0 * M_PI) / work;
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
  EXPECT_NEAR(apparent_bulk_modulus(shell, &shell, 0.6, 0.1), shell.bulk, 1e-4 * shell.bulk);  // linear field
  for (const Moduli* core : std::initializer_list<const Moduli*>{&stiff, &soft, nullptr}) {
    const double exact = hashin(shell, core ? core->bulk : 0, 0.6);
    const double coarse = apparent_bulk_modulus(shell, core, 0.6, 0.1) / exact - 1;
    const double fine = apparent_bulk_modulus(shell, core, 0.6, 0.05) / exact - 1;
    std::printf("exact %g coarse %g fine %g\n", exact, coarse, fine);
  }
}

/// Elastic, thrown at the rigid plane: force and overlap at the turn.
RunSummary elastic_impact(const Particle& p, double velocity, int cells = 16)
{
  return run_impact(p, velocity, options_of(cells, 2)).summary;
}

/// Hertz with the radius of curvature at the pole. The body is finite: force over Hertz's is 1 + c sqrt(delta) + ...,
/// so two depths extrapolate to none.
TEST(Shapes, EllipsoidIsHertzAtItsPole)
{
  for (const double aspect : {0.6, 1.0, 1.6}) {
    Particle p = sphere(0);
    if (aspect != 1) p.profile = ellipsoid(1, aspect);
    const auto ratio = [&](double velocity) {
      const RunSummary s = elastic_impact(p, velocity);
      EXPECT_LT(s.energy_error, 1e-4);
      return std::pair{s.delta_max,
                       s.force_max / (4.0 / 3.0 * std::sqrt(p.pole_curvature_radius()) * std::pow(s.delta_max, 1.5))};
    };
    const auto [d1, f1] = ratio(0.001);
    const auto [d2, f2] = ratio(0.004);
    const double q = std::sqrt(d2 / d1), limit = f1 - (f2 - f1) / (q - 1);
    std::printf("aspect %g: %g at %g, %g at %g, limit %g\n", aspect, f1, d1, f2, d2, limit);
    EXPECT_NEAR(limit, 1, 0.01);
  }
}

TEST(Shapes, FlatTipIsAPunch)
{
  for (const double a : {0.1, 0.2}) {
    Particle p = sphere(0);
    p.profile = flattened_sphere(1, a, 0.05 * a);
    const RunSummary s = elastic_impact(p, 1e-4);
    const double punch = 2 * a * s.delta_max;
    std::printf("a %g: d %g F/punch %g, with k %g e %g err %g\n", a, s.delta_max, s.force_max / punch,
                s.force_max * (1 / (2 * a) - 0.45) / s.delta_max, s.restitution, s.energy_error);
  }
}

TEST(Shapes, ConeIsSneddons)
{
  Particle p = sphere(0);
  p.profile = conical_tip(1, 70, 0.02);
  for (const double v : {0.002, 0.01}) {
    const RunResult r = run_impact(p, v, options_of(24, 2));
    const TreatedLoading t(r.trace);
    const double d = r.summary.delta_max;
    std::printf("v %g d %g", v, d);
    for (const double x : {0.25, 0.5, 0.75, 1.0})
      std::printf("  F/Sneddon %g", t.force(x * d) / (2 / M_PI * std::tan(70 * M_PI / 180) * x * d * x * d));
    std::printf(" exponent %g e %g\n", std::log(t.force(d) / t.force(0.5 * d)) / std::log(2.0), r.summary.restitution);
  }
}

}  // namespace
}  // namespace granulaw
