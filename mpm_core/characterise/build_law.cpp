#include "characterise/build_law.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/scales.hpp"
#include "law/replay.hpp"
#include "solver/solver_id.hpp"

namespace granulaw {

namespace {

constexpr double mass = 4.0 / 3.0 * M_PI;  // of the dimensionless sphere

/// The material with R = rho = E* = 1.
Sphere dimensionless_sphere(const LawMaterial& m)
{
  Sphere sphere;
  sphere.radius = 1;
  sphere.material.density = 1;
  sphere.material.poisson_ratio = m.poisson_ratio;
  sphere.material.youngs_modulus = 1 - m.poisson_ratio * m.poisson_ratio;
  if (m.yields()) {
    sphere.material.yield_stress = m.yield_stress / m.e_star();
    sphere.material.hardening_modulus = m.hardening_modulus / m.e_star();
  }
  return sphere;
}

Sphere elastic_of(Sphere sphere)
{
  sphere.material.yield_stress = std::numeric_limits<double>::infinity();
  sphere.material.hardening_modulus = 0;
  return sphere;
}

/// Makes jobs: keys, labels and expected costs. Outlives them.
struct JobMaker
{
  const RunSource& source;
  int resolution;
  double onset;  // overlap/R

  std::string key(const Sphere& s, const std::string& what) const
  {
    return fmt::format("{} nu={:.17g} yield={:.17g} hardening={:.17g} resolution={} solver={}", what,
                       s.material.poisson_ratio, s.material.yield_stress, s.material.hardening_modulus,
                       resolution, solver_id());
  }
  /// Shifted grids of which the mean is taken. Near the onset little is plastic and the ripple is small (0.02
  /// % of F, 0.02 % of e (m)), and the steps are many: two grids do.
  int phases_at(double depth) const { return depth < 5 * onset ? 2 : RunOptions{}.phases; }

  RunOptions own(RunOptions options, bool estimate, int phases) const
  {
    options.resolution = resolution;
    options.estimate_error = estimate;
    options.phases = phases;
    options.precision = Precision::single;  // changes e and F by less than 1e-6, takes two thirds of the time
    return options;
  }

