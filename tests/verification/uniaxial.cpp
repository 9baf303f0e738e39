#include "uniaxial.hpp"

#include <boost/math/tools/roots.hpp>
#include <cmath>

#include "solver/body/kernels.hpp"
#include "solver/grid/mapped_body.hpp"
#include "solver/material/law_table.hpp"

namespace granulaw::verification {

namespace {

constexpr double yield = 0.01;

double root(const std::function<double(double)>& f, double low, double high)
{
  std::uintmax_t iterations = 200;
  const auto r = boost::math::tools::toms748_solve(f, low, high,
                                                   boost::math::tools::eps_tolerance<double>(52), iterations);
  return 0.5 * (r.first + r.second);
}

/// One ring-shaped cell.
Body ring(const Material& m)
{
  MappedGrid g;
  g.nodes = {{1, 0}, {2, 0}, {2, 1}, {1, 1}};
  g.cells = {{0, 1, 2, 3}};
  const double e = m.youngs_modulus, nu = m.poisson_ratio;
  const flow::Flow laws = flow_of(m, 1, 1);
  const double hardening = laws.hardening == 0 ? laws.hardening_values[0] : 0;
  g.volume = 3 * M_PI;
  return mapped_body(g, {{e / (2 * (1 + nu)), e / (3 * (1 - 2 * nu)), m.yield_stress, hardening, true, laws}},
                     0.0);
}

/// Stretches to exp(lateral) and exp(-strain), `dt` after the last time.
CauchyStress stretch(Body& b, double lateral, double strain, double dt)
{
  for (int i = 0; i < b.nodes(); ++i)
    b.u_i(i, 0) = std::expm1(lateral) * b.reference().place_i(i, 0),
             b.u_i(i, 1) = std::expm1(-strain) * b.reference().place_i(i, 1);
  b.elapsed = dt;
  kernels(b).points_to_grid(b);
  CauchyStress s{};
  kernels(b).stress(b, &s);
  return s;
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
  validate_flow(m, "uniaxial compression");
  return m;
}

}  // namespace

std::vector<StressStrain> compress(const Material& m, double last, int steps, double rate)
{
  std::vector<StressStrain> curve{{0, 0, 0}};
  Body b = ring(m);
  const double increment = last / steps, dt = rate > 0 ? increment / rate : 0;
  double lateral = 0;
  for (int k = 1; k <= steps; ++k) {
    const double strain = increment * k;
    const auto side_stress = [&](double trial) {
      Body copy = b;
      return stretch(copy, trial, strain, dt).xx;
    };
    // the side moves out by 0 to 1/2 of the shortening: nu while elastic, 1/2 while plastic
    lateral = root(side_stress, lateral - 0.1 * increment, lateral + 0.7 * increment);
    const CauchyStress s = stretch(b, lateral, strain, dt);
    curve.push_back({strain, -s.zz, b.state.plastic_strain_p[0]});
  }
  return curve;
}

std::vector<WrittenLaw> hardening_laws_written_out()
{
  return {
      {"perfect", material({}), [](double) { return yield; }, {}},
      {"linear", material({"linear", {{"modulus", {0.01}}}}), [](double e) { return yield + 0.01 * e; }, {}},
      {"swift",
       material({"swift",
                 {{"strength", {yield / std::pow(0.004, 0.2)}}, {"exponent", {0.2}}, {"offset", {0.004}}}}),
       [](double e) { return yield * std::pow(1 + e / 0.004, 0.2); },
       {}},
      {"voce",
       material({"voce", {{"saturation_stress", {0.022}}, {"strain", {0.12}}}}),
       [](double e) { return 0.022 - 0.012 * std::exp(-e / 0.12); },
       {}},
      {"johnson-cook",
       material({"johnson-cook", {{"strength", {0.008}}, {"exponent", {0.3}}}}),
       [](double e) { return yield + 0.008 * std::pow(e, 0.3); },
       {}},
      {"tabulated",
       material({"tabulated", {{"strain", {0, 0.1, 0.3, 1}}, {"stress", {yield, 0.0135, 0.015, 0.0155}}}}),
       [](double e) {
         const double x[] = {0, 0.1, 0.3, 1}, y[] = {yield, 0.0135, 0.015, 0.0155};
         for (int k = 0; k < 3; ++k)
           if (e < x[k + 1]) return y[k] + (y[k + 1] - y[k]) * (e - x[k]) / (x[k + 1] - x[k]);
         return y[3];
       },
       {}}};
}

std::vector<WrittenLaw> rate_laws_written_out()
{
  const FlowLaw voce{"voce", {{"saturation_stress", {0.015}}, {"strain", {0.12}}}};
  const auto stress = [](double e) { return 0.015 - 0.005 * std::exp(-e / 0.12); };
  return {{"johnson-cook rate",
           material(voce, {"johnson-cook", {{"coefficient", {0.05}}, {"reference_rate", {1e-4}}}}), stress,
           [](double g) { return 1e-4 * std::exp((g - 1) / 0.05); }},
          {"cowper-symonds rate",
           material(voce, {"cowper-symonds", {{"reference_rate", {0.02}}, {"exponent", {5}}}}), stress,
           [](double g) { return 0.02 * std::pow(g - 1, 5); }}};
}

StressStrain exact(const WrittenLaw& law, double strain, double rate)
{
  const double e = law.material.youngs_modulus, share = 1 - 2 * law.material.poisson_ratio;
  const auto cauchy = [&](double x) { return e * x * std::exp(share * x); };
  if (!law.rate) {
    const double ep = cauchy(strain) <= law.stress(0)
                          ? 0
                          : root([&](double p) { return law.stress(p) - cauchy(strain - p); }, 0, strain);
    return {strain, cauchy(strain - ep), ep};
  }
  // ep'(t) by fourth-order Runge-Kutta in steps of 1e-5 of strain. Too long a step for a stiffer law would
  // show as a kernel that does not tend to it (uniaxial_test.cpp).
  const auto growth = [&](double t, double p) {
    const double g = cauchy(t - p) / law.stress(std::max(p, 0.0));
    return g > 1 ? law.rate(g) / rate : 0.0;
  };
  const int steps = std::max(1, static_cast<int>(std::ceil(strain / 1e-5)));
  const double d = strain / steps;
  double ep = 0;
  for (int k = 0; k < steps; ++k) {
    const double t = k * d;
    const double k1 = growth(t, ep), k2 = growth(t + d / 2, ep + d / 2 * k1);
    const double k3 = growth(t + d / 2, ep + d / 2 * k2), k4 = growth(t + d, ep + d * k3);
    ep += d / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return {strain, cauchy(strain - ep), ep};
}

}  // namespace granulaw::verification
