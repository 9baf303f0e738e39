// Errors of composed laws of unlike pairs: random mixtures against two-body impacts.
//
//   granulaw_mixtures_study ATLAS FOLDER SEED COUNT    runs are kept in FOLDER and not made again; prints
//   each case and
//                                                      the summary, writes FOLDER/mixtures_SEED.csv
//
// Random mixtures, uniform in the logarithm: E* ratio 0.1 to 1000, Y ratio 1 to 10 or elastic (3 of
// 10), density ratio 0.3 to 10, radius ratio 0.1 to 10, E*/Y of the yielding body 30 to 1000, nu 0.1 to 0.45,
// hardening 0.001 to 0.1 of E in 3 of 10, V/V_y 2 to 100; up to I = 0.003 and Hertz's overlap of 0.13 R*.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "characterise/atlas_file.hpp"
#include "base/error.hpp"
#include "atlas/composed_law.hpp"
#include "characterise/pair/two_body_runs.hpp"
#include "farm/run_cache.hpp"
#include "law/radiation.hpp"
#include "law/replay.hpp"
#include "solver/solver_id.hpp"

namespace {

using namespace granulaw;

struct Mixture
{
  UnlikePair pair;
  double v_over_vy;
  double velocity() const { return v_over_vy * pair.yield_velocity(); }
  double damage_number() const
  {
    return velocity() * velocity() * pair.one_body_density() / pair.yielding.yield_stress;
  }
  /// Over R*.
  double hertz_overlap() const
  {
    const double r = pair.r_eff(), v = velocity();
    return std::pow(15.0 / 16.0 * pair.m_eff() * v * v / (pair.mapping().e_star_pair() * r * r * r), 0.4);
  }
};

/// Units of the yielding body: E* = rho = R = 1.
LawMaterial material(const char* name, double e_star, double poisson_ratio, double density)
{
  LawMaterial m;
  m.name = name, m.density = density, m.poisson_ratio = poisson_ratio;
  m.youngs_modulus = e_star * (1 - poisson_ratio * poisson_ratio);
  return m;
}

class RandomMixtures
{
 public:
  explicit RandomMixtures(unsigned seed) : random_(seed) {}

  Mixture next()
  {
    constexpr double fastest = 0.003, deepest = 0.13;
    while (true) {
      const Mixture mixture = any();
      const LawMaterial &s = mixture.pair.yielding, &h = mixture.pair.partner;
      if (h.yield_stress < s.yield_stress) continue;
      if (mixture.damage_number() <= fastest && mixture.hertz_overlap() <= deepest) return mixture;
    }
  }

 private:
  double share() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low * std::pow(high / low, share()); }
  double poisson_ratio() { return 0.1 + 0.35 * share(); }

  Mixture any()
  {
    const double stiffness = between(30, 1000), nu = poisson_ratio(), other_nu = poisson_ratio();
    const double e_ratio = between(0.1, 1000), density = between(0.3, 10);
    const bool elastic = share() < 0.3;
    const double y_ratio = between(1, 10), radius = between(0.1, 10), v_over_vy = between(2, 100);
    const bool hardens = share() < 0.3;
    LawMaterial s = material("yielding", 1, nu, 1), h = material("partner", e_ratio, other_nu, density);
    s.yield_stress = 1 / stiffness;
    if (!elastic) h.yield_stress = std::min(y_ratio / stiffness, 0.09 * e_ratio);  // the solver's limit
    if (hardens) s.hardening_modulus = between(0.001, 0.1) * s.youngs_modulus;
    if (hardens && !elastic) h.hardening_modulus = between(0.001, 0.1) * h.youngs_modulus;
    return {{s, h, radius}, v_over_vy};
  }

  std::mt19937_64 random_;  // its numbers are the standard's: the same cases everywhere
};

/// The impact of the two bodies, from the cache if it was made.
RunSummary run(const Mixture& m, RunCache& cache)
{
  RunOptions options;
  options.resolution = 14, options.shifted_grids = 2, options.precision = Precision::single;
  const LawMaterial &s = m.pair.yielding, &h = m.pair.partner;
  const std::string key = fmt::format(
      "mixture {:.9g} {:.9g} {:.9g} | {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} | {:.9g} {:.9g} cells={} grids={} "
      "solver={}",
      s.poisson_ratio, s.yield_stress, s.hardening_modulus, h.youngs_modulus, h.poisson_ratio, h.yield_stress,
      h.hardening_modulus, h.density, m.pair.radius_ratio, m.velocity(), options.resolution,
      options.shifted_grids, solver_id());
  RunOutcome outcome;
  if (cache.load(key, outcome)) return outcome.result.summary;
  outcome.result.summary = run_two_bodies(m.pair, m.velocity(), options);
  outcome.cpu_s = outcome.result.summary.cpu_s;
  cache.store(key, outcome.cpu_s, outcome);
  return outcome.result.summary;
}

