// Plastic oblique impacts of two unlike deformable spheres with friction under `tangential history` and `tangential
// plastic`, by laws composed of the two materials', against the solver in three dimensions. Materials, sizes, speeds,
// angles and frictions are random, their seed fixed before anything was run.
//
//   oblique_pairs_study FOLDER --atlas ATLAS.h5 [--pairs N] [--throws N] [--cells N] [--steps N] [--most E,V,OMEGA]
//   runs are kept in FOLDER and not made again; prints the table of docs/evidence/oblique.md; with --most fails where
//   `plastic` errs by more, per cent
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <random>

#include "atlas/composed_law.hpp"
#include "atlas/unlike_pair.hpp"
#include "base/error.hpp"
#include "characterise/atlas_file.hpp"
#include "characterise/body/characterised_body.hpp"
#include "farm/farm.hpp"
#include "law/oblique.hpp"
#include "law/radiation.hpp"
#include "solver/runs.hpp"
#include "solver/solver_id.hpp"

namespace {

using namespace granulaw;

constexpr double radius = 1e-3;        // m, of the thrown, yielding sphere
constexpr double damping_ratio = 0.1;  // the plug-in's default

struct Setting
{
  std::string atlas;
  int pairs = 3, throws = 2, cells = 8, steps = 20000;
  std::vector<double> most;
};

/// Two spheres, their relative normal speed, and Coulomb's coefficient.
struct Meeting
{
  UnlikePair pair;
  double v_over_vy, friction = 0, angle = 0;  // degrees from the normal

  double velocity() const { return v_over_vy * pair.yield_velocity(); }
  double along() const { return velocity() * std::tan(angle * M_PI / 180); }
  double partner_radius() const { return radius * pair.radius_ratio; }
};

class Lottery
{
 public:
  Meeting pair()
  {
    for (;;) {
      Meeting m;
      LawMaterial &s = m.pair.yielding, &h = m.pair.partner;
      s.density = 1500, s.poisson_ratio = between(0.15, 0.45);
      s.youngs_modulus = 9.1e9, s.yield_stress = s.e_star() / between(40, 300);
      h.density = s.density * between(0.5, 2), h.poisson_ratio = between(0.15, 0.45);
      h.youngs_modulus = s.youngs_modulus * between(0.5, 3);
      h.yield_stress = s.yield_stress * between(1, 2.5);
      m.pair.radius_ratio = between(0.5, 2);
      m.v_over_vy = between(15, 200);
      // dents of a twentieth of R*, and materials that the atlas holds
      if (hertz_overlap(m) > 0.01 && hertz_overlap(m) < 0.06 && h.e_star() / h.yield_stress > 30) return m;
    }
  }
  Meeting thrown(Meeting m)
  {
    m.friction = between(0.1, 0.6), m.angle = between(10, 70);
    return m;
  }

 private:
  double between(double low, double high)
  {
    return low * std::pow(high / low, static_cast<double>(random_() >> 11) * 0x1p-53);
  }
  /// Over R*.
  static double hertz_overlap(const Meeting& m)
  {
    const double r = m.pair.r_eff(), v = m.velocity() / m.pair.wave_speed();
    const double e_star = m.pair.mapping().e_star_pair() / m.pair.yielding.e_star();
    return std::pow(15.0 / 16.0 * m.pair.m_eff() * v * v / (e_star * r * r * r), 0.4);
  }