  // Costs like the number of steps: duration/(cell size), where the cells scale with the contact radius.
  RunJob press(const Sphere& sphere, double depth, std::vector<double> unloads, bool estimate,
               int phases) const
  {
    std::string stops;
    for (const double u : unloads) stops += fmt::format(" unload={:.17g}", u);
    const PressPlan plan{depth, Support::free, unloads, 0};
    return {
        fmt::format("press to {:.3g} R", depth),
        key(sphere,
            fmt::format("press free depth={:.17g}{} estimate={} phases={}", depth, stops, estimate, phases)),
        (1 + 0.65 * static_cast<double>(unloads.size())) * (estimate ? 1.4 : 1.0) * phases / std::sqrt(depth),
        [this, sphere, plan, estimate, phases](const RunOptions& options) {
          return source.press(sphere, plan, own(options, estimate, phases));
        }};
  }
  RunJob impact(const Sphere& sphere, double velocity, double expected_depth, bool estimate = false) const
  {
    const int phases = phases_at(expected_depth);
    return {
        fmt::format("impact at {:.3g} c*", velocity),
        key(sphere, fmt::format("impact velocity={:.17g} estimate={} phases={}", velocity, estimate, phases)),
        0.25 * (estimate ? 1.4 : 1.0) * phases / std::sqrt(expected_depth),
        [this, sphere, velocity, estimate, phases](const RunOptions& options) {
          return source.impact(sphere, velocity, own(options, estimate, phases));
        }};
  }
};

/// `steps` + 1 values from `first` to `last` by equal factors.
std::vector<double> geometric(double first, double last, int steps)
{
  std::vector<double> values;
  for (int k = 0; k <= steps; ++k)
    values.push_back(first * std::pow(last / first, static_cast<double>(k) / steps));
  return values;
}

int steps_of_factor(double first, double last, double factor)
{
  return std::max(1, static_cast<int>(std::ceil(std::log(last / first) / std::log(factor) - 1e-9)));
}

/// Overlap/R that an impact is expected to reach: Hertz's, or of a sphere with a mean pressure of 2.8 Y over
/// the area 2 pi R delta cut to it, whichever is deeper. Only costs and grid phases depend on it.
double expected_depth(double velocity, double yield)
{
  const double hertz = std::pow(15.0 / 16.0 * mass * velocity * velocity, 0.4);
  return std::max(hertz, velocity * std::sqrt(mass / (5.6 * M_PI * yield)));
}

/// Largest |area| between a partial unloading and its reloading, over the loading work up to there.
double loop_area(const RunResult& run)
{
  double work = 0, loop = 0, largest = 0;
  const auto& t = run.trace;
  for (std::size_t k = 1; k < t.size(); ++k) {
    const double piece = 0.5 * (t[k].force + t[k - 1].force) * (t[k].delta - t[k - 1].delta);
    if (t[k].branch == Branch::load) {
      if (t[k - 1].branch == Branch::reload && work > 0) largest = std::max(largest, std::abs(loop) / work);
      if (t[k - 1].branch == Branch::load) work += piece;
      loop = 0;
    } else {
      loop += piece;
    }
  }
  return largest;
}

/// Runs jobs as one share [from, to] of the whole build's progress.
std::vector<RunResult> run_share(const std::vector<RunJob>& jobs, const BuildOptions& options, double from,
                                 double to)
{
  const Progress progress = [&](double done, const std::string& what) {
    if (options.progress) options.progress(from + (to - from) * done, what);
  };
  ThreadFarm alone(1);
  return (options.farm ? options.farm : &alone)->run_all(jobs, progress);
}

/// Resolution whose two-resolution estimate meets the tolerance; `reached` gets the estimate. `job` makes the
/// run with its estimate.
int choose_resolution(const BuildOptions& options, const std::function<RunJob(int)>& job, double& reached)
{
  for (const int resolution : {0, 32, 64}) {
    reached = run_share({job(resolution)}, options, 0.0, 0.05)[0].summary.error_estimate;
    if (options.tolerance <= 0 || reached <= options.tolerance) return resolution;
  }
  fail("--tolerance", "not reached at the finest resolution: two resolutions still differ",
       fmt::format("{:.2g}", reached), fmt::format("{:.2g} or more", reached));
}

/// Replays the law against impacts that took no part in its fit; fills verification_* and max_inertia.
void verify(BodyLaw& body, const Sphere& sphere, const std::vector<double>& velocities,
            const BuildOptions& options, const JobMaker& make)
{
  std::vector<RunJob> jobs;
  for (const double v : velocities)
    jobs.push_back(make.impact(sphere, v, expected_depth(v, sphere.material.yield_stress)));
  const std::vector<RunResult> runs = run_share(jobs, options, 0.85, 1.0);
  Certificate& c = body.certificate;
  constexpr double allowed = 0.01;  // the error that the law's velocity limit is defined by
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const PairLaw wall{&body.curve, PairMapping::rigid_partner(1.0), &body};
    const Replay replay = replay_collision(wall, 1.0, mass, velocities[k]);
    const double force = std::abs(replay.force_max / runs[k].summary.force_max - 1);
    const double restitution = std::abs(replay.restitution / runs[k].summary.restitution - 1);
    c.verification_error_force = std::max(c.verification_error_force, force);
    c.verification_error_restitution = std::max(c.verification_error_restitution, restitution);
    c.verification_impacts += 1;
    const double inertia = velocities[k] * velocities[k] / sphere.material.yield_stress;
    if (std::max(force, restitution) > allowed) c.max_inertia = std::min(c.max_inertia, 0.5 * inertia);
  }
}

BodyLaw build_elastic(BodyLaw body, const Sphere& sphere, const BuildOptions& options,
                      const RunSource& source)
{
  Certificate& certificate = body.certificate;
  JobMaker make{source, 0, 0};
  make.resolution = choose_resolution(
      options,
      [&](int r) {
        make.resolution = r;
        return make.press(sphere, options.depth, {}, true, RunOptions{}.phases);
      },
      certificate.solver_error_force);
  const Pressing press = pressing_from(
      run_share({make.press(sphere, options.depth, {}, true, RunOptions{}.phases)}, options, 0.1, 1.0)[0]);
  const FittedCurve fitted = table_elastic(fit_elastic(press), options.depth);
  body.curve = ContactCurve(fitted.table, body.material.name);
  certificate.solver_error_restitution = certificate.solver_error_force;
  double sum = 0;
  int count = 0;
  for (const auto& [x, f, a] : press.loading)
    if (x > 0.5 * press.depth) sum += std::pow(f / body.curve.loading(x).force - 1, 2), ++count;
  certificate.residual_scatter = count ? std::sqrt(sum / count) : 0;
  certificate.max_inertia = std::numeric_limits<double>::infinity();
  return body;
}

/// Brings slow presses beyond the deepest impact onto it: there force, work and residual keep their ratio to
/// the press (DESIGN section 4). `at_impact` is the press to the impact's own depth.
std::vector<Pressing> continue_by(const std::vector<Pressing>& presses, const Pressing& at_impact,
                                  const Pressing& impact, double force_ratio)
{
  std::vector<Pressing> continued;
  const double work = impact.work_ratio / at_impact.work_ratio;
  const double kept = (1 - impact.residual / impact.depth) / (1 - at_impact.residual / at_impact.depth);
  for (Pressing p : presses) {
    std::erase_if(p.loading, [&](const Pressing::Sample& s) { return s.x < impact.depth; });
    for (Pressing::Sample& s : p.loading) s.force *= force_ratio;
    p.work_ratio *= work;
    p.residual = p.depth * (1 - kept * (1 - p.residual / p.depth));
    continued.push_back(std::move(p));
  }
  return continued;
}

}  // namespace

