#include "onset_impact.hpp"

#include <array>
#include <cmath>
#include <vector>

#include "base/scales.hpp"
#include "hertz.hpp"
#include "references.hpp"
#include "solver/runs.hpp"

namespace granulaw::verification {

OnsetImpact impact_about_onset(double e_over_y, double nu, double v_over_onset, int cells_across)
{
  std::vector<std::array<int, 4>> cells;
  FieldFrame first, last;
  RunOptions options;
  options.resolution = cells_across;
  options.shifted_grids = 1;
  options.fields.frames = 2;
  options.fields.begin = [&](int, const auto& c) { cells = c; };
  options.fields.frame = [&](const FieldFrame& f) {
    if (first.r.empty()) first = f;
    last = f;
  };
  const double onset =
      yield_velocity(1, 1 / e_over_y, 1) * std::pow(hertz::onset(nu).pressure_ratio / 1.6, 2.5);
  const RunResult run = impact(reference::unit_sphere(e_over_y, nu), {v_over_onset * onset}, {}, options);

  OnsetImpact found{};
  const double a = hertz::under(run.summary.force_max).a;
  for (std::size_t p = 0; p < cells.size(); ++p)
    if (last.plastic_strain[p] > found.largest_strain) {
      double r = 0, z = 0;
      for (const int i : cells[p]) r += 0.25 * first.r[i], z += 0.25 * first.z[i];
      found = {last.plastic_strain[p], r / a, z / a};
    }
  return found;
}

}  // namespace granulaw::verification
