// Every flow law: its local equation solved to rounding, and one material point against the integrated
// equation.
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <functional>
#include <random>

#include "base/error.hpp"
#include "base/larger.hpp"
#include "base/scales.hpp"
#include "solver/body/kernels.hpp"
#include "solver/grid/mapped_body.hpp"
#include "solver/material/law_table.hpp"
#include "solver/material/plastic_increment.hpp"
#include "solver/material/vector_math.hpp"
#include "solver/runs.hpp"

namespace granulaw::flow_law_test {

constexpr double shear = 0.35, bulk = 0.76, yield = 0.01;

TEST(FlowLaws, LogarithmAndExponential)
{
  for (int k = 0; k <= 200000; ++k) {
    const double t = -690 + 1380 * (k / 200000.0);
    // the argument t itself carries a rounding of 1e-16 |t| into the exponential
    ASSERT_NEAR(flow::exp(t) / std::exp(t), 1, 4e-16) << t;
    const double x = std::exp(0.05 * t);
    ASSERT_NEAR(flow::log(x), std::log(x), 4e-16 * std::max(1.0, std::abs(std::log(x)))) << x;
  }
  EXPECT_LT(flow::power(0.0, 0.2), 1e-60);
  EXPECT_GT(flow::power(0.0, 0.2), 0);
}

struct Case
{
  const char* name;
  FlowLaw hardening;                     ///< empty name: perfectly plastic
  std::function<double(double)> stress;  ///< written out again, with the C library
};

const std::vector<Case>& hardening_cases()
{
  static const std::vector<Case> cases{
      {"linear", {"linear", {{"modulus", {0.03}}}}, [](double e) { return yield + 0.03 * e; }},
      {"swift",
       {"swift", {{"strength", {yield / std::pow(0.004, 0.25)}}, {"exponent", {0.25}}, {"offset", {0.004}}}},
       [](double e) { return yield * std::pow(1 + e / 0.004, 0.25); }},
      {"voce", {"voce", {{"saturation_stress", {0.025}}, {"strain", {0.07}}}}, [](double e) { return 0.025 - 0.015 * std::exp(-e / 0.07); }},
      {"johnson-cook", {"johnson-cook", {{"strength", {0.013}}, {"exponent", {0.3}}}}, [](double e) { return yield + 0.013 * std::pow(e, 0.3); }},
      {"tabulated",
       {"tabulated", {{"strain", {0, 0.02, 0.1, 0.5, 1.1}}, {"stress", {yield, 0.013, 0.016, 0.02, 0.021}}}},
       [](double e) {
         const double x[] = {0, 0.02, 0.1, 0.5, 1.1}, y[] = {yield, 0.013, 0.016, 0.02, 0.021};
         for (int k = 0; k < 4; ++k)
           if (e < x[k + 1]) return y[k] + (y[k + 1] - y[k]) * (e - x[k]) / (x[k + 1] - x[k]);
         return y[4];
       }},
      {"perfect", {}, [](double) { return yield; }}};
  return cases;
}

struct RateCase
{
  const char* name;
  FlowLaw rate;
  std::function<double(double)> factor, inverse;  ///< g(rate); rate(g) for g > 1
};

const std::vector<RateCase>& rate_cases()
{
  static const std::vector<RateCase> cases{{"johnson-cook",
                                            {"johnson-cook", {{"coefficient", {0.05}}, {"reference_rate", {1e-4}}}},
                                            [](double r) { return 1 + 0.05 * std::log(std::max(1.0, r / 1e-4)); },
                                            [](double g) { return 1e-4 * std::exp((g - 1) / 0.05); }},
                                           {"cowper-symonds",
                                            {"cowper-symonds", {{"reference_rate", {0.02}}, {"exponent", {5}}}},
                                            [](double r) { return 1 + std::pow(r / 0.02, 0.2); },
                                            [](double g) { return 0.02 * std::pow(g - 1, 5); }}};
  return cases;
}

Material material(const FlowLaw& hardening, const FlowLaw& rate = {})
{
  Material m;
  m.density = 1;
  m.poisson_ratio = 0.3;
  m.youngs_modulus = 0.91;
  m.yield_stress = yield;
  m.hardening = hardening;
  m.rate = rate;
  validate_flow(m, "test");
  return m;
}

/// One ring-shaped cell.
Body ring(const Phase& phase)
{
  MappedGrid g;
  g.nodes = {{1, 0}, {2, 0}, {2, 1}, {1, 1}};
  g.cells = {{0, 1, 2, 3}};
  g.volume = 3 * M_PI;
  return mapped_body(g, phase, 0.0);
}
Body ring(const Material& m)
{
  const flow::Flow laws = flow_of(m, 1, 1);
  return ring(Phase{{shear, bulk, yield, laws.hardening == 0 ? laws.hardening_values[0] : 0, true, laws}});
}
Body linear_ring(double hardening)
{
  return ring(Phase{{shear, bulk, yield, hardening, true}});
}

/// Its nodes follow u_r = (lr - 1) r, u_z = (lz - 1) z.
void stretch_to(Body& b, double lr, double lz)
{
  for (int i = 0; i < b.nodes(); ++i) b.u_i(i, 0) = (lr - 1) * b.reference().place_i(i, 0), b.u_i(i, 1) = (lz - 1) * b.reference().place_i(i, 1);
  kernels(b).points_to_grid(b);
}

/// Isochoric compression to ln(lz) = -t along fixed principal axes, `dt` after the last one: q = 3 G t while elastic.
void compress(Body& b, double t, double dt)
{
  b.elapsed = dt;
  stretch_to(b, std::exp(0.5 * t), std::exp(-t));
}

double root(const std::function<double(double)>& f, double low, double high)
{
  std::uintmax_t iterations = 200;
  const auto r = boost::math::tools::toms748_solve(f, low, high, boost::math::tools::eps_tolerance<double>(52), iterations);
  return 0.5 * (r.first + r.second);
}

/// Stress from the energy: q = sqrt(6 G w), w = q^2/(6 G), J = 1.
double stress_of(const Body& b)
{
  return std::sqrt(6 * shear * b.state.elastic_energy_p[0] / b.reference().volume_p[0]);
}

/// A frozen evaluation keeps the plastic state, and its response is elastic about it: where nothing flows,
/// the forces are the same.
TEST(J2, FrozenResponseIsElasticAboutThePlasticState)
{
  Body b = linear_ring(0.05);
  for (int k = 1; k <= 100; ++k) stretch_to(b, std::exp(0.0005 * k), std::exp(-0.001 * k));
  stretch_to(b, std::exp(0.0005 * 99), std::exp(-0.001 * 99));
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
  Body b = linear_ring(0.05);
  for (int k = 1; k <= 100; ++k) stretch_to(b, std::exp(0.0005 * k), std::exp(-0.001 * k));
  const double strain = b.state.plastic_strain_p[0], energy = b.state.elastic_energy_p[0];
  for (int k = 100; k >= 95; --k) stretch_to(b, std::exp(0.0005 * k), std::exp(-0.001 * k));
  EXPECT_EQ(b.state.plastic_strain_p[0], strain);
  EXPECT_LT(b.state.elastic_energy_p[0], energy);
  for (int k = 95; k <= 100; ++k) stretch_to(b, std::exp(0.0005 * k), std::exp(-0.001 * k));
  EXPECT_NEAR(b.state.plastic_strain_p[0], strain, 1e-14);  // back on the yield surface to rounding
  EXPECT_NEAR(b.state.elastic_energy_p[0], energy, 1e-14);
}

/// A law may start up to 0.1 % below `yield_stress` (validate_flow): it flows from there.
TEST(FlowLaws, YieldsWhereTheLawStarts)
{
  const double low = 0.9992 * yield, between = 0.9996 * yield;
  const FlowLaw swift{"swift", {{"strength", {low / std::pow(0.004, 0.25)}}, {"exponent", {0.25}}, {"offset", {0.004}}}};
  Body b = ring(material(swift));
  compress(b, between / (3 * shear), 1);
  const double slope = 0.25 * low / 0.004;
  // q = 3 G (t - ep) = low + slope ep; the slope is that of the start: its change over ep is 1e-3 of ep
  EXPECT_NEAR(b.state.plastic_strain_p[0] * (3 * shear + slope) / (between - low), 1, 2e-3);
}

/// Without rate dependence radial loading integrates to 3 G (t - ep) = sigma_y(ep) whatever the steps: to
/// 150 %.
TEST(FlowLaws, HardeningAtLargeStrain)
{
  for (const Case& c : hardening_cases())
    for (const int steps : {600, 2400}) {
      Body b = ring(material(c.hardening));
      double work = 0, last_strain = 0;
      for (int k = 1; k <= steps; ++k) {
        const double t = 1.5 * k / steps;
        compress(b, t, 0);
        const double ep = 3 * shear * t <= yield ? 0 : root([&](double e) { return c.stress(e) - 3 * shear * (t - e); }, 0, t);
        // 2400 steps, each rounding strains of order 10 in b
        ASSERT_NEAR(b.state.plastic_strain_p[0], ep, 1e-10) << c.name << " at " << t;
        if (k % (steps / 8) == 0) {
          EXPECT_NEAR(stress_of(b) / c.stress(ep), 1, 1e-8) << c.name;  // q = 3 G (t - ep): 1e-10/(Y/3G)
        }
        work += 0.5 * (c.stress(last_strain) + c.stress(ep)) * (ep - last_strain);
        last_strain = ep;
      }
      // The dissipated work is the trapezium sum over the steps, by definition; against the integral it must
      // converge: its error is that of the trapezium rule, largest where the law starts steeply (ep^1.3: 1e-3
      // of a step).
      EXPECT_NEAR(b.state.plastic_work_p[0] / b.reference().volume_p[0], work, 1e-10) << c.name;
      const double integral = boost::math::quadrature::gauss_kronrod<double, 61>::integrate([&](double s) { return c.stress(s * s * s) * 3 * s * s; }, 0.0,
                                                                                            std::cbrt(last_strain), 12, 1e-12);
      EXPECT_NEAR(work / integral, 1, 600.0 / steps * 3e-4) << c.name;
    }
}

/// Under pressure, too, the Cauchy stress is the law's: the Kirchhoff deviator reaches J sigma_y.
TEST(FlowLaws, FlowAtTheirCauchyStress)
{
  constexpr double squeeze = 0.9, jacobian = squeeze * squeeze * squeeze;
  for (const Case& c : hardening_cases()) {
    Body b = ring(material(c.hardening));
    stretch_to(b, squeeze, squeeze);
    EXPECT_EQ(b.state.plastic_strain_p[0], 0) << c.name;  // pressure alone
    for (int k = 1; k <= 200; ++k) stretch_to(b, squeeze * std::exp(0.0005 * k), squeeze * std::exp(-0.001 * k));
    const double ln_j = std::log(jacobian), deviatoric = b.state.elastic_energy_p[0] / b.reference().volume_p[0] - 0.5 * bulk * ln_j * ln_j;
    EXPECT_GT(b.state.plastic_strain_p[0], 0.1);
    EXPECT_NEAR(std::sqrt(6 * shear * deviatoric) / (jacobian * c.stress(b.state.plastic_strain_p[0])), 1, 1e-8) << c.name;  // as q above
  }
}

/// Constant rate of loading t' : 3 G (t - ep) = sigma_y(ep) g(ep'). The kernel takes the rate as increment
/// over step (backward Euler). Each step must solve its equation; as the steps shrink, the path must tend to
/// the solution of the differential equation at first order.
TEST(FlowLaws, RateDependenceUnderConstantRate)
{
  constexpr double last = 1.5;
  for (const Case& c : hardening_cases())
    for (const RateCase& r : rate_cases())
      for (const double speed : {3e-3, 0.3}) {  // on either side of the reference rate of Cowper-Symonds
        const double duration = last / speed;
        std::vector<double> ends;
        for (const int steps : {1500, 3000, 6000}) {
          Body b = ring(material(c.hardening, r.rate));
          const double dt = duration / steps;
          double ep = 0;
          for (int k = 1; k <= steps; ++k) {
            const double t = last * k / steps;
            compress(b, t, dt);
            const auto balance = [&](double e) { return c.stress(e) * r.factor((e - ep) / dt) - 3 * shear * (t - e); };
            if (balance(ep) < 0) ep = root(balance, ep, t);
            ASSERT_NEAR(b.state.plastic_strain_p[0], ep, 1e-10) << c.name << " " << r.name << " at " << t;  // as above
          }
          ends.push_back(ep);
        }
        // The differential equation ep'(t) = rate(3 G (t - ep)/sigma_y(ep))/t', by fourth-order Runge-Kutta.
        const auto flow_rate = [&](double t, double e) {
          const double g = 3 * shear * (t - e) / c.stress(std::max(e, 0.0));
          return g > 1 ? r.inverse(g) / speed : 0.0;
        };
        double exact = 0;
        constexpr int fine = 48000;
        for (int k = 0; k < fine; ++k) {
          const double d = last / fine, t = k * d;
          const double k1 = flow_rate(t, exact), k2 = flow_rate(t + d / 2, exact + d / 2 * k1);
          const double k3 = flow_rate(t + d / 2, exact + d / 2 * k2), k4 = flow_rate(t + d, exact + d * k3);
          exact += d / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
        }
        const double error[] = {std::abs(ends[0] - exact), std::abs(ends[1] - exact), std::abs(ends[2] - exact)};
        // Half the step, half the error; where the path's end is straight (ep'' = 0) all of it is rounding.
        EXPECT_LT(error[1], 0.55 * error[0] + 1e-12) << c.name << " " << r.name;
        EXPECT_LT(error[2], 0.55 * error[1] + 1e-12) << c.name << " " << r.name;
        EXPECT_LT(error[2], 1e-7) << c.name << " " << r.name;  // backward Euler: dt ep''/2 over the relaxation; 2e-8 seen
      }
}

/// Residual of the local equation after the Newton steps of a search, over all laws and far beyond what runs
/// meet: Y/E* from 2e-4 to 0.1, trial stresses from 1e-7 to 1 above the flow stress, exponents 0.05 to 1, any
/// time step. `tangent`, if given: the largest residual of tangent_increment where it reports convergence,
/// and the fraction of cases in which it did.
template <class MakeHardening, class MakeRate>
double worst_residual(MakeHardening hardening, MakeRate rate, std::pair<double, double>* tangent = nullptr)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto u = [&] { return uniform(random); };
  double worst = 0;
  for (int k = 0; k < 40000; ++k) {
    const double y = std::pow(10, -3.7 + 2.7 * u());
    const auto h = hardening(y, u);
    const auto r = rate(u);
    const double ep = u() < 0.2 ? 0 : std::pow(10, -8 + 8.3 * u());
    const double shear3 = 1.05, jacobian = 0.8 + 0.4 * u(), per_dt = std::pow(10, 1 + 3 * u());
    const double trial = jacobian * h(ep).value * (1 + std::pow(10, -7 + 7 * u()));
    flow::Search search = flow::begin_search(h, r, trial, jacobian, shear3, ep, per_dt);
    for (int step = 0; step < flow::newton_steps; ++step)
      if (flow::newton_step(search, h, r, shear3, per_dt)) break;
    const double x = search.strain;
    const double left = shear3 * x + jacobian * h(ep + x).value * r(x * per_dt).value - trial;
    worst = larger(worst, std::isfinite(left) ? std::abs(left) / trial : 1.0);
    if (!tangent) continue;
    const flow::TangentIncrement quick = flow::tangent_increment(h, trial, jacobian, shear3, ep);
    if (!quick.converged) continue;
    const double rest = shear3 * quick.strain + jacobian * h(ep + quick.strain).value - trial;
    tangent->first = larger(tangent->first, std::isfinite(rest) ? std::abs(rest) / trial : 1.0);
    tangent->second += 1.0 / 40000;
    EXPECT_GE(quick.stress, jacobian * h(ep).value * (1 - 1e-12));
    EXPECT_LE(quick.stress, jacobian * h(ep + quick.strain).value * (1 + 1e-9));
  }
  return worst;
}