BodyLaw build_law(const LawMaterial& material, const BuildOptions& options, const RunSource& source)
{
  const Sphere sphere = dimensionless_sphere(material);
  validate(sphere.material, material.name.c_str());
  if (!(options.depth > 0 && options.depth <= 0.5))
    fail("depth of the law", "cannot be used", fmt::format("{:g} R", options.depth), "over 0, up to 0.5 R");
  BodyLaw body;
  body.material = material;
  Certificate& certificate = body.certificate;
  certificate.support = "free";
  certificate.max_inertia = largest_inertia;
  if (!material.yields()) return build_elastic(body, sphere, options, source);

  const double yield = sphere.material.yield_stress;
  const double onset = onset_overlap(1.0, yield, material.poisson_ratio);
  if (onset > 0.2 * options.depth)
    fail(fmt::format("material '{}'", material.name), "yields too late in the overlaps that a law covers",
         fmt::format("onset at delta/R = {:.3g}", onset), fmt::format("up to {:.3g}", 0.2 * options.depth));

  // 1. Impacts from the onset up to the largest inertia.
  const double slowest = 1.3 * onset_velocity(1.0, yield, 1.0, material.poisson_ratio);
  const double fastest = std::sqrt(largest_inertia * yield);
  if (fastest < 3 * slowest)
    fail(fmt::format("material '{}'", material.name),
         fmt::format(
             "yields only at an inertia rho V^2/Y near {:.1g}, where this version's rate-free law ends",
             largest_inertia),
         fmt::format("E*/Y = {:.3g}", 1 / yield), "about 20 or more");
  JobMaker make{source, 0, onset};
  const double fastest_depth = expected_depth(fastest, yield);
  make.resolution = choose_resolution(
      options,
      [&](int r) {
        make.resolution = r;
        return make.impact(sphere, fastest, fastest_depth, true);
      },
      certificate.solver_error_force);
  certificate.solver_error_restitution =
      certificate.solver_error_force;  // the estimate is the larger of the two

  const std::vector<double> velocities = geometric(slowest, fastest, steps_of_factor(slowest, fastest, 1.8));
  std::vector<RunJob> jobs;
  for (const double v : velocities)
    jobs.push_back(make.impact(sphere, v, expected_depth(v, yield), v == velocities.back()));
  const double elastic_depth = std::max(0.004, std::min(1.5 * onset, 0.02));
  jobs.push_back(make.press(elastic_of(sphere), elastic_depth, {}, false, 2));
  std::vector<RunResult> runs = run_share(jobs, options, 0.05, 0.45);
  const ElasticCorrection elastic = fit_elastic(pressing_from(runs.back()));
  runs.pop_back();
  std::vector<Pressing> points;
  for (const RunResult& run : runs) points.push_back(pressing_from(run));

  // 2. Slow presses to the deepest impact's overlap and beyond.
  const Pressing deepest = points.back();
  if (deepest.depth < options.depth) {
    // The first fixes the ratios and is as good as the impact; the others lie where no rate-free law is
    // exact.
    const auto depths =
        geometric(deepest.depth, options.depth, steps_of_factor(deepest.depth, options.depth, 2.0));
    std::vector<RunJob> presses;
    for (const double depth : depths)
      presses.push_back(make.press(sphere, depth, {}, false, presses.empty() ? make.phases_at(depth) : 2));
    presses.push_back(make.press(sphere, options.depth, {0.4 * options.depth}, false, 1));
    std::vector<RunResult> pressed = run_share(presses, options, 0.45, 0.85);
    certificate.reload_loop_area = loop_area(pressed.back());
    pressed.pop_back();
    const double force_ratio = runs.back().summary.force_max / pressed.front().summary.force_max;
    certificate.slow_press_force = 1 / force_ratio - 1;
    std::vector<Pressing> beyond;
    for (std::size_t k = 1; k < pressed.size(); ++k) beyond.push_back(pressing_from(pressed[k]));
    const Pressing at_impact = pressing_from(pressed.front());
    certificate.slow_press_restitution = std::sqrt(at_impact.work_ratio / deepest.work_ratio) - 1;
    for (Pressing& p : continue_by(beyond, at_impact, deepest, force_ratio)) points.push_back(std::move(p));
  }

  // 3. Fit, and check by impacts between the sampled ones.
  const FittedCurve fitted = fit_plastic(points, elastic, onset, options.depth);
  body.curve = ContactCurve(fitted.table, material.name);
  certificate.interpolation_error = fitted.quality.table_error;
  certificate.residual_scatter = fitted.quality.scatter;
  certificate.held_out_error = fitted.quality.held_out;
  const std::size_t n = velocities.size();
  std::vector<double> between;
  for (const std::size_t k : {n - 1, n / 2, std::size_t{2}})
    if (k > 0 && k < n) between.push_back(std::sqrt(velocities[k - 1] * velocities[k]));
  verify(body, sphere, between, options, make);
  return body;
}

}  // namespace granulaw
