// Law lookup for a million contacts a step: force, stiffness and contact radius, in nanoseconds, with the
// error and the size of what is read on the same line.
//
//   law_benchmark       1-D: slow; 2-D: with a velocity axis, each contact with an X of its own;
//                       load: at its largest overlap; unload: the first step after a reversal
//     lookup            force, stiffness and contact radius from overlap, largest overlap and X
//     kept              force and stiffness of contacts that have kept their reversal, as in LIGGGHTS
//     pair              lookup in SI, pair mapping included
//     force             the force alone
//     lost              the work lost to the largest overlap
//     Hertz             Hertz's formulas: the yardstick
//
// `error_F`: largest relative difference of the loading force from the functions that the table was sampled
// from.
#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <vector>

#include "base/larger.hpp"
#include "contact/contact.hpp"
#include "synthetic_law.hpp"

namespace {

using granulaw::Answer;
using granulaw::Curve;
using granulaw::PairMapping;
using granulaw::Reversal;

const granulaw::tests::SyntheticLaw law;
const Curve slow = law.curve(), with_axis = law.curve_with_axis();
const PairMapping pair_mapping = PairMapping::rigid_partner(0.75);
constexpr std::size_t contacts = 4096;

/// Contacts as a flow has them: overlaps spread over decades, the largest of them a tenth to 1.3 of X.
struct Contact
{
  double x, x_max, latched, r_eff = 1.0;
};
std::vector<Contact> flow(bool unloading, bool axis)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> decade(unloading ? std::log10(law.onset) : -5, -1), part(0.9, 1.0),
      ratio(0.1, 1.3);
  std::vector<Contact> all(contacts);
  for (Contact& c : all) {
    c.x = c.x_max = std::pow(10.0, decade(random));
    if (unloading) c.x = c.x_max * (1 - law.span(c.x_max) * (1 - part(random)));
    if (!unloading) c.x_max = 0;
    c.latched = axis ? std::min(law.end, std::max(c.x, c.x_max) / ratio(random)) : 0.0;
  }
  return all;
}

template <class Contact, class Evaluate>
void time(benchmark::State& state, const std::vector<Contact>& flow, const Curve& curve,
          const Evaluate& evaluate)
{
  std::size_t k = 0;
  for (auto _ : state) {
    const auto f = evaluate(flow[k]);
    benchmark::DoNotOptimize(f);
    k = (k + 1) & (contacts - 1);
  }
  double error = 0;
  for (const Contact& c : flow) error = granulaw::larger(error, std::abs(curve.force(c.x) / law.force(c.x) - 1));
  state.counters["error_F"] = error;
  state.counters["bytes"] = static_cast<double>(curve.bytes());
}

const Curve& curve_of(bool axis)
{
  return axis ? with_axis : slow;
}

/// In the curve's units, as the contact loop has it.
void lookup(benchmark::State& state, bool unloading, bool axis)
{
  const Curve& curve = curve_of(axis);
  time(state, flow(unloading, axis), curve, [&](const Contact& c) {
    if (!curve.unloads(c.x, c.x_max)) return curve.loading(c.x, c.latched);
    const Reversal r = curve.reversal(c.x_max, c.latched);
    return Curve::Loading{r.force(c.x), r.stiffness(c.x), curve.radius(c.x_max)};
  });
}

void kept(benchmark::State& state, bool axis)
{
  struct Keeping : Contact
  {
    Reversal reversal;
  };
  const Curve& curve = curve_of(axis);
  std::vector<Keeping> all;
  for (const Contact& c : flow(true, axis)) all.push_back({c, curve.reversal(c.x_max, c.latched)});
  time(state, all, curve,
       [](const Keeping& c) { return std::pair(c.reversal.force(c.x), c.reversal.stiffness(c.x)); });
}

void pair(benchmark::State& state, bool unloading, bool axis)
{
  const Curve& curve = curve_of(axis);
  time(state, flow(unloading, axis), curve,
       [&](const Contact& c) { return answer(curve, pair_mapping, c.r_eff, c.x, c.x_max, c.latched); });
}

void force(benchmark::State& state, bool unloading, bool axis)
{
  const Curve& curve = curve_of(axis);
  time(state, flow(unloading, axis), curve, [&](const Contact& c) {
    return curve.unloads(c.x, c.x_max) ? curve.reversal(c.x_max, c.latched).force(c.x)
                                       : curve.force(c.x, c.latched);
  });
}

void lost(benchmark::State& state, bool axis)
{
  const Curve& curve = curve_of(axis);
  time(state, flow(true, axis), curve, [&](const Contact& c) { return curve.lost(c.x_max, c.latched); });
}

/// Hertz: F = 4/3 E* sqrt(R*) d^1.5, dF/dd = 2 E* a, a = sqrt(R* d).
void hertz(benchmark::State& state)
{
  time(state, flow(false, false), slow, [](const Contact& c) {
    const double e_star = pair_mapping.e_star_pair(), a = std::sqrt(c.r_eff * c.x);
    return Answer{4.0 / 3.0 * e_star * a * c.x, 2.0 * e_star * a, a, c.x};
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
BENCHMARK_CAPTURE(lost, 1D, false);
BENCHMARK_CAPTURE(lost, 2D, true);

}  // namespace
