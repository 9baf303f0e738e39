// Plastic oblique impacts with friction under `tangential history` and `tangential plastic`, against the solver in three
// dimensions (docs/evidence/oblique.md). Runs are kept in FOLDER and not made again.
//
//   oblique_study FOLDER --atlas ATLAS.h5 wall CASES.csv [--stiffness E*/Y] [--velocity V/V_y] [--angles A,A,...] ...
//       a sphere of one material without spin hits a rigid wall at one normal velocity, at several angles from its normal and
//       with several coefficients of friction. Writes the cases, which oblique_page.py draws; prints the material's row.
//   oblique_study FOLDER --atlas ATLAS.h5 pairs [--pairs N] [--throws N] [--most E,V,OMEGA] ...
//       two unlike deformable spheres, by laws composed of the two materials': random materials, sizes, speeds, angles and
//       frictions, their seed fixed before anything was run. With --most fails where `plastic` errs by more, per cent.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

#include "atlas/composed_law.hpp"
#include "atlas/law_from_atlas.hpp"
#include "base/error.hpp"
#include "base/scales.hpp"
#include "characterise/atlas_file.hpp"
#include "characterise/body/characterised_body.hpp"
#include "characterise/body/law_material.hpp"
#include "farm/farm.hpp"
#include "law/oblique.hpp"
#include "law/radiation.hpp"
#include "solver/runs.hpp"
#include "solver/solver_id.hpp"

namespace {

using namespace granulaw;

constexpr double radius = 1e-3;        // m, of the thrown, yielding sphere
constexpr double damping_ratio = 0.1;  // the plug-in's default
constexpr TangentialKind kinds[] = {TangentialKind::history, TangentialKind::plastic};

struct Setting
{
  std::string folder, atlas, cases;
  int cells = 8, grids = 1, steps = 20000, threads = 1;
  double stiffness = 100, hardening = 0, velocity = 100;       // E*/Y, H/E, V/V_y
  std::vector<double> angles{10, 20, 30, 40, 50, 60, 70, 80};  // degrees from the wall's normal
  std::vector<double> frictions{0.1, 0.3, 0.6};
  int pairs = 3, throws = 2;
  std::vector<double> most;

