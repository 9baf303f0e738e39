// Errors of composed laws of unlike pairs: random mixtures against two-body impacts.
//
//   granulaw_mixtures_study ATLAS FOLDER SEED COUNT    runs are kept in FOLDER and not made again; prints each case and
//                                                      the summary, writes FOLDER/mixtures_SEED.csv. 60: 7 CPU minutes
//
// Random mixtures, uniform in the logarithm: E* ratio 0.1 to 100, Y ratio 1 to 10 or elastic (3 of
// 10), density ratio 0.3 to 10, radius ratio 0.1 to 10, E*/Y of the yielding body 30 to 1000, nu 0.1 to 0.45,
// hardening 0.001 to 0.1 of E in 3 of 10, V/V_y from 2 to where the law's error bound ends. Every third is a pair as of
// shot, grinding media and ore: E* ratio 0.5 to 2, radius ratio 3 to 10 either way, E*/Y 200 to 1000.
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
#include "law/damage_number.hpp"
#include "law/error_bound.hpp"
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
  double damage_number() const { return granulaw::damage_number(pair.yielding, pair.mapping(), velocity()); }
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
    const bool like = ++drawn_ % 3 == 0;
    Mixture mixture = any(like);
    while (mixture.pair.partner.yield_stress < mixture.pair.yielding.yield_stress) mixture = any(like);
    return mixture;
  }

 private:
  double share() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low * std::pow(high / low, share()); }
  double poisson_ratio() { return 0.1 + 0.35 * share(); }

  Mixture any(bool like)
  {
    const double stiffness = between(like ? 200 : 30, 1000), nu = poisson_ratio(), other_nu = poisson_ratio();
    const double e_ratio = like ? between(0.5, 2) : between(0.1, 100), density = between(0.3, 10);
    const bool elastic = share() < 0.3;
    const double y_ratio = between(1, 10), size = like ? between(3, 10) : between(0.1, 10);
    const double radius = like && share() < 0.5 ? 1 / size : size;
    const bool hardens = share() < 0.3;
    LawMaterial s = material("yielding", 1, nu, 1), h = material("partner", e_ratio, other_nu, density);
    s.yield_stress = 1 / stiffness;
    if (!elastic) h.yield_stress = std::min(y_ratio / stiffness, 0.09 * e_ratio);  // the solver's limit
    if (hardens) s.hardening_modulus = between(0.001, 0.1) * s.youngs_modulus;
    if (hardens && !elastic) h.hardening_modulus = between(0.001, 0.1) * h.youngs_modulus;
    const UnlikePair pair{s, h, radius};
    const double fastest = std::sqrt(composed_damage_number(pair) / granulaw::damage_number(s, pair.mapping(), 1));
    return {pair, between(2, std::max(2.0, fastest / pair.yield_velocity()))};
  }

  int drawn_ = 0;
  std::mt19937_64 random_;  // its numbers are the standard's: the same cases everywhere
};

/// The impact of the two bodies, from the cache if it was made.
RunSummary run(const Mixture& m, RunCache& cache)
{
  RunOptions options;
  options.resolution = 14, options.shifted_grids = 4, options.precision = Precision::single;
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
  const ErrorBound stated = own.law.bound;
  return {replay.force_max / truth.force_max - 1, replay.restitution - truth.restitution, stated.force,
          stated.restitution_at(replay.restitution)};
}

double quantile(std::vector<double> values, double share)
{
  for (double& v : values) v = std::abs(v);
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

/// `own`: of errors, relative or absolute; `stated`: their bounds.
void print_line(const char* name, double unit, const std::vector<double>& own, const std::vector<double>& stated)
{
  int within = 0;
  double mean = 0;
  for (std::size_t k = 0; k < own.size(); ++k)
    within += std::abs(own[k]) <= stated[k], mean += stated[k] / static_cast<double>(own.size());
  const double most = quantile(own, 0.95);
  fmt::print("{}: median {:.3g}, 95 % {:.3g}, largest {:.3g}; within the bound {} of {}; mean bound {:.3g}, over the 95 % {:.2g}\n",
             name, quantile(own, 0.5) / unit, most / unit, quantile(own, 1) / unit, within, own.size(), mean / unit, mean / most);
}

void print_summary(const std::vector<Deviation>& all)
{
  std::vector<double> force, restitution, bound_force, bound_restitution;
  for (const Deviation& d : all) {
    force.push_back(d.force), bound_force.push_back(d.stated_force);
    restitution.push_back(d.restitution), bound_restitution.push_back(d.stated_restitution);
  }
  print_line("F, %", 0.01, force, bound_force);
  print_line("e", 1, restitution, bound_restitution);
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
