// Properties of every law the library accepts, on any path of a contact: RapidCheck draws the law and the path.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <random>

#include "contact/contact.hpp"
#include "law_paths.hpp"
#include "synthetic_law.hpp"

namespace granulaw::contact_paths_test {

using tests::SyntheticLaw;
using tests::unit_pair;

/// Uniform on 1/parts, 2/parts .. 1 (RapidCheck alone would begin with the smallest).
double fraction(int parts = 100000)
{
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(1, parts + 1)) / static_cast<double>(parts);
}

/// A law with random features, among those that an admissible build can give.
Curve any_curve()
{
  SyntheticLaw law;
  law.force_reduction = 0.5 + 1.5 * fraction();
  law.depth = 0.2 + 1.3 * fraction();
  law.span_share = 0.7 + 0.3 * fraction();
  law.bend = -0.1 + 0.3 * fraction();
  law.onset = std::pow(10.0, -6 + 4 * fraction());
  law.end = std::pow(10.0, -1.5 + 1.2 * fraction());
  const CurveTable table = law.table();
  RC_ASSERT(!Curve::fault(table));
  return Curve(table);
}

/// An overlap to beyond the table's end, uniform in overlap^(1/4).
double any_overlap(const Curve& curve)
{
  return curve.end() * std::pow(1.1 * fraction(), 4);
}

/// Loading, partial unloading, reloading, in any order; no force is negative.
RC_GTEST_PROP(ContactPaths, NoClosedCycleGainsEnergy, ())
{
  const Curve curve = any_curve();
  for (int path = 0; path < 3; ++path) tests::no_closed_cycle_gains(curve);
}

RC_GTEST_PROP(ContactPaths, StiffnessIsTheDerivative, ())
{
  tests::stiffness_is_the_derivative(any_curve());
}

/// The force jumps nowhere: at a reversal, on reaching delta_max again, at the onset, at a node, at the end.
RC_GTEST_PROP(ContactPaths, ForceIsContinuous, ())
{
  const Curve curve = any_curve();
  const double reached = any_overlap(curve), step = 1e-9;  // relative
  // Moving by 2 steps changes F by at most 2 step x times the larger stiffness there; 1e-12: rounding.
  const auto jump_free = [&](double x, double largest) {
    const Answer a = answer(curve, unit_pair, 1, x * (1 - step), largest),
                 b = answer(curve, unit_pair, 1, x * (1 + step), largest);
    const double slope = std::max({a.stiffness, b.stiffness, b.force / x});
    return std::abs(b.force - a.force) <= 4 * step * x * slope + 1e-12 * std::max(a.force, b.force);
  };
  RC_ASSERT(jump_free(reached, reached));                // the reversal, and the way back through it
  RC_ASSERT(jump_free(curve.end(), 0));                  // the end of the table, loading
  RC_ASSERT(jump_free(curve.end(), 1.5 * curve.end()));  // and below a reversal beyond it
  RC_ASSERT(jump_free(any_overlap(curve), reached));     // anywhere
  const std::vector<double> nodes = curve.table().nodes();
  RC_ASSERT(jump_free(nodes[static_cast<std::size_t>(fraction() * (nodes.size() - 1))], 0));
}

/// Loading more never gives less force.
RC_GTEST_PROP(ContactPaths, LoadingIsMonotone, ())
{
  const Curve curve = any_curve();
  double last = 0;
  for (int k = 1; k <= 2000; ++k) {
    const double force = curve.loading(curve.end() * std::pow(1.1 * k / 2000, 4)).force;
    RC_ASSERT(force >= last);
    last = force;
  }
}

/// i meets j or j meets i, in whatever order contacts are evaluated: the same bits.
RC_GTEST_PROP(ContactPaths, SameBitsForEitherSideAndAnyOrder, ())
{
  Law law = SyntheticLaw{}.law();
  const double r_i = 1e-3 * fraction(), r_j = 1e-3 * fraction();
  std::vector<std::pair<const char*, const char*>> names = {
      {"powder", "powder"}, {"powder", "glass"}, {"glass", "glass"}};
  struct Contact
  {
    PairLaw law;
    double r_eff, deepest = 0;
    Answer move(double delta)
    {
      const Answer f = answer(*law.curve, law.mapping, r_eff, delta, deepest);
      deepest = f.delta_max;
      return f;
    }
  };
  struct Pair
  {
    Contact one, other;
    std::vector<double> path;
  };
  std::vector<Pair> contacts;
  for (const auto& [a, b] : names)
    for (int copy = 0; copy < 10; ++copy) {
      const PairLaw ab = resolve_pair(law, a, b, "test"), ba = resolve_pair(law, b, a, "test");
      Pair pair{{ab, effective_radius(r_i, r_j)}, {ba, effective_radius(r_j, r_i)}, {}};
      for (int k = 0; k < 20; ++k) pair.path.push_back(ab.max_overlap(1e-4) * fraction());
      contacts.push_back(pair);
    }
  const auto bits = [](const Answer& f) {
    return std::array{std::bit_cast<std::uint64_t>(f.force), std::bit_cast<std::uint64_t>(f.stiffness),
                      std::bit_cast<std::uint64_t>(f.contact_radius),
                      std::bit_cast<std::uint64_t>(f.delta_max)};
  };
  std::vector<std::size_t> order(contacts.size());
  std::iota(order.begin(), order.end(), 0u);
  std::mt19937 draw(*rc::gen::arbitrary<unsigned>());
  for (std::size_t step = 0; step < 20; ++step) {
    std::vector<std::array<std::uint64_t, 4>> first(contacts.size());
    for (std::size_t k = 0; k < contacts.size(); ++k)
      first[k] = bits(contacts[k].one.move(contacts[k].path[step]));
    std::shuffle(order.begin(), order.end(), draw);
    for (const std::size_t k : order)
      RC_ASSERT(bits(contacts[k].other.move(contacts[k].path[step])) == first[k]);
  }
}

}  // namespace granulaw::contact_paths_test
