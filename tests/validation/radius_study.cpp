// Contact radius of unloading: laws of the atlas against presses of materials that it has no node for.
//
//   granulaw_radius_study ATLAS FOLDER     runs are kept in FOLDER and not made again; prints a table
//
// Columns: E*/Y, nu, H/E, overlap/R of the reversal; largest deviation of a, per cent, at forces from the peak to a tenth of it,
// and from there to a hundredth, at the law's own force and at its own overlap; then, at its own force, of the closed formula that
// stood here before. The solver's radius goes from cell to cell: it is the mean over a quarter of the force either way.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "atlas/tabulate_curve.hpp"
#include "characterise/atlas_file.hpp"
#include "characterise/run/sampling_plan.hpp"
#include "farm/farm.hpp"
#include "law/contact_law.hpp"

namespace {

using namespace granulaw;

constexpr MaterialRatios materials[] = {{25, 0.3, 0.05}, {75, 0.2, 0},    {75, 0.45, 0.1},  {150, 0.2, 0.01},
                                        {300, 0.3, 0},   {300, 0.1, 0.1}, {900, 0.35, 0.02}, {2500, 0.3, 0}};
constexpr double shares[] = {0.8, 0.65, 0.5, 0.35, 0.25, 0.18, 0.13, 0.1, 0.07, 0.05, 0.035, 0.025, 0.018, 0.013, 0.01};

/// Largest deviations: to a tenth of the peak force, and from there on.
struct Deviations
{
  double upper = 0, lower = 0;
  void take(double share, double deviation)
  {
    double& of = share >= 0.1 ? upper : lower;
    of = std::max(of, std::abs(deviation));
  }
};

/// a/a_m at a share of the peak force, of a dent whose pressure is part Hertz's and part uniform, by the overlap that it recovers
/// over F_m/(2 E* a_m): 3/2 of Hertz's, 4/pi and less of a uniform one.
double closed_formula(double share, double recovered)
{
  const double uniform = 4 / M_PI, hertz = std::clamp((recovered - uniform) / (1.5 - uniform), 0.0, 1.0);
  double low = 0, high = 0.5 * M_PI;
  for (int n = 0; n < 50; ++n) {
    const double t = 0.5 * (low + high), c = std::sin(t);
    (hertz * c * c * c + (1 - hertz) * (2 * t - std::sin(2 * t)) / M_PI < share ? low : high) = t;
  }
  return std::sin(low);
}

void compare(const MaterialRatios& m, const Curve& law, const RunResult& run)
{
  const auto& t = run.trace;
  const auto begins = std::find_if(t.rbegin(), t.rend(), [](const TraceSample& s) { return s.branch != Branch::unload; }).base();
  const double x_m = run.summary.delta_max, force = run.summary.force_max;
  const Reversal back = law.reversal(x_m);
  const UnloadingRadius k = law.unloading_radius(x_m);
  const auto radius = [&](double u) { return law.radius(x_m) * k.share(std::sqrt(std::max(0.0, u))); };
  const auto part_at = [&](double share) {
    double low = 0, high = 1;
    for (int n = 0; n < 50; ++n) {
      const double u = 0.5 * (low + high);
      (back.force_at(u, std::sqrt(u)) < share * back.top() ? low : high) = u;
    }
    return low;
  };
  const double recovered = 1.5 * law.radius(x_m) / (back.per_span * back.top());
  Deviations at_force, at_overlap, closed;
  for (const double share : shares) {
    double by_force = 0, by_overlap = 0, by_formula = 0, own = 0;
    int count = 0;
    for (auto s = begins; s != t.end(); ++s) {
      const double now = s->force / force;
      if (!(now > 0.8 * share && now < 1.25 * share)) continue;
      own += s->contact_radius, by_force += radius(part_at(now)), by_overlap += radius(back.part(s->delta));
      by_formula += law.radius(x_m) * closed_formula(now, recovered);
      ++count;
    }
    if (count < 2) continue;
    at_force.take(share, by_force / own - 1), at_overlap.take(share, by_overlap / own - 1), closed.take(share, by_formula / own - 1);
  }
  fmt::print("| {:g} | {:g} | {:g} | {:.4g} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} | {:.1f} |\n", m.stiffness, m.poisson_ratio, m.hardening, x_m,
             100 * at_force.upper, 100 * at_force.lower, 100 * at_overlap.upper, 100 * at_overlap.lower, 100 * closed.upper, 100 * closed.lower);
}

}  // namespace

int main(int argc, char** argv)
{
  if (argc != 3) return fmt::print(stderr, "usage: {} ATLAS FOLDER\n", argv[0]), 2;
  const Atlas atlas = read_atlas(argv[1]);
  ThreadFarm farm(static_cast<int>(std::max(1u, std::thread::hardware_concurrency())), RunCache(argv[2]));
  const RunSource source;
  for (const MaterialRatios& m : materials) {
    const CharacterisedBody body = characterised_body_of(m.stiffness, m.poisson_ratio, m.hardening);
    SamplingPlan plan = plan_sampling(body);
    plan.slow_impacts.clear(), plan.fast_speeds.clear();
    const Curve law = tabulate(ContactLaw(atlas.shape(m)));
    for (const RunResult& run : farm.run_all(sampling_jobs(body, plan, source))) compare(m, law, run);
  }
  return 0;
}
