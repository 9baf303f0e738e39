// Law lookup: nanoseconds and interpolation error on one line, with the size of what is kept in memory.
//
//   law_benchmark            the built-in curve: an analytic law sampled at as many nodes as mpm table writes
//
// `error` is the largest relative difference of the force between table and the analytic law it was sampled
// from.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

#include "law/contact_curve.hpp"

namespace {

using granulaw::ContactCurve;
using granulaw::ContactForce;
using granulaw::PairMapping;

constexpr double onset = 6.4e-4, s_end = 0.5625;

/// ln(F/F_elastic) and the others as smooth functions of q = ln(s/s_onset), as those that mpm table fits.
double past(double s)
{
  return std::max(0.0, std::log(std::max(s, 1e-12)) - 0.25 * std::log(onset));
}
double force_ratio(double s)
{
  const double q = past(s);
  return (1 + 0.9 * s * s) * std::exp(-1.6 * q * q / (1 + q));
}
double residual(double s)
{
  const double q = past(s);
  return 1 - std::exp(-1.1 * q * q);
}
double exponent(double s)
{
  const double q = past(s);
  return 1.507 - 0.1 * q * q / (1 + q * q);
}
double radius(double s)
{
  const double q = past(s);
  return 1 + 0.3 * q * q / (1 + q);
}

ContactCurve sampled(int nodes)
{
  ContactCurve::Table t;
  t.s_end = s_end;
  t.onset = onset;
  const auto fill = [&](double (*f)(double), std::vector<double>& value, std::vector<double>& slope) {
    for (int k = 0; k < nodes; ++k) {
      const double s = s_end * k / (nodes - 1), step = 1e-6;
      value.push_back(f(s));
      slope.push_back((f(s + step) - f(s - step)) / (2 * step));
    }
  };
  fill(force_ratio, t.force_ratio, t.force_ratio_slope);
  fill(residual, t.residual_ratio, t.residual_ratio_slope);
  fill(exponent, t.exponent, t.exponent_slope);
  fill(radius, t.radius_ratio, t.radius_ratio_slope);
  return {t, "benchmark"};
}

/// Exact force of the analytic law in units of 4/3 E* R^2.
double exact(double x, double x_m)
{
  const double s = std::pow(std::max(x, x_m), 0.25), top = s * s * s * s;
  const double f = std::pow(top, 1.5) * force_ratio(s);
  if (x >= x_m || x_m <= onset) return std::pow(x, 1.5) * force_ratio(std::pow(x, 0.25));
  const double u = (x / top - residual(s)) / (1 - residual(s));
  return u <= 0 ? 0 : f * std::pow(u, exponent(s));
}

/// Contacts as a flow has them: overlaps spread over decades, `unloading`: all below their largest overlap.
void lookup(benchmark::State& state, bool unloading)
{
  const ContactCurve curve = sampled(static_cast<int>(state.range(0)));
  const PairMapping pair = PairMapping::rigid_partner(0.75);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> decade(-5, -1), part(0.9, 1.0);
  std::vector<double> x(4096), x_m(4096);
  double error = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    x_m[k] = std::pow(10.0, decade(random));
    x[k] = x_m[k];
    if (unloading) {
      const double r = residual(std::pow(x_m[k], 0.25));
      x[k] = x_m[k] * (r + (1 - r) * part(random));
    }
    const double reached = unloading ? x_m[k] : 0.0;
    error =
        std::max(error, std::abs(curve.evaluate(pair, 1.0, x[k], reached).force / exact(x[k], reached) - 1));
  }
  std::size_t k = 0;
  for (auto _ : state) {
    const ContactForce f = curve.evaluate(pair, 1.0, x[k], unloading ? x_m[k] : 0.0);
    benchmark::DoNotOptimize(f);
    k = (k + 1) & 4095;
  }
  state.counters["error"] = error;
  state.counters["bytes"] =
      static_cast<double>((state.range(0) - 1) * 16 * sizeof(double));  // the coefficients
}

void loading(benchmark::State& state)
{
  lookup(state, false);
}
void unloading(benchmark::State& state)
{
  lookup(state, true);
}
BENCHMARK(loading)->ArgName("nodes")->Arg(33)->Arg(65)->Arg(126)->Arg(257);
BENCHMARK(unloading)->ArgName("nodes")->Arg(33)->Arg(65)->Arg(126)->Arg(257);

}  // namespace
