// Properties of every law the library accepts, on any path of a contact: RapidCheck draws the law and the
// path.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <random>

#include "base/larger.hpp"
#include "contact/contact.hpp"
#include "synthetic_law.hpp"

namespace granulaw::contact_paths_test {

using tests::SyntheticLaw;

/// One contact, driven by hand: overlaps in units of the law's length, forces so that loading() is the force.
/// The one place with the state of a contact.
class Contact
{
 public:
  Contact(const Curve& curve, const PairMapping& pair, double r_eff)
      : curve_(&curve), pair_(pair), r_eff_(r_eff)
  {
  }
  void touch() { delta_max_ = 0; }
  void part() { delta_max_ = 0; }
  Answer move(double delta)
  {
    const Answer f = probe(delta);
    delta_max_ = f.delta_max;
    return f;
  }
  /// Return value of move(); the state stays.
  Answer probe(double delta) const { return answer(*curve_, pair_, r_eff_, delta, delta_max_); }
  double reached() const { return delta_max_; }

 private:
  const Curve* curve_;
  PairMapping pair_;
  double r_eff_, delta_max_ = 0;
};

/// Unit length and unit force: 4/3 E* = 1, R* = 1, a rigid partner.
const PairMapping unit_pair = PairMapping::rigid_partner(0.75);

/// Uniform on 1/parts, 2/parts .. 1 (RapidCheck alone would begin with the smallest).
double fraction(int parts = 100000)
{
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(1, parts + 1)) / static_cast<double>(parts);
}

/// A law with random features, among those that an admissible build can give.
SyntheticLaw any_law()
{
  SyntheticLaw law;
  law.force_reduction = 0.5 + 1.5 * fraction();
  law.depth = 0.2 + 1.3 * fraction();
  law.span_share = 0.7 + 0.3 * fraction();
  law.bend = -0.1 + 0.3 * fraction();
  law.onset = std::pow(10.0, -6 + 4 * fraction());
  law.end = std::pow(10.0, -1.5 + 1.2 * fraction());
  return law;
}
Curve any_curve()
{
  const CurveTable table = any_law().table();
  RC_ASSERT(!Curve::fault(table));
  return Curve(table);
}

/// An overlap between `least` and beyond the table's end, uniform in overlap^(1/4).
double any_overlap(const Curve& curve)
{
  return curve.end() * std::pow(1.1 * fraction(), 4);
}

/// Work that the contact does on its partners along [from, to] at fixed delta_max >= both, exact but for
/// rounding.
double work_below(const Curve& curve, double from, double to, double reached)
{
  if (reached <= curve.onset()) return curve.work(to) - curve.work(from);
  const Reversal r = curve.reversal(reached);
  return r.work(to) - r.work(from);
}

/// Work put into a contact moved from `from` to `to`.
double work_put_in(const Curve& curve, double from, double to, double reached)
{
  if (to <= reached) return work_below(curve, from, to, reached);
  return work_below(curve, from, std::max(from, reached), reached) + curve.work(to) -
         curve.work(std::max(from, reached));
}

/// The exact work functions are those of answer(): Simpson's rule on one path agrees.
TEST(ContactPaths, WorkIsTheIntegralOfTheForce)
{
  const Curve curve = SyntheticLaw{}.curve();
  const auto integral = [&](double from, double to, double reached) {
    const int pieces = 20000;
    const double h = (to - from) / pieces;
    double sum = 0;
    for (int k = 0; k < pieces; ++k)
      for (const auto& [t, weight] : {std::pair{0.0, 1.0}, {0.5, 4.0}, {1.0, 1.0}})
        sum += weight * h / 6 * answer(curve, unit_pair, 1, from + (k + t) * h, reached).force;
    return sum;
  };
  const double top = 0.05, scale = curve.work(top);
  // 2e-6: the kink at u = 0 within one piece of 1/20000
  EXPECT_NEAR(integral(1e-3, top, 1e-3), work_put_in(curve, 1e-3, top, 1e-3), 2e-6 * scale);
  EXPECT_NEAR(integral(0.001, top, top), work_put_in(curve, 0.001, top, top), 2e-6 * scale);
  EXPECT_NEAR(integral(0.048, 0.049, top), work_put_in(curve, 0.048, 0.049, top), 2e-6 * scale);
}

