#include "characterise/run/grid_convergence.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/larger.hpp"
#include "solver/run/grid_noise.hpp"

namespace granulaw {

namespace {

constexpr double observed_order = 1.65, safety = 1.25;

/// Largest relative change of the fitted loading force.
double change_of_loading(const RunResult& fine, const RunResult& coarse)
{
  const TreatedLoading a(fine.trace), b(coarse.trace);
  if (!a.valid() || !b.valid()) fail("grid convergence", "too few samples in the loading of a run");
  double most = 0;
  for (const double share : {0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
    const double x = share * fine.summary.delta_max;
    most = larger(most, std::abs(b.force(x) / a.force(x) - 1));
  }
  return most;
}

}  // namespace

double convergence_index(double change, double cell_ratio)
{
  return safety * change / (std::pow(cell_ratio, observed_order) - 1);
}

DiscretisationError grid_convergence(const RunResult& fine, const RunResult& coarse)
{
  constexpr double unknown = std::numeric_limits<double>::infinity();
  const double ratio = static_cast<double>(fine.summary.resolution) / coarse.summary.resolution;
  if (!(ratio > 1)) return {unknown, unknown};
  const double force = change_of_loading(fine, coarse);
  const double e = std::abs(coarse.summary.restitution / fine.summary.restitution - 1);
  return {convergence_index(force, ratio), convergence_index(larger(force, e), ratio)};
}

}  // namespace granulaw
