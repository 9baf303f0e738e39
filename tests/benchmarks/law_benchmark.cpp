// Law lookup for a million contacts a step: force, stiffness and contact radius, in nanoseconds, with the
// error and the size of what is read on the same line.
//
//   law_benchmark       1-D: quasi-static; 2-D: with a velocity axis, each contact with an X of its own;
//                       load: at its largest overlap; unload: below it, after yield (before, a contact
//                       unloads along its loading curve)
//     lookup            force, stiffness and contact radius from overlap, largest overlap and X
//     kept              the same of contacts that have kept their reversal, as in LIGGGHTS
//     pair              lookup in SI, pair mapping included
//     force             the force alone
//     Hertz, reference  Hertz's formulas and the ContactCurve (1-D), in SI: yardsticks
//
// `error_F`, `error_k`, `error_a`: largest relative difference of force, stiffness and contact radius from
// the ContactCurve or, for the ContactCurve itself, of the force from the analytic law that it was sampled
// from.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

#include "base/larger.hpp"
#include "law/fast_curve.hpp"

namespace {

using granulaw::ContactCurve;
using granulaw::ContactForce;
using granulaw::FastCurve;
using granulaw::ImpactLevels;
using granulaw::larger;
using granulaw::PairMapping;
using granulaw::VelocityAxis;

constexpr double onset = 6.4e-4, s_end = 0.5625, x_end = s_end * s_end * s_end * s_end;
constexpr int nodes = 126;                   // as many as mpm table writes
constexpr int levels = 8, ratio_nodes = 25;  // of the axis
constexpr std::size_t contacts = 4096;

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
double hertz_share(double s)
{
  const double q = past(s);
  return 0.95 - 0.5 * q * q / (1 + q * q);
}
double radius(double s)
{
  const double q = past(s);
  return 1 + 0.3 * q * q / (1 + q);
}

ContactCurve::Table sampled()
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
  fill(hertz_share, t.hertz_share, t.hertz_share_slope);
  fill(radius, t.radius_ratio, t.radius_ratio_slope);
  return t;
}

/// Corrections of the size and shape that impacts at I = 0.06 show.
VelocityAxis::Table sampled_axis()
{
  VelocityAxis::Table t;
  t.speed_end = 0.245;
  t.ratio_end = 1.5;
  t.levels = levels;
  t.first_levels = 3;
  t.impact_overlap = {0, x_end};
  t.impact_overlap_slope = {x_end / t.speed_end, x_end / t.speed_end};
  for (int k = 1; k <= levels; ++k)
    for (int l = 0; l < ratio_nodes; ++l) {
      const double part = ImpactLevels::from_standstill(levels, t.first_levels, 1.0).overlap(k),
                   xi = t.ratio_end * l / (ratio_nodes - 1);
      const double rest = 1 - xi / t.ratio_end, cross = 1 - xi / 0.65;
      t.force_correction.push_back(0.5 * part * rest * rest * cross);
      t.force_correction_slope.push_back(0.5 * part * rest * (-2 / t.ratio_end * cross - rest / 0.65));
      t.residual_correction.push_back(-0.01 * part * xi * xi);
      t.residual_correction_slope.push_back(-0.02 * part * xi);
      t.exponent_correction.push_back(0.1 * part * xi * xi);
      t.exponent_correction_slope.push_back(0.2 * part * xi);
    }
  return t;
}

const ContactCurve quasi_static{sampled(), "benchmark"};
const ContactCurve with_axis{sampled(), sampled_axis(), "benchmark"};
const FastCurve fast_quasi_static{quasi_static}, fast_with_axis{with_axis};

/// Exact force of the analytic law in units of 4/3 E* R^2.
double exact(double x, double x_m)
{
  const double s = std::pow(std::max(x, x_m), 0.25), top = s * s * s * s;
  const double f = std::pow(top, 1.5) * force_ratio(s);
  if (x >= x_m || x_m <= onset) return std::pow(x, 1.5) * force_ratio(std::pow(x, 0.25));
  const double u = (x / top - residual(s)) / (1 - residual(s));
  return u <= 0 ? 0 : f * granulaw::UnloadingShape{exponent(s), hertz_share(s)}.at(u).value;
}

/// Contacts as a flow has them: overlaps spread over decades, the largest of them a tenth to 1.3 of X.
struct Contact
{
  double x, x_max, impact_overlap, r_eff = 1.0;
};
std::vector<Contact> flow(bool unloading, bool axis)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> decade(unloading ? std::log10(onset) : -5, -1), part(0.9, 1.0),
      ratio(0.1, 1.3);
  std::vector<Contact> all(contacts);
  for (Contact& c : all) {
    c.x = c.x_max = std::pow(10.0, decade(random));
    const double r = residual(std::pow(c.x_max, 0.25));
    if (unloading) c.x = c.x_max * (r + (1 - r) * part(random));
    if (!unloading) c.x_max = 0;
    c.impact_overlap = axis ? std::min(x_end, std::max(c.x, c.x_max) / ratio(random)) : 0.0;
  }
  return all;
}

const PairMapping pair_mapping = PairMapping::rigid_partner(0.75);

template <class Contact, class Evaluate>
void time(benchmark::State& state, const std::vector<Contact>& flow, const Evaluate& evaluate)
{
  std::size_t k = 0;
  for (auto _ : state) {
    const auto f = evaluate(flow[k]);
    benchmark::DoNotOptimize(f);
    k = (k + 1) & (contacts - 1);
  }
}

double off(double found, double expected)
{
  return expected == 0 ? std::abs(found) : std::abs(found / expected - 1);
}