/// A path as a contact of a dense flow has it: loading, partial unloading, reloading, separation, re-impact.
void follow_a_path(const Curve& curve)
{
  Contact contact(curve, unit_pair, 1.0);
  contact.touch();
  double at = 0, work = 0, deepest = 0;
  const int moves = 1 + static_cast<int>(60 * fraction());
  for (int k = 0; k < moves; ++k) {
    const bool parts = fraction(8) == 1;
    const double next = parts ? 0 : any_overlap(curve);
    work += work_put_in(curve, at, next, contact.reached());
    if (parts) {
      contact.part();
      contact.touch();
    } else {
      const Answer f = contact.move(next);
      RC_ASSERT(f.force >= 0 && std::isfinite(f.force));
      RC_ASSERT(f.contact_radius >= 0 && f.stiffness >= 0);
      RC_ASSERT(f.delta_max == contact.reached());
      deepest = larger(deepest, next);
    }
    at = next;
    // Closed here by complete unloading: what comes back is not more than was put in. 1e-9 a move: rounding
    const double comes_back = -work_put_in(curve, at, 0, contact.reached());
    RC_ASSERT(work - comes_back >= -1e-9 * moves * curve.work(deepest));
  }
}

RC_GTEST_PROP(ContactPaths, NoPathGainsEnergyAndNoForceIsNegative, ())
{
  const Curve curve = any_curve();
  for (int path = 0; path < 20; ++path) follow_a_path(curve);  // of 100 laws: 2,000 paths
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

/// stiffness = dF/d(overlap), against a central difference that states its own error: the difference of two
/// steps h and h/2, whose h^2 terms cancel by Richardson's rule, and rounding.
RC_GTEST_PROP(ContactPaths, StiffnessIsTheDerivative, ())
{
  const Curve curve = any_curve();
  const double reached = any_overlap(curve), x = reached * fraction();
  for (const double largest : {0.0, reached}) {
    const Answer f = answer(curve, unit_pair, 1, x, largest);
    if (f.force == 0) continue;
    const double h = 1e-4 * x;
    const auto force = [&](double at) { return answer(curve, unit_pair, 1, at, largest).force; };
    const auto central = [&](double step) { return (force(x + step) - force(x - step)) / (2 * step); };
    const double coarse = central(h), fine = central(h / 2), best = (4 * fine - coarse) / 3;
    // a kink (u = 0, the reversal, the onset, a node: g is C1 only) within h makes the two steps disagree
    const double own_error = std::abs(fine - coarse) + 2e-15 * f.force / h;
    RC_PRE(own_error < 1e-6 * f.stiffness);
    RC_ASSERT(std::abs(best - f.stiffness) <= 1e-6 * f.stiffness + own_error);
  }
}

/// i meets j or j meets i, in whatever order contacts are evaluated: the same bits.
RC_GTEST_PROP(ContactPaths, SameBitsForEitherSideAndAnyOrder, ())
{
  Law law = SyntheticLaw{}.law();
  const double r_i = 1e-3 * fraction(), r_j = 1e-3 * fraction();
  std::vector<std::pair<const char*, const char*>> names = {
      {"powder", "powder"}, {"powder", "glass"}, {"glass", "glass"}};
  struct Pair
  {
    Contact one, other;
    std::vector<double> path;
  };
  std::vector<Pair> contacts;
  for (const auto& [a, b] : names)
    for (int copy = 0; copy < 10; ++copy) {
      const PairLaw ab = resolve_pair(law, a, b, "test"), ba = resolve_pair(law, b, a, "test");
      Pair pair{{*ab.curve, ab.mapping, effective_radius(r_i, r_j)},
                {*ba.curve, ba.mapping, effective_radius(r_j, r_i)},
                {}};
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
