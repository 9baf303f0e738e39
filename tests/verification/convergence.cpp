#include "convergence.hpp"

#include <cmath>

#include "base/larger.hpp"
#include "base/scales.hpp"
#include "references.hpp"
#include "solver/body/kernels.hpp"
#include "solver/body/stable_step.hpp"
#include "solver/grid/mapped_body.hpp"
#include "solver/run/time_step.hpp"

namespace granulaw::verification {

Job elastic_impact()
{
  return {"elastic", reference::unit_sphere(0), reference::elastic_impact_velocity()};
}

Job plastic_impact()
{
  return {"plastic", reference::unit_sphere(100), 100 * yield_velocity(1, 0.01, 1)};
}

RunSummary run(const Job& job, int cells_across, int shifted_grids, double courant)
{
  RunOptions options;
  options.resolution = cells_across;
  options.shifted_grids = shifted_grids;
  options.courant = courant;
  return impact(job.sphere, {job.velocity}, {}, options).summary;
}

double energy_swing(double courant)
{
  const Moduli elastic{0.35, 0.76, 0.0, 0.0, false};
  Body b = mapped_body(MappedGrid::build(8, 0.3, true), {elastic}, 0.05 * elastic.shear);
  const double dt = courant * StableStep(b).limit(b);
  for (int i = 0; i < b.nodes(); ++i)
    b.v_i(i, 1) = 0.01 * (b.reference().place_i(i, 1) - 1);  // strains of half a percent
  const double start = b.kinetic_energy();
  double swing = 0;
  for (int n = 0; n * dt < 20; ++n) {
    Body before = b;
    kernels(b).points_to_grid(b);
    kernels(b).accelerate(b, dt);
    for (int i = 0; i < b.nodes(); ++i) {
      before.v_i(i, 0) = 0.5 * (before.v_i(i, 0) + b.v_i(i, 0));
      before.v_i(i, 1) = 0.5 * (before.v_i(i, 1) + b.v_i(i, 1));
    }
    swing = larger(swing, std::abs((before.kinetic_energy() + b.strain_energy()) / start - 1));
    kernels(b).grid_to_points(b, dt);
  }
  return swing;
}

Order fit_order(const std::vector<int>& cells, const std::vector<double>& errors)
{
  const double n = static_cast<double>(cells.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const double x = std::log(cells[k]), y = std::log(std::abs(errors[k]));
    sx += x, sy += y, sxx += x * x, sxy += x * y, syy += y * y;
  }
  const double vxx = sxx - sx * sx / n, vxy = sxy - sx * sy / n, vyy = syy - sy * sy / n;
  const double slope = vxy / vxx;
  return {-slope, std::sqrt(std::max(0.0, vyy - slope * vxy) / (n - 2) / vxx)};
}

Limit fit_limit(const std::vector<int>& cells, const std::vector<double>& values)
{
  const double n = static_cast<double>(cells.size());
  Limit best{};
  double least = INFINITY;
  for (double p = 0.5; p <= 4; p += 0.01) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const double x = std::pow(cells[k], -p), y = values[k] - values.back();  // differences keep digits
      sx += x, sy += y, sxx += x * x, sxy += x * y, syy += y * y;
    }
    const double vxx = sxx - sx * sx / n, vxy = sxy - sx * sy / n, vyy = syy - sy * sy / n;
    const double slope = vxy / vxx, residual = vyy - slope * vxy;
    if (residual < least) least = residual, best = {values.back() + (sy - slope * sx) / n, p};
  }
  return best;
}

double root_mean_square(const std::vector<double>& errors)
{
  double sum = 0;
  for (const double e : errors) sum += e * e;
  return std::sqrt(sum / static_cast<double>(errors.size()));
}

}  // namespace granulaw::verification
