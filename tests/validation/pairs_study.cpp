// Errors of the pair rule: two-body collisions against the one-body law carried to the pair.
//
//   pairs_study FOLDER [GROUP]     runs are kept in FOLDER and not made again; writes FOLDER/pairs.csv
//
// Each case is run as two bodies and as the one sphere that stands for them by the rule
// (one_body_runs.hpp), both at two resolutions. Errors are rule/two bodies - 1; the uncertainty is what the
// two resolutions differ by. Groups: radius, stiffness, strength, wall, press, mixture. Read by
// pairs_page.py.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "farm/run_cache.hpp"
#include "solver/solver_id.hpp"
#include "one_body_runs.hpp"

namespace {

using namespace granulaw;
using namespace granulaw::tests;

struct Case
{
  std::string group;
  UnlikePair pair;
  double v_over_vy;  ///< of an impact
  double press = 0;  ///< overlap/(lambda R*) of a slow press instead
};

/// E* = rho = 1.
LawMaterial material(double e_over_y, double e_star = 1, double nu = 0.3, double density = 1)
{
  LawMaterial m;
  m.density = density, m.poisson_ratio = nu, m.youngs_modulus = e_star * (1 - nu * nu);
  if (e_over_y > 0) m.yield_stress = 1 / e_over_y;
  return m;
}

/// Hertz's overlap of an impact over R*. Beyond a few tenths there is no contact law, whatever the rule.
constexpr double deepest = 0.13;
double elastic_overlap(const UnlikePair& p, double velocity)
{
  const double r = p.r_eff();
  return std::pow(15.0 / 16.0 * p.m_eff() * velocity * velocity / (p.mapping().e_star_pair() * r * r * r),
                  0.4);
}

std::vector<Case> all_cases()
{
  std::vector<Case> cases;
  const auto add = [&](const char* group, double e_over_y, std::initializer_list<double> speeds,
                       const LawMaterial& partner, double radius_ratio) {
    for (const double v : speeds) {
      const UnlikePair pair{material(e_over_y), partner, radius_ratio};
      if (elastic_overlap(pair, v * pair.yield_velocity()) < deepest) cases.push_back({group, pair, v});
    }
  };
  for (const double ratio : {1., 1.5, 2., 3., 5., 10.})
    add("radius", 100, {5, 20, 100}, material(100), ratio);
  for (const double ratio : {1., 3., 10.}) add("radius", 30, {5}, material(30), ratio);
  for (const double ratio : {1., 3., 10.}) add("radius", 1000, {60, 600}, material(1000), ratio);

  for (const double stiffness : {0.1, 0.3, 1., 3., 10., 1000.}) {
    // a stiff partner is as much heavier: waves of the same speed, else the time step would be its own
    const LawMaterial partner = material(0, stiffness, 0.3, stiffness > 100 ? stiffness : 1);
    add("stiffness", 100, {5, 20, 100}, partner, 1);
    add("stiffness", 30, {5}, partner, 1);
    add("stiffness", 1000, {60, 600}, partner, 1);
  }
  for (const double strength : {1.1, 1.5, 2., 4.}) {
    add("strength", 100, {5, 20, 100}, material(100 / strength), 1);
    if (strength < 3) add("strength", 30, {5}, material(30 / strength), 1);  // the solver takes Y < E*/10
    add("strength", 1000, {60, 600}, material(1000 / strength), 1);
  }
  const double wall = std::numeric_limits<double>::infinity();
  add("wall", 100, {5, 20, 100}, material(100), wall);
  add("wall", 100, {20}, material(25), wall);
  for (const double stiffness : {10., 1000.})
    add("wall", 100, {20}, material(0, stiffness, 0.3, stiffness > 100 ? stiffness : 3), wall);
  // slow presses: what is left without waves
  for (const double ratio : {1., 3., 10.})
    for (const double depth : {0.007, 0.03})
      cases.push_back({"press", {material(100), material(100), ratio}, 0, depth});
  for (const double stiffness : {1., 10.})
    for (const double depth : {0.007, 0.03})
      cases.push_back({"press", {material(100), material(0, stiffness, 0.3, stiffness), 1}, 0, depth});

  std::mt19937_64 random(4);  // the engine's numbers are the standard's: the same cases everywhere
  const auto between = [&](double low, double high) {
    return low * std::pow(high / low, static_cast<double>(random() >> 11) * 0x1p-53);
  };
  for (int k = 0; k < 16; ++k) {
    const LawMaterial yielding = material(between(40, 400), 1, between(0.1, 0.45));
    const double stiffness = between(0.3, 10), strength = between(1, 4);
    LawMaterial partner = material(0, stiffness, between(0.1, 0.45), stiffness * between(0.5, 2));
    partner.yield_stress =
        std::min(strength * yielding.yield_stress, 0.09 * stiffness);  // the solver's limit
    const UnlikePair pair{yielding, partner, between(0.2, 5)};
    const double v = between(8, 100);
    if (elastic_overlap(pair, v * pair.yield_velocity()) < deepest) cases.push_back({"mixture", pair, v});
  }
  return cases;
}

/// `run` at two resolutions, from the cache where it is there: {coarse, fine}.
struct TwoResolutions
{
  RunSummary coarse, fine;
};

class Runner
{
 public:
  explicit Runner(const std::string& folder) : cache_(folder) {}