TEST(FlowLaws, NewtonResidual)
{
  using namespace flow;
  const auto linear = [](double y, auto u) {
    const double v[] = {u()};
    return Linear::from(y, v);
  };
  const auto swift = [](double y, auto u) {
    const double n = 0.05 + 0.95 * u(), offset = std::pow(10, -6 + 5 * u()), v[] = {y / std::pow(offset, n), n, offset};
    return Swift::from(y, v);
  };
  const auto voce = [](double y, auto u) {
    const double v[] = {y * (1 + 3 * u()), std::pow(10, -3 + 3 * u())};
    return Voce::from(y, v);
  };
  const auto johnson_cook = [](double y, auto u) {
    const double v[] = {5 * y * u(), 0.05 + 0.95 * u()};
    return JohnsonCook::from(y, v);
  };
  double table[law_room];
  const auto tabulated = [&](double y, auto u) {
    std::vector<double> strain{0}, stress{y};
    while (strain.size() < 32) {
      const double more = std::pow(10, -5 + 4 * u());
      strain.push_back(strain.back() + more);
      stress.push_back(stress.back() + more * u() * u());  // slopes to E*
    }
    EXPECT_EQ(Tabulated::pack(strain.data(), 32, stress.data(), 32, table), nullptr);
    return Tabulated::from(y, table);
  };
  const auto none = [](auto) { return RateIndependent{}; };
  const auto jc_rate = [](auto u) {
    const double v[] = {0.5 * u() * u(), std::pow(10, -8 + 8 * u())};
    return JohnsonCookRate::from(v);
  };
  const auto cs_rate = [](auto u) {
    const double v[] = {std::pow(10, -6 + 7 * u()), 1 + 9 * u()};
    return CowperSymonds::from(v);
  };
  const auto check = [&](const char* name, auto hardening) {
    std::pair<double, double> tangent{0, 0};
    const double left[] = {worst_residual(hardening, none, &tangent), worst_residual(hardening, jc_rate), worst_residual(hardening, cs_rate)};
    std::printf(
        "largest residual over trial stress, %-12s rate-independent %.1e, Johnson-Cook %.1e, Cowper-Symonds "
        "%.1e; "
        "from the tangent %.1e in %.0f %%\n",
        name, left[0], left[1], left[2], tangent.first, 100 * tangent.second);
    for (const double l : {left[0], left[1], left[2], tangent.first}) EXPECT_LT(l, 1e-10) << name;  // the accuracy that HardeningAtLargeStrain requires
    EXPECT_GT(tangent.second, 0.2) << name;                                                         // else it would be of no use
  };
  check("linear", linear);
  check("swift", swift);
  check("voce", voce);
  check("johnson-cook", johnson_cook);
  check("tabulated", tabulated);
}

