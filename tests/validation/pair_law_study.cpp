// A law of the pair's own, from two-body impacts, against the pair rule: the table in docs/evidence/pairs.md.
//
//   pair_law_study        about a CPU minute; prints rule/two bodies - 1 and own law/two bodies - 1
//
// Eight impacts and an elastic one make the law; the velocities it is replayed at were not sampled.
#include <fmt/format.h>

#include <cstdio>
#include <limits>
#include <vector>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "characterise/fit/fit_curve.hpp"
#include "characterise/pair/reduction_error.hpp"
#include "law/replay.hpp"

namespace {

using namespace granulaw;

/// nu = 0.3; e_over_y 0: elastic.
LawMaterial material(double e_star, double e_over_y, double density)
{
  LawMaterial m;
  m.density = density, m.poisson_ratio = 0.3, m.youngs_modulus = e_star * (1 - 0.09);
  if (e_over_y > 0) m.yield_stress = e_star / e_over_y;
  return m;
}

BodyLaw own_law(const UnlikePair& pair, const RunOptions& options)
{
  std::vector<ContactRecord> presses;
  for (const double speed : {1.8, 3.2, 6., 11., 20., 36., 60., 100.})
    presses.push_back(two_body_record(pair, speed * pair.yield_velocity(), options));
  UnlikePair elastic = pair;
  elastic.yielding.yield_stress = elastic.partner.yield_stress = std::numeric_limits<double>::infinity();
  const ContactRecord press = two_body_record(elastic, 15 * pair.yield_velocity(), options);
  const LawMaterial& s = pair.yielding;
  const double onset = onset_overlap(s.e_star(), s.yield_stress, s.poisson_ratio);
  BodyLaw law;
  law.material = s;
  law.curve = fit_plastic(presses, fit_elastic(press), onset, presses.back().depth).curve;
  return law;
}

void study(const char* name, const UnlikePair& pair)
{
  RunOptions options;
  options.resolution = 14, options.precision = Precision::single;
  const BodyLaw law = own_law(pair, options);
  for (const double speed : {4.4, 15., 47., 77.}) {
    const double v = speed * pair.yield_velocity();
    const Replay own = replay_collision({{&law.curve, pair.mapping()}, &law}, pair.r_eff(), pair.m_eff(), v);
    const RunSummary rule = run_as_one_body(pair, v, options), truth = run_two_bodies(pair, v, options);
    fmt::print(
        "{:28} V/V_y {:4g}: rule F {:+.4f} e {:+.4f} time {:+.4f}; own law F {:+.4f} e {:+.4f} time "
        "{:+.4f}\n",
        name, speed, rule.force_max / truth.force_max - 1, rule.restitution / truth.restitution - 1,
        rule.contact_time / truth.contact_time - 1, own.force_max / truth.force_max - 1,
        own.restitution / truth.restitution - 1, own.contact_time / truth.contact_time - 1);
    std::fflush(stdout);
  }
}

}  // namespace

int main()
{
  try {
    const LawMaterial s = material(1, 100, 1);
    study("elastic partner of like E*", {s, material(1, 0, 1), 1});
    study("elastic, 10 times as stiff", {s, material(10, 0, 10), 1});
    study("one material, 1:10", {s, s, 10});
    study("Y_h/Y_s = 1.5, 1:3", {s, material(1, 66.7, 1), 3});
  } catch (const Error& error) {
    fmt::print(stderr, "pair_law_study: {}\n", error.what());
    return 2;
  }
}