  TwoResolutions both(const Case& c, bool two_bodies)
  {
    const auto one = [&](int cells) {
      const LawMaterial &s = c.pair.yielding, &h = c.pair.partner;
      const std::string key = fmt::format(
          "{} {:.6g} {:.6g} {:.6g} | {:.6g} {:.6g} {:.6g} {:.6g} | {:.6g} {}={:.6g} cells={} solver={}",
          two_bodies ? "two" : "one", s.youngs_modulus, s.poisson_ratio, s.yield_stress, h.youngs_modulus,
          h.poisson_ratio, h.yield_stress, h.density, c.pair.radius_ratio, c.press > 0 ? "press" : "V/Vy",
          c.press > 0 ? c.press : c.v_over_vy, cells, solver_id());
      RunOutcome outcome;
      RunResult& kept = outcome.result;
      if (cache_.load(key, outcome)) return kept.summary;
      RunOptions o;
      o.resolution = cells, o.precision = Precision::single,
      o.shifted_grids = s.yield_stress < 0.002 && c.v_over_vy < 100 ? 2 : 4;  // slow and stiff: long
      const double v = c.v_over_vy * c.pair.yield_velocity();
      if (c.press > 0) {
        o.shifted_grids = 2;
        kept.summary = two_bodies ? press_two_bodies(c.pair, c.press, ramp, o)
                                  : press_as_one_body(c.pair, c.press, ramp, o);
      } else
        kept.summary = two_bodies ? run_two_bodies(c.pair, v, o) : run_as_one_body(c.pair, v, o);
      outcome.cpu_s = kept.summary.cpu_s;
      cache_.store(key, outcome.cpu_s, outcome);
      spent_ += kept.summary.cpu_s;
      return kept.summary;
    };
    return {one(coarse), one(fine)};
  }
  double spent() const { return spent_; }

  static constexpr int coarse = 10, fine = 14;
  static constexpr double ramp = 60;  // R/c*: 120 changes F and e by 0.1 % (docs/evidence/solver-accuracy.md)

 private:
  RunCache cache_;
  double spent_ = 0;
};

/// Relative error of the rule in one quantity, and its uncertainty: twice the change from the coarser grids,
/// as in solver/run/accuracy.hpp.
struct Deviation
{
  double value, uncertainty;
};
Deviation deviation(const TwoResolutions& rule, const TwoResolutions& truth, double RunSummary::*quantity)
{
  const double fine = rule.fine.*quantity / (truth.fine.*quantity) - 1;
  const double coarse = rule.coarse.*quantity / (truth.coarse.*quantity) - 1;
  return {fine, 2 * std::abs(fine - coarse)};
}

int study(const std::string& folder, const std::string& only)
{
  Runner runner(folder);
  std::string table =
      "group,E_over_Y,nu,radius_ratio,stiffness_ratio,partner_E_over_Y,partner_nu,density_ratio,V_over_Vy,"
      "depth,"
      "inertia,e,error_force,error_e,error_time,error_overlap,unc_force,unc_e,unc_time,unc_overlap,cpu_s\n";
  int within = 0, over = 0;
  for (const Case& c : all_cases()) {
    if (!only.empty() && c.group != only) continue;
    const TwoResolutions rule = runner.both(c, false), truth = runner.both(c, true);
    const UnlikePair& p = c.pair;
    const double depth = truth.fine.delta_max / p.mapping().length(p.r_eff());
    const double v = c.v_over_vy * p.yield_velocity();
    const double damage_number = v * v * p.one_body_density() / p.yielding.yield_stress;
    std::string line = fmt::format(
        "{},{:.5g},{:.4g},{:.4g},{:.5g},{:.5g},{:.4g},{:.5g},{:.5g},{:.4g},{:.3g},{:.4g}", c.group,
        p.yielding.e_star() / p.yielding.yield_stress, p.yielding.poisson_ratio, p.radius_ratio,
        p.partner.e_star() / p.yielding.e_star(),
        p.partner.yields() ? p.partner.e_star() / p.partner.yield_stress : 0.0, p.partner.poisson_ratio,
        p.partner.density / p.yielding.density, c.v_over_vy, depth, damage_number, truth.fine.restitution);
    if (const ReductionError bound = estimate_reduction_error(p, v); c.press == 0 && bound.within_measured) {
      ++within;
      over += std::abs(deviation(rule, truth, &RunSummary::force_max).value) > bound.force ||
              std::abs(deviation(rule, truth, &RunSummary::restitution).value) > bound.restitution;
    }
    std::string uncertainties;
    for (const auto q : {&RunSummary::force_max, &RunSummary::restitution, &RunSummary::contact_time,
                         &RunSummary::delta_max}) {
      const Deviation d = deviation(rule, truth, q);
      line += fmt::format(",{:.5f}", d.value), uncertainties += fmt::format(",{:.5f}", d.uncertainty);
    }
    line += uncertainties + fmt::format(",{:.3g}\n", truth.fine.cpu_s + truth.coarse.cpu_s);
    fmt::print("{}", line);
    std::fflush(stdout);
    table += line;
  }
  std::ofstream(folder + "/pairs.csv") << table;
  fmt::print("{} impacts, {} beyond estimate_reduction_error; {:.0f} CPU seconds spent on runs\n", within,
             over, runner.spent());
  return over <= 0.05 * within ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc < 2) {
    fmt::print(stderr, "pairs_study FOLDER [GROUP]\n");
    return 2;
  }
  try {
    return study(argv[1], argc > 2 ? argv[2] : "");
  } catch (const Error& error) {
    fmt::print(stderr, "pairs_study: {}\n", error.what());
    return 2;
  }
}