  LawRange range() const
  {
    LawRange deep;
    deep.depth = 0.3, deep.fastest = 0.3;
    return deep;
  }
};

/// e, tangential velocity over that before, R omega/V of the thrown sphere, and of its partner.
using Motion = std::vector<double>;

Motion by_solver(const Rebound& r, double velocity, bool partner)
{
  Motion m{r.normal, r.tangential, radius * r.spin[1] / velocity};
  if (partner) m.push_back(radius * r.partner_spin[1] / velocity);
  return m;
}

/// Errors under the two tangential laws, per cent: of e and the spins, and of the tangential velocity before.
std::vector<Motion> errors(const PairLaw& law, const ObliqueThrow& t, double friction, const Motion& solver, int steps)
{
  std::vector<Motion> both;
  for (const TangentialKind kind : kinds) {
    const ObliqueAnswer a = replay_oblique(law, t, kind, friction, damping_ratio, steps);
    Motion m{a.restitution, a.tangential / t.tangential_velocity, radius * a.spin / t.velocity, radius * a.partner_spin / t.velocity};
    m.resize(solver.size());
    for (std::size_t k = 0; k < m.size(); ++k) m[k] = 100 * (k == 1 ? m[k] - solver[k] : m[k] / solver[k] - 1);
    both.push_back(m);
  }
  return both;
}

double along(double velocity, double angle)
{
  return velocity * std::tan(angle * M_PI / 180);
}

Material material_of(const Setting& s)
{
  Material m{.density = 1500, .youngs_modulus = 9.1e9, .poisson_ratio = 0.3};
  m.yield_stress = m.e_star() / s.stiffness;
  m.hardening_modulus = s.hardening * m.youngs_modulus;
  return m;
}

RunJob wall_job(const Particle& particle, double friction, double angle, double velocity, const Setting& s)
{
  Approach thrown;
  thrown.velocity = velocity, thrown.friction = friction, thrown.tangential_velocity = along(velocity, angle);
  RunJob job;
  job.label = fmt::format("mu {:g}, {:g} degrees", friction, angle);
  job.key = fmt::format("oblique {} v={:.17g} vt={:.17g} mu={:g} cells={} grids={} solver={}", description_of(particle.materials[0]),
                        velocity, thrown.tangential_velocity, friction, s.cells, s.grids, solver_id());
  job.run = [particle, thrown, s](const RunOptions& given) {
    RunOptions options = given;
    options.resolution = s.cells, options.shifted_grids = s.grids, options.grid = GridKind::spatial;
    return impact(particle, thrown, {}, options);
  };
  return job;
}

/// Median and largest of the sizes.
std::string spread(std::vector<double> values)
{
  const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  std::sort(values.begin(), values.end(), smaller);
  const std::size_t n = values.size();
  return fmt::format("{:.1f}, {:+.1f}", 0.5 * (std::abs(values[(n - 1) / 2]) + std::abs(values[n / 2])), values.back());
}

bool wall_study(const Setting& s, const Atlas& atlas, Farm& farm)
{
  const Material m = material_of(s);
  const BodyLaw law = law_from(atlas, law_material("material", m), s.range());
  const PairLaw wall = wall_pair(law);
  const Particle particle = Particle::sphere(radius, m);
  const double v = s.velocity * yield_velocity(m.e_star(), m.yield_stress, m.density), mass = particle.volume() * m.density;
  std::vector<RunJob> jobs{wall_job(particle, 0, 45, v, s)};  // without friction: overlap and contact radius
  std::vector<std::pair<double, double>> cases;
  for (const double friction : s.frictions)
    for (const double angle : s.angles) cases.emplace_back(friction, angle), jobs.push_back(wall_job(particle, friction, angle, v, s));
  const std::vector<RunOutcome> runs = farm.run(jobs);

  std::ofstream table(s.cases);
  table << "friction,angle_deg,e,tangential_velocity_kept,spin_r_omega_over_v_n,history_e_off_percent,history_tangential_velocity_off_percent,"
           "history_spin_off_percent,plastic_e_off_percent,plastic_tangential_velocity_off_percent,plastic_spin_off_percent\n";
  std::vector<double> off[2][3];
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const auto [friction, angle] = cases[k];
    if (runs[k + 1].failed()) {
      fmt::print("{}: left out: {}\n", jobs[k + 1].label, runs[k + 1].error);
      continue;
    }
    const Motion solver = by_solver(*runs[k + 1].result.rebound, v, false);
    const std::vector<Motion> both = errors(wall, {radius, mass, v, along(v, angle)}, friction, solver, s.steps);
    table << fmt::format("{:g},{:g},{:.3f},{:+.1f},{:+.1f}\n", friction, angle, fmt::join(solver, ","), fmt::join(both[0], ","), fmt::join(both[1], ","));
    for (int j : {0, 1})
      for (std::size_t q : {0, 1, 2}) off[j][q].push_back(both[static_cast<std::size_t>(j)][q]);
  }
  const RunResult& plain = runs.front().result;
  std::vector<double> radii;
  for (const PlaneSample& p : plain.planes.front().samples) radii.push_back(std::sqrt(p.axes[0] * p.axes[1]) / radius);
  std::nth_element(radii.begin(), radii.end() - 5, radii.end());  // the median of the nine largest: single samples ring
  fmt::print("| {:g} | {:g} | {:g} | {:.2g} | {:.2f} | {} |", s.stiffness, s.hardening, s.velocity, plain.summary.delta_max / radius,
             *(radii.end() - 5), off[0][0].size());
  for (const auto& q : off) fmt::print(" {}; {}; {} |", spread(q[0]), spread(q[1]), spread(q[2]));
  fmt::print("\n");
  return true;
}

/// Two spheres, their relative normal speed, and Coulomb's coefficient.
struct Meeting
{
  UnlikePair pair;
  double v_over_vy, friction = 0, angle = 0;  // degrees from the normal

  double velocity() const { return v_over_vy * pair.yield_velocity(); }
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
  double between(double low, double high) { return low * std::pow(high / low, static_cast<double>(random_() >> 11) * 0x1p-53); }
  /// Over R*.
  static double hertz_overlap(const Meeting& m)
  {
    const double r = m.pair.r_eff(), v = m.velocity() / m.pair.wave_speed();
    const double e_star = m.pair.mapping().e_star_pair() / m.pair.yielding.e_star();
    return std::pow(15.0 / 16.0 * m.pair.m_eff() * v * v / (e_star * r * r * r), 0.4);
  }

  std::mt19937_64 random_{56};  // its numbers are the standard's: the same cases everywhere
};

RunJob pair_job(const Meeting& m, const Setting& s)
{
  const auto sphere_of = [](const LawMaterial& l, double r) {
    return Particle::sphere(r, {.density = l.density, .youngs_modulus = l.youngs_modulus, .poisson_ratio = l.poisson_ratio, .yield_stress = l.yield_stress});
  };
  const Particle thrown = sphere_of(m.pair.yielding, radius);
  Partner partner;
  partner.particle = sphere_of(m.pair.partner, m.partner_radius());
  Approach approach;
  approach.velocity = m.velocity(), approach.tangential_velocity = along(m.velocity(), m.angle), approach.friction = m.friction;
  RunJob job;
  job.key = fmt::format("oblique pair {} | {} {:.17g} v={:.17g} vt={:.17g} mu={:.17g} cells={} solver={}", description_of(thrown.materials[0]),
                        description_of(partner.particle->materials[0]), m.pair.radius_ratio, approach.velocity, approach.tangential_velocity,
                        m.friction, s.cells, solver_id());
  job.run = [=](const RunOptions& given) {
    RunOptions options = given;
    options.resolution = s.cells, options.shifted_grids = 1, options.precision = Precision::single;
    return impact(thrown, approach, partner, options);
  };
  return job;
}