constexpr double impact_speed = 0.01;  // of c*

RunResult collide(const Particle& sphere)
{
  RunOptions options;
  options.resolution = 8;
  options.shifted_grids = 1;
  options.samples = 200;
  return impact(sphere, {impact_speed * std::sqrt(sphere.materials[0].e_star() / sphere.materials[0].density)}, {}, options);
}

/// Two spheres of different size, modulus and density with the same E*/Y, nu, V/c* and the same rates times
/// R/c* have the same dimensionless trace; the same material at ten times the radius has another: size
/// invariance is lost.
TEST(FlowLaws, RateDependentSimilarity)
{
  for (const RateCase& r : rate_cases()) {
    const FlowLaw voce = hardening_cases()[2].hardening;
    Particle unit = Particle::sphere(1, material(voce, r.rate));
    Particle other = unit;
    const double stress = 3.7e9, density = 1234;
    other.radius = 2.3e-3;
    const double seconds = other.radius / std::sqrt(stress / density);
    other.materials[0].density = density;
    other.materials[0].youngs_modulus *= stress;
    other.materials[0].yield_stress *= stress;
    other.materials[0].hardening.values["saturation_stress"][0] *= stress;
    other.materials[0].rate.values["reference_rate"][0] /= seconds;
    const RunResult a = collide(unit), b = collide(other);
    ASSERT_EQ(a.trace.size(), b.trace.size()) << r.name;
    const double force = stress * other.radius * other.radius;
    for (std::size_t k = 0; k < a.trace.size(); ++k) {
      // the seed paper's claim through finite arithmetic: rounding of 1e-16 grown over 1e4 steps stays below
      // 1e-6
      ASSERT_NEAR(b.trace[k].delta / other.radius, a.trace[k].delta, 1e-6 * a.summary.delta_max) << r.name;
      ASSERT_NEAR(b.trace[k].force / force, a.trace[k].force, 1e-6 * a.summary.force_max) << r.name;
    }
    other.radius *= 10;
    const RunResult larger = collide(other);
    // ten times the radius: rates a tenth; Johnson-Cook then loses 0.05 ln 10 = 0.12 of Y, Cowper-Symonds
    // more
    EXPECT_LT(larger.summary.restitution, 0.99 * a.summary.restitution) << r.name;
    EXPECT_GT(larger.summary.delta_max / other.radius, 1.01 * a.summary.delta_max) << r.name;
    // Kinetic, stored and dissipated energy close as well as for a perfectly plastic sphere: the time step's
    // error.
    Particle plain = unit;
    plain.materials[0].hardening = plain.materials[0].rate = {};
    const double plain_error = collide(plain).summary.energy_error;
    EXPECT_LT(a.summary.energy_error, 2 * plain_error + 1e-4) << r.name;
    std::printf("%s: e %.4f, at ten times the radius %.4f; energy error %.1e (rate-independent, perfect %.1e)\n", r.name, a.summary.restitution,
                larger.summary.restitution, a.summary.energy_error, plain_error);
  }
}