  std::mt19937_64 random_{56};  // its numbers are the standard's: the same cases everywhere
};

Particle sphere_of(const LawMaterial& m, double r)
{
  Material material;
  material.density = m.density, material.youngs_modulus = m.youngs_modulus;
  material.poisson_ratio = m.poisson_ratio, material.yield_stress = m.yield_stress;
  return Particle::sphere(r, material);
}

RunJob job_of(const Meeting& m, const Setting& s)
{
  const Particle thrown = sphere_of(m.pair.yielding, radius);
  Partner partner;
  partner.particle = sphere_of(m.pair.partner, m.partner_radius());
  Approach approach;
  approach.velocity = m.velocity(), approach.tangential_velocity = m.along(), approach.friction = m.friction;
  RunJob job;
  job.key = fmt::format("oblique pair {} | {} {:.17g} v={:.17g} vt={:.17g} mu={:.17g} cells={} solver={}",
                        description_of(thrown.materials[0]), description_of(partner.particle->materials[0]),
                        m.pair.radius_ratio, approach.velocity, approach.tangential_velocity, m.friction, s.cells,
                        solver_id());
  job.run = [=](const RunOptions& given) {
    RunOptions options = given;
    options.resolution = s.cells, options.shifted_grids = 1, options.precision = Precision::single;
    return impact(thrown, approach, partner, options);
  };
  return job;
}

/// e, tangential velocity over that before, and R omega/V of both spheres.
using Motion = std::array<double, 4>;

Motion by_law(const PairLaw& law, const Meeting& m, TangentialKind kind, int steps)
{
  const auto mass = [](const LawMaterial& material, double r) { return material.density * 4.0 / 3.0 * M_PI * r * r * r; };
  const LawMaterial& h = m.pair.partner;
  const double other = m.partner_radius();
  const ObliqueThrow thrown{radius, mass(m.pair.yielding, radius), m.velocity(), m.along(),
                            {other, mass(h, other), {h.youngs_modulus, h.poisson_ratio}}};
  const ObliqueAnswer a = replay_oblique(law, thrown, kind, m.friction, damping_ratio, steps);
  return {a.restitution, a.tangential / m.along(), radius * a.spin / m.velocity(), radius * a.partner_spin / m.velocity()};
}

/// Per cent: of e and the spins, and of the tangential velocity before.
Motion off(const Motion& told, const Motion& solver)
{
  return {100 * (told[0] / solver[0] - 1), 100 * (told[1] - solver[1]), 100 * (told[2] / solver[2] - 1),
          100 * (told[3] / solver[3] - 1)};
}

std::string words(const Motion& m, const char* number)
{
  return fmt::format(fmt::runtime(fmt::format("{0}; {0}; {0}, {0}", number)), m[0], m[1], m[2], m[3]);
}

/// Prints a line of the table; true if `plastic` is good enough.
bool compare(const Atlas& atlas, const Meeting& m, const RunResult& run, const Setting& s)
{
  const LawMaterial &yielding = m.pair.yielding, &partner = m.pair.partner;
  LawRange range;
  range.depth = 0.3, range.fastest = 0.3;
  const TwoBodyLaw own = compose_law(atlas, PairBody(atlas, yielding), PairBody(atlas, partner), m.pair.radius_ratio, range);
  const PairLaw law{{&own.law.curve, m.pair.mapping(), radiation(yielding, 1.0, partner, m.pair.radius_ratio)}, &own.law};
  const Rebound& r = *run.rebound;
  const double turning = radius / m.velocity();
  const Motion solver{r.normal, r.tangential, turning * r.spin[1], turning * r.partner_spin[1]};
  const Motion plastic = off(by_law(law, m, TangentialKind::plastic, s.steps), solver);
  fmt::print("| {:.0f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.0f} | {:.3f} | {:.2f} | {:.0f} | {} | {} | {} |\n",
             yielding.e_star() / yielding.yield_stress, partner.e_star() / yielding.e_star(),
             partner.yield_stress / yielding.yield_stress, partner.density / yielding.density, m.pair.radius_ratio,
             m.v_over_vy, run.summary.delta_max / (radius * m.pair.r_eff()), m.friction, m.angle, words(solver, "{:.3f}"),
             words(off(by_law(law, m, TangentialKind::history, s.steps), solver), "{:+.1f}"), words(plastic, "{:+.1f}"));
  std::fflush(stdout);
  if (s.most.empty()) return true;
  const std::array<double, 4> most{s.most[0], s.most[1], s.most[2], s.most[2]};
  for (std::size_t k = 0; k < most.size(); ++k)
    if (!(std::abs(plastic[k]) <= most[k])) return false;
  return true;
}

bool study(const Setting& s, Farm& farm)
{
  bool good = true;
  const Atlas atlas = read_atlas(s.atlas);
  Lottery lottery;
  std::vector<Meeting> pairs;
  for (int n = 0; n < s.pairs; ++n) pairs.push_back(lottery.pair());
  for (int k = 0; k < s.throws; ++k)
    for (const Meeting& pair : pairs) {
      const Meeting m = lottery.thrown(pair);
      const RunOutcome run = farm.run({job_of(m, s)}).front();
      if (run.failed()) fail("oblique pair", run.error);
      good = compare(atlas, m, run.result, s) && good;
    }
  return good;
}

}  // namespace

int main(int argc, char** argv)
{
  CLI::App app("Oblique impacts of two unlike spheres: a particle code's contact against the solver");
  std::string folder;
  Setting setting;
  app.add_option("folder", folder)->required();
  app.add_option("--atlas", setting.atlas)->required();
  app.add_option("--pairs", setting.pairs)->check(CLI::Range(1, 100));
  app.add_option("--throws", setting.throws)->check(CLI::Range(1, 100));
  app.add_option("--cells", setting.cells)->check(CLI::Range(6, 60));
  app.add_option("--steps", setting.steps)->check(CLI::Range(10, 1000000));
  app.add_option("--most", setting.most)->delimiter(',')->expected(3);
  CLI11_PARSE(app, argc, argv);
  try {
    ThreadFarm farm(1, RunCache(folder));
    const bool good = study(setting, farm);
    fmt::print("{} runs, {:.0f} CPU s\n", farm.count().made, farm.count().cpu_s);
    return good ? 0 : 1;
  } catch (const Error& error) {
    fmt::print(stderr, "oblique_pairs_study: {}\n", error.what());
    return 2;
  }
}
