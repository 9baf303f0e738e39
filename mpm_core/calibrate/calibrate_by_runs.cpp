#include "calibrate/calibrate_by_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/larger.hpp"
#include "calibrate/fit.hpp"
#include "calibrate/kind/kind.hpp"

namespace granulaw {

namespace {

/// Deepest overlap over the radius that the data show of a sphere of this material.
double deepest(const CalibrationProblem& problem, const CandidateMaterial& material, const SphereLaws& laws)
{
  double depth = 0;
  for (const Measurement& m : problem.request().measurements)
    depth = std::max(depth, m.kind->reach(m, {material, laws}).overlap);
  return depth;
}

/// Overlap/R that a law by runs must reach.
double depth_of_law(double deepest, double onset)
{
  constexpr double margin = 1.1, least_over_onset = 8;
  return std::clamp(std::max(margin * deepest, least_over_onset * onset), 0.02, Atlas::depth);
}

struct Miss
{
  double force = 0, restitution = 0;
  bool is_small() const { return force < close_enough && restitution < close_enough; }
};

/// From twice the onset to the depth of the data.
Miss miss_of(const Curve& fitted, const Curve& own, double depth)
{
  constexpr int places = 12;
  Miss miss;
  const double first = 2 * own.onset(), last = std::min(depth, own.end());
  if (!(last > first)) return miss;
  for (int k = 0; k <= places; ++k) {
    const double x = first * std::pow(last / first, static_cast<double>(k) / places);
    const auto e = [x](const Curve& c) { return std::sqrt(c.kept(x)); };
    miss.force = larger(miss.force, std::abs(fitted.loading(x).force / own.loading(x).force - 1));
    miss.restitution = larger(miss.restitution, std::abs(e(fitted) - e(own)));
  }
  return miss;
}

}  // namespace

CalibrationByRuns calibrate_by_runs(CalibrationProblem& problem, const LawByRuns& law_by_runs, const Progress& progress)
{
  CalibrationByRuns result;
  Coordinates q = best_fit(problem).q;
  const Atlas& atlas = problem.laws().atlas();
  for (; result.laws < most_laws;) {
    const CandidateMaterial material = problem.material(q);
    const std::shared_ptr<const SphereLaws> laws = problem.laws().of(material);
    const double depth = deepest(problem, material, *laws);
    const Curve own = law_by_runs(
        material.name, solver_material(material), depth_of_law(depth, laws->onset()), [&](double done, const std::string& what) {
          if (progress)
            progress((result.laws + done) / most_laws, fmt::format("law {}: {}", result.laws + 1, what));
        });
    ++result.laws;
    const Miss miss = miss_of(laws->free(), own, depth);
    result.miss_force = miss.force, result.miss_restitution = miss.restitution;
    const SphereLaws coarse(atlas, material);
    problem.laws().set_departure(Departure::between(own, coarse.shape()));
    q = polished(problem, q).q;
    if (miss.is_small()) break;
  }
  result.calibration = calibrate(problem, q);
  return result;
}

}  // namespace granulaw