struct Deviation
{
  double force, restitution, stated_force, stated_restitution;  // of F relative, of e absolute; signed
};

Deviation compare(const Atlas& atlas, const Mixture& m, const RunSummary& truth)
{
  const LawMaterial &s = m.pair.yielding, &h = m.pair.partner;
  const TwoBodyLaw own = compose_law(atlas, PairBody(atlas, s), PairBody(atlas, h), m.pair.radius_ratio, {});
  const PairLaw law{{&own.law.curve, m.pair.mapping(), radiation(s, 1.0, h, m.pair.radius_ratio)}, &own.law};
  const Replay replay = replay_collision(law, m.pair.r_eff(), m.pair.m_eff(), m.velocity());
  const Certificate& c = own.law.certificate;
  return {replay.force_max / truth.force_max - 1, replay.restitution - truth.restitution, c.atlas_error_force,
          c.atlas_error_restitution};
}

double quantile(std::vector<double> values, double share)
{
  for (double& v : values) v = std::abs(v);
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

void print_summary(const std::vector<Deviation>& all)
{
  std::vector<double> force, restitution, claim_force, claim_restitution;
  int within = 0, force_true = 0, restitution_true = 0;
  for (const Deviation& d : all) {
    force.push_back(d.force), restitution.push_back(d.restitution);
    claim_force.push_back(d.stated_force / std::abs(d.force));
    claim_restitution.push_back(d.stated_restitution / std::abs(d.restitution));
    within += std::abs(d.force) <= 0.015 && std::abs(d.restitution) <= 0.012;
    force_true += std::abs(d.force) <= d.stated_force;
    restitution_true += std::abs(d.restitution) <= d.stated_restitution;
  }
  const auto n = static_cast<double>(all.size());
  fmt::print("{} mixtures: {:.1f} % within 1.5 % of F and 0.012 of e\n", all.size(), 100 * within / n);
  fmt::print(
      "F: median {:.2f} %, 95 % {:.2f} %, largest {:.2f} %; stated error true in {:.1f} %, median of stated "
      "over "
      "real {:.2g}\n",
      100 * quantile(force, 0.5), 100 * quantile(force, 0.95), 100 * quantile(force, 1), 100 * force_true / n,
      quantile(claim_force, 0.5));
  fmt::print(
      "e: median {:.4f}, 95 % {:.4f}, largest {:.4f}; stated error true in {:.1f} %, median of stated over "
      "real "
      "{:.2g}\n",
      quantile(restitution, 0.5), quantile(restitution, 0.95), quantile(restitution, 1),
      100 * restitution_true / n, quantile(claim_restitution, 0.5));
}

void study(const std::string& atlas_file, const std::string& folder, unsigned seed, int count)
{
  const Atlas atlas = read_atlas(atlas_file);
  RunCache cache(folder);
  RandomMixtures mixtures(seed);
  std::ofstream table(fmt::format("{}/mixtures_{}.csv", folder, seed));
  const std::string header =
      "E_over_Y,nu,H_over_E,stiffness_ratio,partner_nu,partner_E_over_Y,density_ratio,radius_ratio,V_over_Vy,"
      "damage_number,e,error_force,error_e,stated_force,stated_e,cpu_s\n";
  table << header;
  std::vector<Deviation> all;
  for (int k = 0; k < count; ++k) {
    const Mixture m = mixtures.next();
    try {
      const RunSummary truth = run(m, cache);
      const Deviation d = compare(atlas, m, truth);
      all.push_back(d);
      const LawMaterial &s = m.pair.yielding, &h = m.pair.partner;
      const std::string line = fmt::format(
          "{:.5g},{:.3g},{:.3g},{:.5g},{:.3g},{:.5g},{:.4g},{:.4g},{:.4g},{:.3g},{:.4f},{:+.5f},{:+.5f},{:."
          "4f},{:.4f},"
          "{:.3g}\n",
          1 / s.yield_stress, s.poisson_ratio, s.hardening_modulus / s.youngs_modulus, h.e_star(),
          h.poisson_ratio, h.yields() ? h.e_star() / h.yield_stress : 0.0, h.density, m.pair.radius_ratio,
          m.v_over_vy, m.damage_number(), truth.restitution, d.force, d.restitution, d.stated_force,
          d.stated_restitution, truth.cpu_s);
      table << line << std::flush;
      fmt::print("{}", line);
      std::fflush(stdout);
    } catch (const Error& error) {
      fmt::print("{}: {}\n", k, error.what());
    }
  }
  if (!all.empty()) print_summary(all);
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc != 5) {
    fmt::print(stderr, "usage: granulaw_mixtures_study ATLAS FOLDER SEED COUNT\n");
    return 2;
  }
  try {
    study(argv[1], argv[2], static_cast<unsigned>(std::stoul(argv[3])), std::stoi(argv[4]));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
