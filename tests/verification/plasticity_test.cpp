// One material point against the integrated equations.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/body/kernels.hpp"
#include "solver/grid/mapped_body.hpp"

namespace granulaw::plasticity_test {

constexpr double shear = 0.35, bulk = 0.76, yield = 0.01, hardening = 0.05;

/// One ring-shaped cell whose nodes follow u_r = (lr - 1) r, u_z = (lz - 1) z.
Body ring(double h)
{
  MappedGrid g;
  g.nodes = {{1, 0}, {2, 0}, {2, 1}, {1, 1}};
  g.cells = {{0, 1, 2, 3}};
  g.volume = 3 * M_PI;
  return mapped_body(g, {{shear, bulk, yield, h, true}}, 0.0);
}

void stretch(Body& b, double lr, double lz)
{
  for (int i = 0; i < b.nodes(); ++i)
    b.u_i(i, 0) = (lr - 1) * b.reference().place_i(i, 0),
             b.u_i(i, 1) = (lz - 1) * b.reference().place_i(i, 1);
  kernels(b).points_to_grid(b);
}

/// Isochoric compression ln(lz) = -t along fixed principal axes: q = 3 G t while elastic, and with linear
/// hardening the return gives eps_p = (3 G t - Y)/(3 G + H) exactly, however large t and however many steps.
TEST(J2, RadialLoadingIsExact)
{
  for (const double h : {0.0, hardening}) {
    Body b = ring(h);
    constexpr double last = 1.5;  // strain of 150 %
    constexpr int steps = 600;
    for (int k = 1; k <= steps; ++k)
      stretch(b, std::exp(0.5 * last * k / steps), std::exp(-last * k / steps));
    // the update of the plastic state is exact to rounding for increments of this size (exp_m1 in the
    // kernel); 600 steps of 1e-16 at strains of order 10 in b
    EXPECT_NEAR(b.state.plastic_strain_p[0], (3 * shear * last - yield) / (3 * shear + h), 1e-10);
    const double q = yield + h * b.state.plastic_strain_p[0];  // J = 1: Kirchhoff = Cauchy
    EXPECT_NEAR(b.state.elastic_energy_p[0] / b.reference().volume_p[0], q * q / (6 * shear), 1e-11);
    EXPECT_NEAR(b.state.plastic_work_p[0] / b.reference().volume_p[0],
                yield * b.state.plastic_strain_p[0] +
                    0.5 * h * b.state.plastic_strain_p[0] * b.state.plastic_strain_p[0],
                1e-9);  // trapezium of the linear yield stress over each step: exact but for 600 roundings
  }
}

/// Yield is on the Cauchy stress: under pressure the Kirchhoff deviator may reach J Y.
TEST(J2, YieldsOnCauchyStress)
{
  Body b = ring(0);
  const double squeeze = 0.9;  // J = 0.729
  stretch(b, squeeze, squeeze);
  EXPECT_EQ(b.state.plastic_strain_p[0], 0.0);
  for (int k = 1; k <= 200; ++k) stretch(b, squeeze * std::exp(0.0005 * k), squeeze * std::exp(-0.001 * k));
  const double jacobian = squeeze * squeeze * squeeze;
  const double deviatoric =
      b.state.elastic_energy_p[0] / b.reference().volume_p[0] - 0.5 * bulk * std::pow(std::log(jacobian), 2);
  const double q = std::sqrt(6 * shear * deviatoric);
  EXPECT_NEAR(q, jacobian * yield, 1e-10);  // energies of 1e-2 carry 1e-18: q^2 to 1e-18, q to 1e-10 is ample
}

/// A frozen evaluation keeps the plastic state, and its response is elastic about it: where nothing flows,
/// the forces are the same.
TEST(J2, FrozenResponseIsElasticAboutThePlasticState)
{
  Body b = ring(hardening);
  for (int k = 1; k <= 100; ++k) stretch(b, std::exp(0.0005 * k), std::exp(-0.001 * k));
  stretch(b, std::exp(0.0005 * 99), std::exp(-0.001 * 99));
  const NodeField before = b.f_i;
  const double strain = b.state.plastic_strain_p[0];
  kernels(b).elastic_response(b);
  EXPECT_EQ(b.state.plastic_strain_p[0], strain);
  for (int i = 0; i < b.nodes(); ++i) {
    // roundings of two compilations of the same sums
    EXPECT_NEAR(b.f_i(i, 0), before(i, 0), 1e-15);
    EXPECT_NEAR(b.f_i(i, 1), before(i, 1), 1e-15);
  }
}

/// A closed elastic-plastic loop: unloading to zero deviator and back is elastic.
TEST(J2, UnloadingIsElastic)
{
  Body b = ring(hardening);
  for (int k = 1; k <= 100; ++k) stretch(b, std::exp(0.0005 * k), std::exp(-0.001 * k));
  const double strain = b.state.plastic_strain_p[0], energy = b.state.elastic_energy_p[0];
  for (int k = 100; k >= 95; --k) stretch(b, std::exp(0.0005 * k), std::exp(-0.001 * k));
  EXPECT_EQ(b.state.plastic_strain_p[0], strain);
  EXPECT_LT(b.state.elastic_energy_p[0], energy);
  for (int k = 95; k <= 100; ++k) stretch(b, std::exp(0.0005 * k), std::exp(-0.001 * k));
  EXPECT_NEAR(b.state.plastic_strain_p[0], strain, 1e-14);  // back on the yield surface to rounding
  EXPECT_NEAR(b.state.elastic_energy_p[0], energy, 1e-14);
}

}  // namespace granulaw::plasticity_test