/// A law that another spelling makes identical gives the identical impact: a table of two points is linear
/// hardening.
TEST(FlowLaws, ImpactAgreesWithClosedForm)
{
  Particle linear = Particle::sphere(1, material({"linear", {{"modulus", {0.05}}}}));
  Particle table = Particle::sphere(1, material({"tabulated", {{"strain", {0, 10}}, {"stress", {yield, yield + 0.5}}}}));
  const RunSummary a = collide(linear).summary, b = collide(table).summary;
  // local solutions agree to 1e-15; what grows from it over 1e4 steps
  EXPECT_NEAR(b.restitution / a.restitution, 1, 1e-6);
  EXPECT_NEAR(b.force_max / a.force_max, 1, 1e-6);
}

/// Each refusal is one sentence.
TEST(FlowLaws, ScaledStrains)
{
  Material plain = material({});
  plain.hardening_modulus = 0.03;
  for (const double by : {0.2, 3.0}) {
    EXPECT_NEAR(flow_stress(with_strains_scaled(plain, by), by * 0.1), flow_stress(plain, 0.1), 1e-15);
    for (const Case& c : hardening_cases()) {
      const Material scaled = with_strains_scaled(material(c.hardening), by);
      validate_flow(scaled, "test");
      for (const double ep : {0.0, 1e-6, 1e-3, 0.05, 0.7}) EXPECT_NEAR(flow_stress(scaled, by * ep) / c.stress(ep), 1, 1e-12) << c.name << " " << ep;
    }
  }
}

