// Yield surfaces: closed forms of one material point, two against three dimensions, and whole impacts.
#include <gtest/gtest.h>

#include <boost/math/tools/roots.hpp>
#include <cmath>

#include "references.hpp"
#include "refusal.hpp"
#include "solver/body/kernels.hpp"
#include "solver/grid/mapped_body.hpp"
#include "solver/grid/spatial_grid.hpp"
#include "solver/material/law_table.hpp"
#include "solver/run/axisymmetric_setup.hpp"
#include "solver/runs.hpp"

namespace granulaw::yield_surface_test {

constexpr double yield = 0.01;

double slope_of(double degrees)
{
  const double sine = std::sin(degrees * M_PI / 180);
  return 6 * sine / (3 - sine);
}

Material frictional(double friction, double dilatancy, const FlowLaw& hardening = {},
                    const FlowLaw& rate = {})
{
  Material m;
  m.density = 1, m.poisson_ratio = 0.25, m.youngs_modulus = 1 - 0.25 * 0.25;
  m.yield_stress = yield;
  m.hardening = hardening, m.rate = rate;
  m.yield_surface = {"drucker-prager", {{"friction_angle", {friction}}, {"dilatancy_angle", {dilatancy}}}};
  validate(m, "test");
  return m;
}

Phase phase_of(const Material& m)
{
  return granulaw::phase_of(m, {1, 1, 1});
}

/// One ring-shaped cell.
Body ring(const Material& m)
{
  MappedGrid g;
  g.nodes = {{1, 0}, {2, 0}, {2, 1}, {1, 1}};
  g.cells = {{0, 1, 2, 3}};
  g.volume = 3 * M_PI;
  return mapped_body(g, phase_of(m), 0.0);
}

/// Stretches to exp(lateral) and exp(axial).
CauchyStress stretch(Body& b, double lateral, double axial)
{
  for (int i = 0; i < b.nodes(); ++i)
    b.u_i(i, 0) = std::expm1(lateral) * b.reference().place_i(i, 0),
             b.u_i(i, 1) = std::expm1(axial) * b.reference().place_i(i, 1);
  kernels(b).points_to_grid(b);
  CauchyStress s{};
  kernels(b).stress(b, &s);
  return s;
}

/// Stress after `steps` to the axial strain `last`, the side held at the pressure `confinement`.
CauchyStress triaxial(Body& b, double confinement, double last, int steps)
{
  CauchyStress s{};
  double lateral = 0;
  for (int k = 1; k <= steps; ++k) {
    const double axial = last * k / steps;
    const auto off = [&](double trial) {
      Body copy = b;
      return stretch(copy, trial, axial).xx + confinement;
    };
    std::uintmax_t iterations = 200;
    const double way =
        5 * std::abs(last) / steps + 2 * confinement;  // the side: up to 3.8 times the shortening
    const auto found = boost::math::tools::toms748_solve(
        off, lateral - way, lateral + way, boost::math::tools::eps_tolerance<double>(52), iterations);
    lateral = 0.5 * (found.first + found.second);
    s = stretch(b, lateral, axial);
  }
  return s;
}

struct Angles
{
  double friction, dilatancy;
};
constexpr Angles all_angles[] = {{0, 0}, {20, 0}, {20, 20}, {35, 10}, {50, 50}};

/// q = d + t p at p = p_c + q/3: q = sigma_y + 3 t p_c/(3 - t). Rounding of strains (1e-16) over Y/E is
/// 1e-14.
TEST(DruckerPrager, TriaxialCompression)
{
  for (const Angles a : all_angles)
    for (const double confinement : {0.0, 0.3 * yield, 3 * yield}) {
      Body b = ring(frictional(a.friction, a.dilatancy));
      const CauchyStress s = triaxial(b, confinement, -0.06 - 8 * confinement, 40);
      const double t = slope_of(a.friction);
      EXPECT_NEAR((s.xx - s.zz) / yield, 1 + 3 * t * confinement / yield / (3 - t), 1e-12) << a.friction;
      EXPECT_GT(b.state.plastic_strain_p[0], 0.01);
    }
}

/// The uniaxial strength in tension is 3 d/(3 + t), d = (1 - t/3) sigma_y.
TEST(DruckerPrager, UniaxialTension)
{
  for (const Angles a : all_angles) {
    Body b = ring(frictional(a.friction, a.dilatancy));
    const double t = slope_of(a.friction);
    EXPECT_NEAR(triaxial(b, 0, 0.03, 40).zz / yield, (3 - t) / (3 + t), 1e-12) << a.friction;
  }
}

/// Equal stretches end at the apex, p = -d/t, whatever the dilatancy.
TEST(DruckerPrager, ReturnsToTheApex)
{
  for (const Angles a : {Angles{20, 0}, Angles{35, 10}, Angles{50, 50}}) {
    Body b = ring(frictional(a.friction, a.dilatancy));
    CauchyStress s{};
    for (int k = 1; k <= 20; ++k) s = stretch(b, 0.001 * k, 0.0011 * k);
    const double t = slope_of(a.friction);
    EXPECT_NEAR(s.pressure() / yield, -(1 - t / 3) / t, 1e-12) << a.friction;
    EXPECT_LT(s.von_mises() / yield, 1e-12);
  }
}

/// On the flank the plastic volume strain tr(eps_e) - ln J is -s ep. The plastic state is exact to rounding
/// for increments of this size (exp_m1 in the kernel).
TEST(DruckerPrager, DilatesByItsAngle)
{
  for (const Angles a : all_angles) {
    Body b = ring(frictional(a.friction, a.dilatancy));
    triaxial(b, yield, -0.06, 60);
    const double det =
        ((1 + b.state.c_p[0][0]) * (1 + b.state.c_p[1][0]) - b.state.c_p[2][0] * b.state.c_p[2][0]) *
        (1 + b.state.c_p[3][0]);
    EXPECT_NEAR(-0.5 * std::log(det), slope_of(a.dilatancy) * b.state.plastic_strain_p[0], 1e-12)
        << a.dilatancy;
  }
}

/// The same path of homogeneous deformations in both dimensions, with shear, compression and tension in turn.
TEST(DruckerPrager, TwoAndThreeDimensionsAgree)
{
  const FlowLaw voce{"voce", {{"saturation_stress", {0.02}}, {"strain", {0.1}}}};
  const FlowLaw rate{"cowper-symonds", {{"reference_rate", {0.02}}, {"exponent", {5}}}};
  for (const Material& m : {frictional(35, 10), frictional(35, 20, voce), frictional(20, 0, voce, rate)}) {
    Body flat = ring(m);
    SpatialSection s;
    s.phases = {phase_of(m)};
    s.depth = [](const Vector3& x) { return 1 - x.norm(); };
    s.normal = [](const Vector3& x) { return Vector3(x.normalized()); };
    for (int d = 0; d < 3; ++d) s.lines[d] = graded_axis(-1, 1, {{-0.3, 0.3, 0.4, 0.13}}, 0.4, 0.2, false);
    Body body = spatial_body(s);
    for (int k = 1; k <= 120; ++k) {
      const double x = 0.1 * k, side = 0.01 * std::sin(0.7 * x),
                   axial = -0.03 * std::sin(0.5 * x) + 0.002 * k / 120;
      const double shear = 0.02 * std::sin(0.4 * x);
      for (int i = 0; i < flat.nodes(); ++i)
        flat.u_i(i, 0) = side * flat.reference().place_i(i, 0),
                    flat.u_i(i, 1) =
                        axial * flat.reference().place_i(i, 1) + shear * flat.reference().place_i(i, 0);
      for (int i = 0; i < body.nodes(); ++i) {
        const Vector3 at = reference_place(body, i);
        body.u_i(i, 0) = side * at[0], body.u_i(i, 1) = side * at[1];
        body.u_i(i, 2) = axial * at[2] + shear * at[0];
      }
      flat.elapsed = body.elapsed = 0.01;
      kernels(flat).points_to_grid(flat);
      kernels(body).points_to_grid(body);
    }
    const double volume = flat.reference().volume_p[0];
    int compared = 0;
    for (std::size_t p = 0; p < body.reference().volume_p.size(); ++p) {
      if (body.reference().volume_p[p] == 0) continue;
      ++compared;
      // gradients of cut pieces, rounded: 1e-15 over Y/E = 1e-2
      EXPECT_NEAR(body.state.plastic_strain_p[p], flat.state.plastic_strain_p[0], 1e-12);
      EXPECT_NEAR(body.state.elastic_energy_p[p] / body.reference().volume_p[p],
                  flat.state.elastic_energy_p[0] / volume, 1e-14);
      EXPECT_NEAR(body.state.plastic_work_p[p] / body.reference().volume_p[p],
                  flat.state.plastic_work_p[0] / volume, 1e-12);
    }
    EXPECT_GT(compared, 100);
    EXPECT_GT(flat.state.plastic_strain_p[0], 0.02);
  }
}

RunOptions coarse(GridKind grid)
{
  RunOptions o;
  o.grid = grid, o.resolution = 8, o.shifted_grids = 1, o.samples = 200;
  return o;
}

/// Friction 0 is von Mises, to the bit.
TEST(DruckerPrager, FrictionlessIsVonMises)
{
  const FlowLaw voce{"voce", {{"saturation_stress", {0.02}}, {"strain", {0.1}}}};
  for (const FlowLaw& hardening : {FlowLaw{}, voce})
    for (const GridKind grid : {GridKind::mapped, GridKind::updated}) {
      const Material m = frictional(0, 0, hardening);
      Material plain = m;
      plain.yield_surface = {};
      const RunResult a = impact(Particle::sphere(1, m), {0.02}, {}, coarse(grid));
      const RunResult b = impact(Particle::sphere(1, plain), {0.02}, {}, coarse(grid));
      ASSERT_EQ(a.trace.size(), b.trace.size());
      for (std::size_t k = 0; k < a.trace.size(); ++k) ASSERT_EQ(a.trace[k].force, b.trace[k].force) << k;
    }
}

/// Energies of impacts close as the step goes to 0: plastic work takes the pressure at the end of the step.
/// With eight cells 1.1e-3 of the energy is open at friction 20 without dilatancy, 2e-4 with von Mises.
TEST(DruckerPrager, ImpactsCloseTheirEnergy)
{
  for (const Angles a : {Angles{20, 0}, Angles{35, 10}, Angles{35, 35}}) {
    const Particle sphere = Particle::sphere(1, frictional(a.friction, a.dilatancy));
    const RunSummary flat = impact(sphere, {0.015}, {}, coarse(GridKind::mapped)).summary;
    EXPECT_LT(flat.energy_error, 1.5e-3) << a.friction;
    RunOptions shorter = coarse(GridKind::mapped);
    shorter.courant *= 0.5;
    EXPECT_LT(impact(sphere, {0.015}, {}, shorter).summary.energy_error, 0.6 * flat.energy_error)
        << a.friction;
    const RunSummary body = impact(sphere, {0.015}, {}, coarse(GridKind::spatial)).summary;
    EXPECT_LT(body.energy_error, 2e-3) << a.friction;
    EXPECT_NEAR(body.restitution / flat.restitution, 1, 0.03);  // single grids of eight cells: 1 to 2 % each
  }
}

/// J of a point of the `updated` grid follows from its elastic strain: only without dilation.
TEST(DruckerPrager, IsRefusedOnTheUpdatedGrid)
{
  const Particle sphere = Particle::sphere(1, frictional(30, 0));
  for (const char* part : {"'updated'", "volume"})
    expect_error(part, [&] { impact(sphere, {0.015}, {}, coarse(GridKind::updated)); });
}

TEST(DruckerPrager, WrongAnglesAreRefused)
{
  expect_error("'dilatancy_angle' is larger", [] { frictional(20, 30); });
  expect_error("0 to 75", [] { frictional(80, 30); });
  Material m = frictional(20, 0);
  m.yield_surface.name = "druker-prager";
  expect_error("did you mean 'drucker-prager'", [&] { validate(m, "test"); });
}

}  // namespace granulaw::yield_surface_test