/// Times `evaluate`; `found` is its result for that contact, in SI.
template <class Contact, class Evaluate, class Found>
void compare(benchmark::State& state, const std::vector<Contact>& all, bool axis, const Evaluate& evaluate,
             const Found& found)
{
  double force = 0, stiffness = 0, radius = 0;
  for (const Contact& c : all) {
    const ContactForce expected = (axis ? with_axis : quasi_static)
                                      .evaluate(pair_mapping, c.r_eff, c.x, c.x_max, c.impact_overlap),
                       f = found(evaluate(c));
    force = larger(force, off(f.force, expected.force));
    stiffness = larger(stiffness, off(f.stiffness, expected.stiffness));
    radius = larger(radius, off(f.contact_radius, expected.contact_radius));
  }
  time(state, all, evaluate);
  state.counters["error_F"] = force;
  state.counters["error_k"] = stiffness;
  state.counters["error_a"] = radius;
  state.counters["bytes"] = static_cast<double>((axis ? fast_with_axis : fast_quasi_static).bytes());
}

/// Of the curve's units in SI, where R* = 1 and the partner is rigid.
ContactForce scaled(const ContactCurve::Loading& f)
{
  const double force = pair_mapping.force(1.0);
  return {force * f.force, force * f.stiffness, f.radius, 0.0};
}

void lookup(benchmark::State& state, bool unloading, bool axis)
{
  const FastCurve& table = axis ? fast_with_axis : fast_quasi_static;
  compare(
      state, flow(unloading, axis), axis,
      [&](const Contact& c) { return table.evaluate(c.x, c.x_max, c.impact_overlap); }, scaled);
}

void kept(benchmark::State& state, bool axis)
{
  const FastCurve& table = axis ? fast_with_axis : fast_quasi_static;
  struct Keeping : Contact
  {
    FastCurve::Reversal reversal;
  };
  std::vector<Keeping> all;
  for (const Contact& c : flow(true, axis)) all.push_back({c, table.reversal(c.x_max, c.impact_overlap)});
  compare(
      state, all, axis, [&](const Keeping& c) { return table.evaluate(c.x, c.reversal); }, scaled);
}

void pair(benchmark::State& state, bool unloading, bool axis)
{
  const FastCurve& table = axis ? fast_with_axis : fast_quasi_static;
  compare(
      state, flow(unloading, axis), axis,
      [&](const Contact& c) { return table.evaluate(pair_mapping, c.r_eff, c.x, c.x_max, c.impact_overlap); },
      [](const ContactForce& f) { return f; });
}

void force(benchmark::State& state, bool unloading, bool axis)
{
  const ContactCurve& curve = axis ? with_axis : quasi_static;
  const FastCurve& table = axis ? fast_with_axis : fast_quasi_static;
  const std::vector<Contact> all = flow(unloading, axis);
  const auto evaluate = [&](const Contact& c) { return table.force(c.x, c.x_max, c.impact_overlap); };
  double error = 0;
  for (const Contact& c : all)
    error = larger(
        error, off(evaluate(c), curve.evaluate(pair_mapping, c.r_eff, c.x, c.x_max, c.impact_overlap).force));
  time(state, all, evaluate);
  state.counters["error_F"] = error;
  state.counters["bytes"] = static_cast<double>(table.bytes());
}

/// The curve itself, against the analytic law (1-D only: the analytic law has no axis).
void reference(benchmark::State& state, bool unloading)
{
  const std::vector<Contact> all = flow(unloading, false);
  double error = 0;
  for (const Contact& c : all)
    error = larger(
        error, off(quasi_static.evaluate(pair_mapping, c.r_eff, c.x, c.x_max).force, exact(c.x, c.x_max)));
  time(state, all,
       [&](const Contact& c) { return quasi_static.evaluate(pair_mapping, c.r_eff, c.x, c.x_max); });
  state.counters["error_F"] = error;
  state.counters["bytes"] = (nodes - 1) * 16.0 * sizeof(double);  // the coefficients
}

/// Hertz: F = 4/3 E* sqrt(R*) d^1.5, dF/dd = 2 E* a, a = sqrt(R* d).
void hertz(benchmark::State& state)
{
  time(state, flow(false, false), [](const Contact& c) {
    const double e_star = pair_mapping.e_star_pair(), a = std::sqrt(c.r_eff * c.x);
    return ContactForce{4.0 / 3.0 * e_star * a * c.x, 2.0 * e_star * a, a, c.x};
  });
  state.counters["error_F"] = 0;
  state.counters["bytes"] = 0;
}

BENCHMARK(hertz)->Name("Hertz");
BENCHMARK_CAPTURE(lookup, 1D_load, false, false);
BENCHMARK_CAPTURE(lookup, 1D_unload, true, false);
BENCHMARK_CAPTURE(lookup, 2D_load, false, true);
BENCHMARK_CAPTURE(lookup, 2D_unload, true, true);
BENCHMARK_CAPTURE(kept, 1D_unload, false);
BENCHMARK_CAPTURE(kept, 2D_unload, true);
BENCHMARK_CAPTURE(pair, 1D_load, false, false);
BENCHMARK_CAPTURE(pair, 1D_unload, true, false);
BENCHMARK_CAPTURE(pair, 2D_load, false, true);
BENCHMARK_CAPTURE(pair, 2D_unload, true, true);
BENCHMARK_CAPTURE(force, 1D_load, false, false);
BENCHMARK_CAPTURE(force, 1D_unload, true, false);
BENCHMARK_CAPTURE(force, 2D_load, false, true);
BENCHMARK_CAPTURE(force, 2D_unload, true, true);
BENCHMARK_CAPTURE(reference, 1D_load, false);
BENCHMARK_CAPTURE(reference, 1D_unload, true);

}  // namespace