/// Single precision of the points under every pair of laws: what rounding leaves is 9e-8 here.
TEST(FlowLaws, SinglePrecision)
{
  for (const Case& c : hardening_cases())
    for (const FlowLaw& rate : {FlowLaw{}, rate_cases()[0].rate, rate_cases()[1].rate}) {
      const Particle sphere = Particle::sphere(1, material(c.hardening, rate));
      RunOptions options;
      options.resolution = 12, options.shifted_grids = 1;
      const RunSummary full = impact(sphere, {0.01}, {}, options).summary;
      options.precision = Precision::single;
      const RunSummary single = impact(sphere, {0.01}, {}, options).summary;
      EXPECT_NEAR(single.restitution / full.restitution, 1, 5e-7) << c.name << " " << rate.name;
      EXPECT_NEAR(single.force_max / full.force_max, 1, 5e-7) << c.name << " " << rate.name;
    }
}

TEST(FlowLaws, Refusals)
{
  const auto refused = [](const FlowLaw& hardening, const FlowLaw& rate = {}) {
    try {
      material(hardening, rate);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("accepted");
  };
  const auto contains = [](const std::string& text, const char* word) { return text.find(word) != std::string::npos; };
  EXPECT_PRED2(contains, refused({"swyft", {}}), "did you mean 'swift'");
  EXPECT_PRED2(contains, refused({"swift", {{"strength", {1}}, {"exponent", {0.2}}, {"offset", {0.01}}}}), "must be 'yield_stress' to 0.1 %");
  EXPECT_PRED2(contains, refused({"swift", {{"strength", {1}}, {"exponent", {0.2}}}}), "needs 'offset'");
  EXPECT_PRED2(contains, refused({"voce", {{"saturation_stress", {0.005}}, {"strain", {0.1}}}}), "below yield_stress");
  EXPECT_PRED2(contains, refused({"johnson-cook", {{"strength", {1}}, {"exponent", {1.5}}}}), "0.05 to 1");
  EXPECT_PRED2(contains, refused({"tabulated", {{"strain", {0, 0.1, 0.1}}, {"stress", {yield, 0.02, 0.03}}}}), "must ascend");
  EXPECT_PRED2(contains, refused({"tabulated", {{"strain", {0, 0.1}}, {"stress", {yield, 0.005}}}}), "falls");
  EXPECT_PRED2(contains, refused({}, {"cowper-symond", {}}), "did you mean 'cowper-symonds'");
}

}  // namespace granulaw::flow_law_test