/// Prints a line of the table; true if `plastic` is good enough.
bool compare(const Atlas& atlas, const Meeting& m, const RunResult& run, const Setting& s)
{
  const LawMaterial &y = m.pair.yielding, &h = m.pair.partner;
  const TwoBodyLaw own = compose_law(atlas, PairBody(atlas, y), PairBody(atlas, h), m.pair.radius_ratio, s.range());
  const PairLaw law{{&own.law.curve, m.pair.mapping(), radiation(y, 1.0, h, m.pair.radius_ratio)}, &own.law};
  const auto mass = [](const LawMaterial& material, double r) { return material.density * 4.0 / 3.0 * M_PI * r * r * r; };
  const double v = m.velocity(), other = m.partner_radius();
  const ObliqueThrow thrown{radius, mass(y, radius), v, along(v, m.angle), {other, mass(h, other), {h.youngs_modulus, h.poisson_ratio}}};
  const Motion solver = by_solver(*run.rebound, v, true);
  const std::vector<Motion> off = errors(law, thrown, m.friction, solver, s.steps);
  const auto words = [](const Motion& q, const char* number) { return fmt::format(fmt::runtime(fmt::format("{0}; {0}; {0}, {0}", number)), q[0], q[1], q[2], q[3]); };
  fmt::print("| {:.0f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.0f} | {:.3f} | {:.2f} | {:.0f} | {} | {} | {} |\n", y.e_star() / y.yield_stress,
             h.e_star() / y.e_star(), h.yield_stress / y.yield_stress, h.density / y.density, m.pair.radius_ratio, m.v_over_vy,
             run.summary.delta_max / (radius * m.pair.r_eff()), m.friction, m.angle, words(solver, "{:.3f}"), words(off[0], "{:+.1f}"),
             words(off[1], "{:+.1f}"));
  std::fflush(stdout);
  for (std::size_t k = 0; !s.most.empty() && k < solver.size(); ++k)
    if (!(std::abs(off[1][k]) <= s.most[std::min<std::size_t>(k, 2)])) return false;
  return true;
}

bool pairs_study(const Setting& s, const Atlas& atlas, Farm& farm)
{
  bool good = true;
  Lottery lottery;
  std::vector<Meeting> pairs;
  for (int n = 0; n < s.pairs; ++n) pairs.push_back(lottery.pair());
  for (int k = 0; k < s.throws; ++k)
    for (const Meeting& pair : pairs) {
      const Meeting m = lottery.thrown(pair);
      const RunOutcome run = farm.run({pair_job(m, s)}).front();
      if (run.failed()) fail("oblique pair", run.error);
      good = compare(atlas, m, run.result, s) && good;
    }
  return good;
}

}  // namespace

int main(int argc, char** argv)
{
  CLI::App app("Oblique impacts: a particle code's contact against the solver");
  Setting s;
  app.add_option("folder", s.folder)->required();
  app.add_option("--atlas", s.atlas)->required();
  app.add_option("--cells", s.cells)->check(CLI::Range(6, 60));
  app.add_option("--steps", s.steps)->check(CLI::Range(10, 1000000));
  app.add_option("--threads", s.threads)->check(CLI::Range(1, 256));
  app.require_subcommand(1);
  CLI::App *wall = app.add_subcommand("wall"), *pairs = app.add_subcommand("pairs");
  wall->add_option("cases", s.cases)->required();
  wall->add_option("--grids", s.grids)->check(CLI::Range(1, 64));
  wall->add_option("--stiffness", s.stiffness)->check(CLI::Range(20.0, 5000.0));
  wall->add_option("--hardening", s.hardening)->check(CLI::Range(0.0, 1.0));
  wall->add_option("--velocity", s.velocity)->check(CLI::Range(2.0, 1000.0));
  wall->add_option("--angles", s.angles)->delimiter(',')->check(CLI::Range(1.0, 89.0));
  wall->add_option("--frictions", s.frictions)->delimiter(',')->check(CLI::Range(0.0, 2.0));
  pairs->add_option("--pairs", s.pairs)->check(CLI::Range(1, 100));
  pairs->add_option("--throws", s.throws)->check(CLI::Range(1, 100));
  pairs->add_option("--most", s.most)->delimiter(',')->expected(3);
  CLI11_PARSE(app, argc, argv);
  try {
    ThreadFarm farm(s.threads, RunCache(s.folder));
    const Atlas atlas = read_atlas(s.atlas);
    const bool good = *wall ? wall_study(s, atlas, farm) : pairs_study(s, atlas, farm);
    fmt::print("{} runs, {:.0f} CPU s\n", farm.count().made, farm.count().cpu_s);
    return good ? 0 : 1;
  } catch (const Error& error) {
    fmt::print(stderr, "oblique_study: {}\n", error.what());
    return 2;
  }
}
