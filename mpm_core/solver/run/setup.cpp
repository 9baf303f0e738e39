#include "solver/run/setup.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"

namespace granulaw {

int cells_of(const RunOptions& options, double standard, int most, const char* where)
{
  const int asked = options.resolution;
  if (asked != 0 && (asked < 6 || asked > most))
    fail("--resolution", "cannot be used", std::to_string(asked),
         fmt::format("6 to {} cells across the contact block{}", most, where));
  return static_cast<int>(std::lround(options.refine * (asked ? asked : standard)));
}

void check_options(const RunOptions& options, const Particle& particle)
{
  if (!options.yield_stresses.empty() && options.yield_stresses.size() != particle.materials.size())
    fail("yield stresses", "one for each material of the particle",
         std::to_string(options.yield_stresses.size()), std::to_string(particle.materials.size()));
  if (options.shifted_grids < 1 || options.shifted_grids > 64)
    fail("shifted grids", "cannot be used", std::to_string(options.shifted_grids), "1 to 64 shifted grids");
  if (!(options.courant >= 0.05 && options.courant <= 1.0))
    fail("courant", "the explicit step is stable up to 1 only", fmt::format("{:g}", options.courant),
         "0.05 to 1");
  if (options.checkpoints && options.fields)
    fail("--checkpoint", "cannot go with --fields: the frames of a run that was stopped are not kept");
}

/// The surfaces part over a length of 1.46 w E*/sigma_0^2, which some cells must divide: with fewer than four the edge is trapped by the
/// grid (docs/evidence/adhesion.md).
Attraction Setup::in_run_units(Attraction attraction, double cell) const
{
  attraction.work /= scale_.stress * scale_.length, attraction.range /= scale_.length;
  constexpr double least = 4.0, share = 0.25 * 1.46;
  const double zone = share * e_star() * attraction.range * attraction.range / attraction.work;
  if (zone < least * cell)
    fail("--adhesion-range", fmt::format("the edge parts over {:.2g} cells, and {:g} are needed", zone / cell, least),
         fmt::format("{:.3g} m", attraction.range * scale_.length),
         fmt::format("{:.3g} m or more, or {:.3g} times the --resolution", std::sqrt(least * cell * attraction.work / (share * e_star())) * scale_.length,
                     least * cell / zone));
  return attraction;
}

bool in_three_dimensions(const Particle& particle, const Partner& partner, const RunOptions& options,
                         const char* needed)
{
  const char* reason = particle.shape ? "a body of any shape" : needed;
  if (!reason && options.grid != GridKind::spatial) return false;
  if (options.grid != GridKind::spatial && options.grid != GridKind::automatic)
    fail("--grid", fmt::format("{} needs three dimensions", reason), name_of(options.grid),
         name_of(GridKind::spatial));
  if (partner.attraction.work > 0 && partner.particle)
    fail("--work-of-adhesion", "is computed against rigid planes in three dimensions", "a second particle");
  if (partner.wall) fail("partner", "three dimensions have rigid planes and second spheres only", "a wall");
  return true;
}

Vector3 unit_direction(const std::array<double, 3>& v, const char* where)
{
  const Vector3 x(v[0], v[1], v[2]);
  if (!(x.norm() > 0) || !x.allFinite())
    fail(where, "is no direction", fmt::format("{:g}, {:g}, {:g}", v[0], v[1], v[2]),
         "three numbers, not all 0");
  return x.normalized();
}

}  // namespace granulaw
